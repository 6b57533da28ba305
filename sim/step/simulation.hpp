// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/core/frame.hpp"
#include "sim/neighbours/detection.hpp"
#include "sim/neighbours/grain_state.hpp"
#include "sim/neighbours/pair_list.hpp"
#include "sim/solver/solver.hpp"
#include "sim/step/world.hpp"

#include <cstdint>
#include <vector>

namespace grseg {

/// Largest number of times that a step is halved, so that no pair approaches by more than half the
/// smallest diameter in a part of it.
constexpr int most_halvings = 6;

/// Results of one step.
struct StepReport {
  SolverReport solver;
  std::size_t touching = 0;       ///< pairs with gap <= 0 at mid-step
  std::size_t force_bearing = 0;  ///< contacts that carry an impulse
  double sum_overlap = 0;         ///< m, of -gap over the touching pairs
  double largest_overlap = 0;     ///< m
  double sum_gap_bearing = 0;     ///< m, of |gap| over force-bearing contacts
  /// m/s, largest approach speed at the beginning of the step, over acting pairs and over unlisted
  /// pairs that could touch within the step.
  double fastest_approach = 0;
  /// m, fastest_approach times the length of the step or of its part; infinity where two centres
  /// coincide.
  double farthest_approach = 0;
  int parts = 1;                     ///< in which the step was taken
  Vec2 base_impulse = Vec2::Zero();  ///< kg m/s, of boundary grains and walls on mobile grains
};

/// Contact dynamics of rigid discs, Moreau's mid-point scheme (theta = 1/2). A step of length h
///
///   x  ->  x + h v/2         grains move freely to the middle of the step; contacts get their
///                            normals and lever arms there, and their rebounds from v
///   v  ->  v+ = v + h g + sum of contact impulses/m   solved for all contacts together
///   x  ->  x + h v+/2        grains move on to the end of the step
///
/// sim/contact/contact_law.hpp states which pairs act, and the law that their impulses obey.
///
/// Where a pair would approach by more than half the smallest diameter in a step, so that grains
/// might pass each other unseen, the step is taken in two halves, and these in halves again, up to
/// 1/64 of the step. The frame of such a step describes its last part.
class Simulation {
 public:
  /// All that changes from step to step and that later steps depend on.
  struct State {
    std::vector<Vec2> position;       // m, as in the cell
    std::vector<std::int32_t> image;  // periods to add to x
    std::vector<Vec2> velocity;       // m/s
    std::vector<double> rim_speed;    // m/s, radius times angular velocity
    std::vector<std::int32_t> row;    // of the grains, in the order of memory
    PairList::State pairs;
    std::int64_t steps_done = 0;
  };

  /// Grains start at `position` at rest.
  Simulation(const World& world, const std::vector<Vec2>& position);
  /// Continues from `state`: with the same world, the steps that follow are bitwise identical. The
  /// skin is the one of `state`. FormatError as in PairList::restore.
  Simulation(const World& world, const State& state);

  StepReport advance() { return step(nullptr); }
  /// Takes a step and writes it as a frame of a trajectory (formats/README.md): positions and
  /// contacts at mid-step, velocities at its end, forces as means over it, in the order of Grains.
  StepReport advance(Frame<2>& frame) { return step(&frame); }

  State state() const;

  const World& world() const { return world_; }
  std::int64_t steps_done() const { return steps_done_; }
  double time() const { return static_cast<double>(steps_done_) * world_.step; }  // s

  /// Sets gravity, which may turn as the clock runs.
  void tilt(const Gravity<2>& gravity)
  {
    gravity_ = gravity;
    world_.gravity = gravity.at(time());
  }
  /// Replaces World::bodies. Boundary grains of no body stand still from now on.
  void drive(const std::vector<BoundaryBody>& bodies);
  /// Sets the number of steps done, and with it the time; negative before the tilt.
  void set_clock(std::int64_t steps) { steps_done_ = steps; }

  /// Grain g, a row of Grains. Its position is unwrapped, as if nothing were periodic.
  Vec2 position(std::size_t g) const;
  const Motion& motion(std::size_t g) const { return state_.motion[body_of_[g]]; }
  Vec2 velocity(std::size_t g) const { return {motion(g).vx, motion(g).vy}; }
  double angular_velocity(std::size_t g) const
  {
    return motion(g).rim_speed / world_.grains.radius[g];
  }
  void set_velocity(std::size_t g, const Vec2& velocity, double angular_velocity = 0);

  /// Motion of each grain at the beginning of the last step, or part of one, that was written to a
  /// frame, and its length, s.
  const std::vector<Motion>& before() const { return before_; }
  double written_step() const { return written_step_; }

  /// m, half the smallest diameter: grains that approach by more in a step might pass unseen.
  double most_approach() const { return most_approach_; }

  std::size_t pair_list_renewals() const { return pairs_.renewals(); }

 private:
  StepReport step(Frame<2>* frame);
  /// The part of a step that begins `begin` steps after the step does.
  struct Part {
    double begin = 0;
    int halvings = 0;  // of the step
  };
  void take(const Part& part, Frame<2>* frame, StepReport& report);
  /// False where the part is too long: positions are then as before, to round-off, and the list of
  /// pairs belongs to them.
  bool try_to_take(const Part& part, Frame<2>* frame, StepReport& report);
  void take_back(bool renewed);
  /// True where the list was renewed. `spread`, m/s, as move_bodies() returns it.
  bool find_contacts(double spread, StepReport& report);
  void forget_impulses(bool renewed);
  /// Makes the list of pairs for the positions that grains will have `onward`, s, later.
  void renew_pairs(double onward);
  /// m/s, largest approach speed of grains that do not act and may meet before the end of the step,
  /// as they move now.
  double unlisted_ahead(double spread);
  [[noreturn]] void stop_at_coincidence(double time) const;
  WedgedGrains wedged_grains(bool any);
  /// Where there is an impact, lowers the first guesses of the next step.
  void lower_guesses();
  double impulse_of_fall() const;  // kg m/s, of gravity or a plate's load in a step
  ReferenceRange reference_range(std::size_t contacts) const;
  void solve(StepReport& report);
  void keep_impulses(StepReport& report);
  // Writes a solved step before the grains leave its middle, which is at `middle`, s
  // (snapshot.cpp).
  void write_frame(double middle, Frame<2>& frame) const;
  void write_contacts(ContactList<2>& list) const;

  World world_;
  Gravity<2> gravity_;
  Effects effects_;
  int threads_;
  PairList pairs_;
  GrainState state_;
  std::vector<std::uint32_t> body_of_;  // where in the state each grain is
  std::vector<Vec2> ahead_;             // m, positions after the forecast of the law
  std::vector<Vec2> ahead_at_end_;      // m, the same for the end of a step; for fast grains only
  double most_approach_;                // m
  double mobile_mass_;                  // kg
  DetectionSums found_;                 // of the contacts
  std::vector<double> guesses_;         // kg m/s, p_n at first; empty where no impact can be
  std::vector<Motion> before_;          // by row, at the beginning of a step written to a frame
  double written_step_ = 0;             // s
  std::vector<StripContacts> contacts_;
  SolverMemory solver_memory_;
  std::int64_t steps_done_ = 0;
  bool restored_ = false;  // the step before is known by its impulses only, not by its contacts
};

}  // namespace grseg
