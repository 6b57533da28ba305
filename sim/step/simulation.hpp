// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/core/frame.hpp"
#include "sim/neighbours/grain_state.hpp"
#include "sim/neighbours/impulse_memory.hpp"
#include "sim/neighbours/pair_list.hpp"
#include "sim/solver/solver.hpp"
#include "sim/step/energy_limit.hpp"
#include "sim/step/world.hpp"

#include <cstdint>
#include <limits>
#include <vector>

namespace grseg {

/// Largest number of times that a step is halved to keep the approach of every pair, in each part
/// of the step, below half the smallest diameter.
constexpr int most_halvings = 6;

/// Results of one step.
struct StepReport {
  SolverReport solver;
  std::size_t touching = 0;       ///< number of pairs with gap <= 0 at mid-step
  std::size_t force_bearing = 0;  ///< number of contacts with an impulse
  double sum_overlap = 0;         ///< m, sum of -gap over the touching pairs
  double largest_overlap = 0;     ///< m, largest -gap
  double sum_gap_bearing = 0;     ///< m, sum of |gap| over force-bearing contacts
  /// m/s, largest approach speed at the beginning of the step, over acting pairs and over unlisted
  /// pairs that could touch within the step.
  double fastest_approach = 0;
  /// m, fastest_approach times the duration of the (part of the) step; infinity: centres coincide.
  double farthest_approach = 0;
  int parts = 1;               ///< number of parts into which the step was divided
  double largest_impulse = 0;  ///< kg m/s, largest p_n
  double energy_gain = 0;  ///< J, W + T - T_before of energy_limit.hpp: energy that contacts added
  bool solved_again = false;         ///< the first solution created energy (energy_limit.hpp)
  Vec3 base_impulse = Vec3::Zero();  ///< kg m/s, of base and walls on mobile grains
};

/// Contact dynamics of rigid discs (D = 2) or spheres (D = 3), Moreau's mid-point scheme (theta =
/// 1/2). A step of length h
///
///   x  ->  x + h v/2         grains move freely to the middle of the step; contacts get their
///                            normals and lever arms there, and their rebounds from v
///   v  ->  v+ = v + h g + sum of contact impulses/m   solved for all contacts together
///   x  ->  x + h v+/2        grains move on to the end of the step
///
/// sim/contact/contact_law.hpp states which pairs act, and the law that their impulses obey;
/// sim/step/energy_limit.hpp states how much energy they may add.
///
/// If a pair would approach by more than half the smallest diameter in a step, its grains might
/// pass through each other without a contact. Then the step is divided into two halves, and these
/// into halves again, down to 1/64 of the step. The frame of a divided step describes its last
/// part.
template <int D>
class Simulation {
 public:
  /// All variables on which later steps depend.
  struct State {
    std::vector<Vector<D>> position;      // m, wrapped into the cell, per row of Grains
    std::vector<Periods<D>> image;        // number of periods to add to x and z
    std::vector<Vector<D>> velocity;      // m/s
    std::vector<Turning<D, double>> rim;  // m/s, radius times angular velocity
    std::vector<std::int32_t> row;        // row of each grain, in the order of memory
    typename PairList<D>::State pairs;
    std::int64_t steps_done = 0;
    double held_back = 0;                                // J, T of energy_limit.hpp
    double stored = std::numeric_limits<double>::max();  // J, S of energy_limit.hpp
  };

  /// Grains start at `position` at rest.
  Simulation(const World<D>& world, const std::vector<Vector<D>>& position);
  /// Continues from `state`, with its skin. With the same world, later steps are bitwise identical
  /// to an uninterrupted run. Throws FormatError as PairList::restore() does.
  Simulation(const World<D>& world, const State& state);

  StepReport advance() { return step(nullptr); }
  /// Computes a step and writes it as a frame of a trajectory (formats/README.md), in the order of
  /// Grains: positions and contacts at mid-step, velocities at the end, mean forces over the step.
  StepReport advance(Frame<D>& frame) { return step(&frame); }

  State state() const;

  const World<D>& world() const { return world_; }
  std::int64_t steps_done() const { return steps_done_; }
  double time() const { return static_cast<double>(steps_done_) * world_.step; }  // s

  /// Sets gravity, whose direction may change with time.
  void tilt(const Gravity<D>& gravity)
  {
    gravity_ = gravity;
    world_.gravity = gravity.at(time());
  }
  /// Replaces World::bodies. Boundary grains that belong to no body are at rest from now on.
  void drive(const std::vector<BoundaryBody>& bodies);
  /// Sets the number of steps done, and thus time(); negative before the tilt.
  void set_clock(std::int64_t steps) { steps_done_ = steps; }

  /// In these functions g is a row of Grains. Positions are unwrapped: periods are added.
  Vector<D> position(std::size_t g) const;
  const Motion<D>& motion(std::size_t g) const { return state_.motion[body_of_[g]]; }
  Vector<D> velocity(std::size_t g) const { return vector_of(motion(g).v); }
  Spin<D> angular_velocity(std::size_t g) const
  {
    return spin_of<D>(motion(g).rim) / world_.grains.radius[g];
  }
  void set_velocity(std::size_t g, const Vector<D>& velocity,
                    const Spin<D>& angular_velocity = spin_of<D>({}));

