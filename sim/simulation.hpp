// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/frame.hpp"
#include "sim/pair_list.hpp"
#include "sim/solver.hpp"

#include <cstdint>
#include <vector>

namespace grseg {

/// Everything that stays the same while a simulation runs.
struct World {
  Grains grains;
  std::vector<Wall> walls;
  Box box;
  Material material;
  bool rotation = true;
  Vec2 gravity = Vec2::Zero();  // m/s^2
  double step = 0;              // h, s
  SolverSettings solver;
  double skin = 0;  // m, of the pair list; 0 chooses 0.4 of the smallest diameter
};

/// What one step did.
struct StepReport {
  SolverReport solver;
  std::size_t touching = 0;          ///< pairs with gap <= 0 at mid-step
  std::size_t force_bearing = 0;     ///< contacts that carry an impulse
  double sum_overlap = 0;            ///< m, of -gap over the touching pairs
  double largest_overlap = 0;        ///< m
  double sum_gap_bearing = 0;        ///< m, of |gap| over force-bearing contacts
  double fastest_approach = 0;       ///< m/s, of a touching pair at the beginning of the step
  Vec2 base_impulse = Vec2::Zero();  ///< kg m/s, of boundary grains and walls on mobile grains
};

/// Contact dynamics of rigid discs, Moreau's mid-point scheme (theta = 1/2): contacts are looked
/// for where the grains are half-way through the step; Newton's restitution uses the velocities at
/// the beginning of the step, so that resting contacts do not rattle; nothing pushes overlap out,
/// so no energy enters that way. A pair counts as touching when its gap at mid-step is <= 0.
class Simulation {
 public:
  /// Grains start at `position` at rest.
  Simulation(const World& world, const std::vector<Vec2>& position);

  StepReport advance();
  /// The same, and writes the step down in `frame`.
  StepReport advance(Frame& frame);

  const World& world() const { return world_; }
  std::int64_t steps_done() const { return steps_done_; }
  double time() const { return static_cast<double>(steps_done_) * world_.step; }  // s

  /// Turns gravity: the slope is tilted.
  void tilt(const Vec2& gravity) { world_.gravity = gravity; }
  /// Sets the number of steps done, and with it the time; negative before the tilt.
  void set_clock(std::int64_t steps) { steps_done_ = steps; }

  /// Position of grain g, unwrapped: where it would be were nothing periodic.
  Vec2 position(std::size_t g) const;
  Vec2 velocity(std::size_t g) const { return {motion_[g].vx, motion_[g].vy}; }
  double angular_velocity(std::size_t g) const
  {
    return motion_[g].rim_speed / world_.grains.radius[g];
  }
  void set_velocity(std::size_t g, const Vec2& velocity, double angular_velocity = 0);

  /// Energies of the mobile grains, J (per metre of depth): of translation, of rotation, and in the
  /// field of gravity, zero at the origin.
  double translational_energy() const;
  double rotational_energy() const;
  double potential_energy() const;

  std::size_t pair_list_renewals() const { return pairs_.renewals(); }

 private:
  StepReport step(Frame* frame);
  void move_grains(double duration);
  void find_contacts(StepReport& report);
  [[noreturn]] void stop_at_coincidence(const PairList::Pair& pair) const;
  void add_contact(std::size_t pair, double nx, double ny, double kappa, double gap,
                   StepReport& report);
  void apply_gravity(double duration);
  void keep_impulses(StepReport& report);
  void wrap_positions();
  void write_down(Frame& frame) const;
  void write_down_positions(Frame& frame) const;
  void write_down_contacts(ContactList& list) const;
  void write_down_motion(Frame& frame) const;

  World world_;
  Effects effects_;
  PairList pairs_;
  std::vector<Vec2> position_;  // m
  std::vector<std::array<std::int32_t, 2>> image_;
  std::vector<Motion> motion_;  // one per grain, then one that stands for all walls
  std::vector<Motion> before_;  // at the beginning of a step that is written down
  std::vector<Contact> contacts_;
  ContactSolver solver_;
  std::vector<std::size_t> pair_of_contact_;
  std::vector<double> gap_;  // m, per contact
  std::int64_t steps_done_ = 0;
};

}  // namespace grseg
