// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/core/frame.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace grseg {

/// Largest value, mean, and place of the largest value, of the violations (>= 0) of a law by many
/// grains or contacts in many frames.
struct WorstCase {
  double largest = 0, sum = 0;  // largest violation; sum of all violations
  double count = 0;             // number of violations added
  double time = 0;              // time of the largest violation, s
  std::size_t number = 0;       // grain or contact with the largest violation

  void add(double value, double at, std::size_t what)
  {
    sum += value;
    if (count == 0 || value > largest) {
      largest = value;
      time = at;
      number = what;
    }
    ++count;
  }
  double mean() const { return count > 0 ? sum / count : 0; }
};

/// Checks Newton's and Euler's laws for every mobile grain in the time step of a frame:
///   sum of its contact forces + m g = m (v_after - v_before)/h, which the file stores as `force`;
///   sum of its torques = I (w_after - w_before)/h, if two frames are consecutive steps;
///   I = m r^2/2 for a disc and 2/5 m r^2 for a sphere.
/// The force between two grains acts at the fraction r_i/(r_i + r_j) of the branch, so that the
/// lever arms add up to the distance of the centres; at a straight wall the arm is r_i. Both laws
/// hold to round-off for any tolerance of the solver.
template <int D>
class ForceBalance {
 public:
  /// `step` is the time step h, s.
  ForceBalance(const Gravity<D>& gravity, double step) : gravity_(gravity), step_(step) {}

  /// Adds the next frame, in order of time. A frame without `force` is checked for torques only.
  void add(const Grains& grains, const Frame<D>& frame);

  /// Residual of Newton's law of a grain, over the frame's largest force (weights included).
  WorstCase forces;
  /// Residual of Euler's law of a grain, over (largest force x largest radius). Empty if no frames
  /// are consecutive steps, or if the simulator divided these steps into parts.
  WorstCase torques;

 private:
  struct Turning {
    std::int64_t step = 0;
    double time = 0, scale = 0;               // s; largest force x largest radius, N m
    std::vector<Spin<D>> inertia_times_spin;  // by grain, kg m^2/s; 0 for grains that do not move
    std::vector<Spin<D>> torque;              // by grain, N m; 0 for grains that do not move
  };
  void add_forces(const Grains& grains, const Frame<D>& frame, double scale);
  void add_torques(const Turning& before, const Turning& after);

  Gravity<D> gravity_;
  double step_;
  Turning last_;  // spins and torques of the last frame added; empty before the first frame
};

/// Motion of all mobile grains of a frame as one body. Velocities are as stored: after the step.
template <int D>
struct TotalMotion {
  std::int64_t step = 0;
  double time = 0;                         // time of the frame, s
  double mass = 0;                         // total mass, kg
  Vector<D> momentum = Vector<D>::Zero();  // total momentum, kg m/s
  double energy = 0;                       // kinetic energy of translation, J
  Vector<D> centre = Vector<D>::Zero();    // centre of mass, m, from unwrapped positions
  Vector<D> speed = Vector<D>::Zero();     // velocity of the centre at the time of `centre`, m/s
  std::uint64_t grains = 0;                // which_are_absent() of the frame
};

/// `step` (s) is the time step of a frame with positions at the middle of a step and velocities at
/// its end; 0 if both are of one instant, as in imported runs.
template <int D>
TotalMotion<D> total_motion(const Grains& grains, const Frame<D>& frame, const Box& box,
                            double step);

/// Checks the motion of all mobile grains as one body, from frame to frame:
///   momentum now - momentum before = (time between) (M g + mean force of base and walls).
/// This holds to round-off if the mean force (/observables/base_force_x, _y, and _z for spheres) is
/// over all steps between the two frames. Also compares the distance that the centre of mass moves
/// with the integral of its velocity at the times of the positions (trapezium rule). Pairs of frames
/// with different grains are skipped, because both quantities are then undefined.
template <int D>
class MotionBalance {
 public:
  /// `step` is the time step, s.
  MotionBalance(const Gravity<D>& gravity, double step) : gravity_(gravity), step_(step) {}

  /// Adds the next frame, in order of time. `base_force` (N) is the mean force of base and walls
  /// over the steps since the frame before.
  void add(const TotalMotion<D>& now, const std::optional<Vector<D>>& base_force);

  /// Residual of the momentum balance, over the larger of the impulses of gravity and base.
  const WorstCase& momentum() const { return momentum_; }

