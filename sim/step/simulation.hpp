// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/core/frame.hpp"
#include "formats/core/gravity.hpp"
#include "sim/neighbours/detection.hpp"
#include "sim/neighbours/grain_state.hpp"
#include "sim/neighbours/pair_list.hpp"
#include "sim/solver/boundary_body.hpp"
#include "sim/solver/solver.hpp"

#include <cstdint>
#include <vector>

namespace grseg {

/// Everything that stays the same while a simulation runs.
struct World {
  Grains grains;
  std::vector<Wall> walls;
  std::vector<BoundaryBody> bodies;  // of boundary grains that move
  Box box;
  Material material;
  bool rotation = true;
  Vec2 gravity = Vec2::Zero();  // m/s^2, of the last step where the slope turns
  double step = 0;              // h, s
  SolverSettings solver;
  LawParameters law;
  double skin = 0;  // m, more than margin, of the pair list; 0 chooses half the smallest diameter
  int threads = 1;  // results do not depend on it
  /// Kernels that see to friction, restitution and periodicity whether the world has them or not:
  /// the same bytes for more time, for measurements and tests.
  bool general = false;
};

/// What one step did.
struct StepReport {
  SolverReport solver;
  std::size_t touching = 0;       ///< pairs with gap <= 0 at mid-step
  std::size_t force_bearing = 0;  ///< contacts that carry an impulse
  double sum_overlap = 0;         ///< m, of -gap over the touching pairs
  double largest_overlap = 0;     ///< m
  double sum_gap_bearing = 0;     ///< m, of |gap| over force-bearing contacts
  /// m/s, of a pair that acts, at the beginning of the step; or of grains so fast that they may
  /// have passed each other unseen.
  double fastest_approach = 0;
  Vec2 base_impulse = Vec2::Zero();  ///< kg m/s, of boundary grains and walls on mobile grains
};

/// Contact dynamics of rigid discs, Moreau's mid-point scheme (theta = 1/2): normals and lever arms
/// are those half-way through the step; Newton's restitution uses the velocities at its beginning,
/// so that resting contacts do not rattle; nothing pushes overlap out, so no energy enters that
/// way.
///
/// Which pairs act, and how, is stated in sim/contact/contact_law.hpp.
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
  /// Goes on from `state`: with the same world, the steps that follow are the same to the last bit.
  /// FormatError as in PairList::restore.
  Simulation(const World& world, const State& state);

  StepReport advance();
  /// The same, and writes the step down in `frame`.
  StepReport advance(Frame& frame);

  State state() const;

  const World& world() const { return world_; }
  std::int64_t steps_done() const { return steps_done_; }
  double time() const { return static_cast<double>(steps_done_) * world_.step; }  // s

  /// Turns gravity: the slope is tilted, and may go on turning, by the clock.
  void tilt(const Gravity& gravity)
  {
    gravity_ = gravity;
    world_.gravity = gravity.at(time());
  }
  /// From now on boundary grains move so.
  void drive(const std::vector<BoundaryBody>& bodies) { world_.bodies = bodies; }
  /// Sets the number of steps done, and with it the time; negative before the tilt.
  void set_clock(std::int64_t steps) { steps_done_ = steps; }

  /// Position of grain g, unwrapped: where it would be were nothing periodic.
  Vec2 position(std::size_t g) const;
  Vec2 velocity(std::size_t g) const { return {motion(g).vx, motion(g).vy}; }
  double angular_velocity(std::size_t g) const
  {
    return motion(g).rim_speed / world_.grains.radius[g];
  }
  void set_velocity(std::size_t g, const Vec2& velocity, double angular_velocity = 0);

  /// Energies of the mobile grains, J (per metre of depth): of translation, of rotation, and in the
  /// field of gravity, zero at the origin.
  double translational_energy() const;
  double rotational_energy() const;
  double potential_energy() const;

  /// Motion of each grain at the beginning of the last step that was written down.
  const std::vector<Motion>& before() const { return before_; }

  std::size_t pair_list_renewals() const { return pairs_.renewals(); }

 private:
  const Motion& motion(std::size_t g) const { return state_.motion[body_of_[g]]; }
  StepReport step(Frame* frame);
  void move_grains(double duration);
  void look_ahead();
  void move_to_middle();
  std::span<Pairs::Memory> memories();
  void renew_pairs();
  void find_contacts(StepReport& report);
  /// m/s, of grains that may have passed each other since the last list, or before the first one.
  double unseen_approach() const;
  void solve(StepReport& report);
  [[noreturn]] void stop_at_coincidence() const;
  void drive_bodies();
  void apply_gravity(double duration);
  void apply_loads(double duration);
  void keep_impulses(StepReport& report);
  void wrap_positions();
  void write_down(Frame& frame) const;
  void write_down_positions(Frame& frame) const;
  void write_down_contacts(ContactList& list) const;
  std::int32_t wall_name(std::size_t pair) const;
  void write_down_motion(Frame& frame) const;

  World world_;
  Gravity gravity_;
  Effects effects_;
  int threads_;
  PairList pairs_;
  GrainState state_;
  std::vector<std::uint32_t> body_of_;  // where in the state each grain is
  std::vector<Vec2> ahead_;             // m, positions looked at: after a forecast of free flight
  std::vector<Motion> before_;          // by row, at the beginning of a step that is written down
  std::vector<StripContacts> contacts_;
  Extrapolation extrapolation_;
  std::int64_t steps_done_ = 0;
  bool restored_ = false;  // the contacts of the step before are not known, only their impulses
};

}  // namespace grseg