  /// Last step, or last part of a divided step, that was written to a frame: motion of each grain
  /// at its beginning, and its duration, s.
  const std::vector<Motion<D>>& before() const { return before_; }
  double written_step() const { return written_step_; }

  /// Largest approach of a pair in an undivided step, m: half the smallest diameter.
  double most_approach() const { return most_approach_; }

  std::size_t pair_list_renewals() const { return pairs_.renewals(); }

 private:
  StepReport step(Frame<D>* frame);
  /// Part of a step.
  struct Part {
    double begin = 0;  // time since the beginning of the step, in whole steps
    int halvings = 0;  // number of times that the step was halved
  };
  void take(const Part& part, Frame<D>* frame, StepReport& report);
  /// Returns false if the part is too long. Positions are then restored, to round-off, and the pair
  /// list is valid for them.
  bool try_to_take(const Part& part, Frame<D>* frame, StepReport& report);
  void take_back(bool renewed);
  /// Returns true if the pair list was renewed. `spread`: result of move_bodies(), m/s.
  bool find_contacts(double spread, StepReport& report);
  void forget_impulses(bool renewed);
  /// Makes the pair list for the positions that grains would have after `onward`, s, of free
  /// flight.
  void renew_pairs(double onward);
  /// Upper bound of the approach speed, m/s, of pairs that do not act but may meet before the end
  /// of the step with their present velocities.
  double unlisted_ahead(double spread);
  [[noreturn]] void stop_at_coincidence(double time) const;
  WedgedGrains<D> wedged_grains(bool any);
  /// After an impact (simulation.cpp), lowers the first guesses of the next step.
  void lower_guesses();
  double impulse_of_fall() const;  // kg m/s, of gravity or a plate's load in one step
  ReferenceRange reference_range(std::size_t contacts) const;
  void solve(StepReport& report);
  SolverReport run_solver();
  void keep_impulses(StepReport& report);
  ImpulseSums<D> store_impulses();

  // Limit of the energy of a step (energy_limit.cpp). begin_budget() is called before gravity and
  // loads act, the others after the solve.
  void begin_budget();
  /// Motion in the step of the surface of grain b of a moving boundary at the point that lies along n,
  /// at a distance of `lever` radii; 0 of other grains. Along y, free bodies count as at rest.
  SurfaceMotion<D> surface_motion(std::size_t b, double lever, const Vector<D>& n) const;
  WorkOfBoundaries work_of_boundaries() const;
  /// Left side of the limit, J, less the round-off. `held_back`: T. To be called when at_end_ is known.
  double energy_gain(double held_back) const;
  double work_of_fall() const;  // the last two terms of the limit, J
  void solve_within_limit(double most, StepReport& report);
  void stop_rebounds();        // of contacts that bear impulses in this step
  void stop_later_rebounds();  // of pairs that this step slows down before they touch
  /// Impulses of all blocks, kg m/s, and changes of velocities of World::bodies by contacts, m/s.
  Eigen::VectorXd solution();
  void set_impulses(const Eigen::VectorXd& solution);
  /// Sets the impulses of the blocks and adds their effect to the motion.
  void apply(const Eigen::VectorXd& solution);

  // Writes a frame (snapshot.cpp). To be called after the solve, while bodies are at their
  // positions at mid-step; `middle` is the time of mid-step, s.
  void write_frame(double middle, Frame<D>& frame) const;
  void write_contacts(ContactList<D>& list) const;

  World<D> world_;
  Gravity<D> gravity_;
  Effects effects_;
  int threads_;
  PairList<D> pairs_;
  GrainState<D> state_;
  std::vector<std::uint32_t> body_of_;     // per row of Grains, index in state_
  std::vector<Position<D>> ahead_;         // m, positions after LawParameters::forecast; after the
                                           // solve, positions at the end of the step
  std::vector<Position<D>> ahead_at_end_;  // m, half a step later; computed for fast grains only
  double most_approach_;                   // m, see most_approach()
  double mobile_mass_;                     // kg, sum over all mobile grains
  DetectionSums found_;                    // sums over the contacts of this step
  std::vector<double> guesses_;            // kg m/s, first guesses of p_n; empty: no impact
  std::vector<Motion<D>> before_;          // per row, see before()
  double written_step_ = 0;                // s, see written_step()
  std::vector<StripContacts<D>> contacts_;
  SolverMemory<D> solver_memory_;
  MotionSums<D> at_begin_, at_end_;       // at the beginning and at the end of the step
  bool end_known_ = false;                // true if at_end_ describes the present motion
  std::vector<Motion<D>> bodies_before_;  // of the grains of World::bodies, at the beginning
  double held_back_ = State{}.held_back;  // J, in the last step
  double stored_ = State{}.stored;        // J, after the last step
  std::int64_t steps_done_ = 0;
  bool restored_ = false;  // true if contacts_ do not belong to the previous step
};

}  // namespace grseg