  std::size_t frames() const { return frames_; }
  /// True if all frames had the same grains.
  bool same_grains() const { return same_grains_; }
  /// Distance (m) that the centre of mass moved along an axis since the first frame, minus the
  /// distance that follows from its velocity.
  double stray(int axis) const
  {
    return first_ ? last_.centre[axis] - first_->centre[axis] - by_velocity_[axis] : 0;
  }

 private:
  Gravity<D> gravity_;
  double step_;
  std::size_t frames_ = 0;
  bool same_grains_ = true;
  std::optional<TotalMotion<D>> first_;
  TotalMotion<D> last_;
  Vector<D> by_velocity_ = Vector<D>::Zero();  // integral of the velocity since first_, m
  WorstCase momentum_;
};

/// Checks that the partial stresses sigma^nu of all species nu add up to the stress sigma of the
/// whole bed (Staron & Phillips 2015, eq. 1), where
///   sigma^nu = (1/V) sum over contact ends on grains of nu of (force on the grain) (x) (x - c),
/// with the position x of the grain and the contact point c. sigma comes from PartialContactStress,
/// which uses the branches of the contacts. Also compares each sigma^nu with PartialContactStress
/// under the rule contact-point, and the sum over species under the rule size with the total.
template <int D>
class StressClosure {
 public:
  /// `species` is the number of mobile species.
  StressClosure(const Box& box, std::size_t species) : box_(box), species_(species) {}

  void add(const Grains& grains, const Frame<D>& frame);

  /// Largest component of all differences, over the largest component of sigma; one per frame.
  WorstCase defect;

 private:
  Box box_;
  std::size_t species_;
};

class TrajectoryReader;

/// Contact law of a run, from its /parameters; docs/studies/accuracy.md describes the laws.
struct ContactRules {
  std::optional<double> friction;     // Coulomb's coefficient mu; empty if the file names none
  std::optional<double> restitution;  // Newton's coefficient e; empty if the file names none
  double step = 0;                    // time step h, s
  /// A force is allowed between pairs that would touch after a free flight of this many steps from
  /// mid-step; 0: pairs that touch at mid-step.
  double look_ahead = 0;
  double margin = 0;     // largest gap after this flight at which a pair counts as touching, m
  std::string accuracy;  // accuracy preset of the solver; "" if the file names none
  double horizon = 0;    // steps in which a pair that is still apart may close its gap; 0: may not
};

/// Reads the contact law. A run that names no law is treated as `touch` (pairs touch at mid-step).
/// Throws FormatError for an unknown law. Laws are defined in sim/contact/contact_law.hpp, which
/// analysis must not include, so a new law must be added to this function, too.
ContactRules read_contact_rules(const TrajectoryReader& run);

/// Largest violations of the laws of Coulomb, Signorini and Newton by the contacts of a run. The
/// unit vector n points from j to i; f_n and f_t are the components of the force on i; u is the
/// velocity of i relative to j along n (u' before the step, computed from `force`):
///   Coulomb     |f_t| <= mu f_n                         (to round-off: each sweep ends with it)
///   tension     f_n >= 0                                (to round-off)
///   open gap    a force acts only if the pair, after `look_ahead` steps of free flight at the
///               velocities before the step, would be within `margin` of touching  (to round-off)
///   approach    u >= -e u' if the pair touches; if not, u >= the smaller of -gap/(horizon h) and
///               -e u'  (to the solver's tolerance; the missing velocity turns into overlap, u h
///               per step)
///   overlap     overlap of pairs with gap < 0
class ContactViolations {
 public:
  explicit ContactViolations(const ContactRules& rules) : rules_(rules) {}

  /// Sets the time step (s) of the next frames, which differs from ContactRules::step if the
  /// simulator divided a step.
  void use_step(double step) { rules_.step = step; }
  template <int D>
  void add(const Grains& grains, const Frame<D>& frame);

  // Violations of contacts; f_max is the largest contact force of the frame.
  WorstCase coulomb;   // (|f_t| - mu f_n)/f_max
  WorstCase tension;   // -f_n/f_max
  WorstCase open_gap;  // gap beyond the margin, m
  WorstCase approach;  // missing separation velocity times h, m
  WorstCase overlap;   // overlap of a pair, m

 private:
  template <int D>
  void add_forces(const Frame<D>& frame, std::size_t contact, double scale);
  template <int D>
  void add_motion(const Grains& grains, const Frame<D>& frame, std::size_t contact);

  ContactRules rules_;
};

}  // namespace grseg
