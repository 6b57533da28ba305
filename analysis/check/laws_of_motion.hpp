// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/core/frame.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace grseg {

/// The largest and the mean of violations at many places, none of them negative, and the place of
/// the largest.
struct WorstCase {
  double largest = 0, sum = 0;
  double count = 0;        // of the places
  double time = 0;         // s, of the largest
  std::size_t number = 0;  // of the grain or contact of the largest

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

/// Newton's and Euler's laws for every mobile grain, in the step that a frame stands for:
///   sum of its contact forces + m g = m (v_after - v_before)/h, which the file stores as `force`;
///   sum of its torques = I (w_after - w_before)/h, where two frames are consecutive steps; I is
///   m r^2/2 of a disc and 2/5 m r^2 of a sphere.
/// The force between two grains acts at r_i/(r_i + r_j) of the branch, so that the lever arms add
/// up to the distance of the centres; at a straight wall the arm is r_i. Both laws hold to
/// round-off, whatever the solver's tolerance.
template <int D>
class ForceBalance {
 public:
  /// Gravity and the step h, s.
  ForceBalance(const Gravity<D>& gravity, double step) : gravity_(gravity), step_(step) {}

  /// Frames in order. A frame without `force` counts for torques only.
  void add(const Grains& grains, const Frame<D>& frame);

  /// |defect| over the frame's largest force, weights included; by grain.
  WorstCase forces;
  /// |defect| over that force times the largest radius; empty where no frames are consecutive,
  /// or their steps were taken in parts.
  WorstCase torques;

 private:
  struct Turning {
    std::int64_t step = 0;
    double time = 0, scale = 0;               // s, N m
    std::vector<Spin<D>> inertia_times_spin;  // kg m^2/s; of mobile grains, 0 of others
    std::vector<Spin<D>> torque;              // N m; of mobile grains, 0 of others
  };
  void add_forces(const Grains& grains, const Frame<D>& frame, double scale);
  void add_torques(const Turning& before, const Turning& after);

  Gravity<D> gravity_;
  double step_;
  Turning last_;  // of the last frame added; inertia_times_spin is empty before the first
};

/// The mobile grains of a frame as one body. Velocities are those after the step.
template <int D>
struct TotalMotion {
  std::int64_t step = 0;
  double time = 0;                         // s
  double mass = 0;                         // kg
  Vector<D> momentum = Vector<D>::Zero();  // kg m/s
  double energy = 0;                       // J, kinetic, of translation
  Vector<D> centre = Vector<D>::Zero();    // m, of mass, periods counted
  std::uint64_t grains = 0;                // which_are_absent()
};
template <int D>
TotalMotion<D> total_motion(const Grains& grains, const Frame<D>& frame, const Box& box);

/// The mobile grains as one body from frame to frame:
///   momentum now - momentum before = (time between) (M g + mean force of base and walls),
/// which holds to round-off where that mean (/observables/base_force_x, _y, and _z of spheres) is
/// over all the steps between; and the distance that the centre of mass moves against the integral
/// of its velocity over time (trapezium rule). Between frames of different grains neither is
/// defined, and nothing counts.
template <int D>
class MotionBalance {
 public:
  /// Gravity and the step, s.
  MotionBalance(const Gravity<D>& gravity, double step) : gravity_(gravity), step_(step) {}

  /// Frames in order; `base_force` (N) is the mean over the steps since the frame before.
  void add(const TotalMotion<D>& now, const std::optional<Vector<D>>& base_force);

  /// |defect| over the larger of the impulses of gravity and of the base, by frame.
  const WorstCase& momentum() const { return momentum_; }

  std::size_t frames() const { return frames_; }
  /// True where all frames had the same grains.
  bool same_grains() const { return same_grains_; }
  /// m: the distance moved along an axis less that by velocity, since the first frame.
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
  Vector<D> by_velocity_ = Vector<D>::Zero();  // m
  WorstCase momentum_;
};

/// Checks the sum of partial stresses: sigma^nu summed over the species nu is sigma in the whole
/// bed (Staron & Phillips 2015, eq. 1), where
///   sigma^nu = (1/V) sum over contact ends on grains of nu of (force on the grain) (x) (x - c),
/// c the contact point, from the positions x of the grains. sigma is made by PartialContactStress
/// from the branches of the contacts. The stress of each species is also compared with
/// PartialContactStress (rule contact-point), and the sum of all by size with the total.
template <int D>
class StressClosure {
 public:
  /// `species`: of mobile grains.
  StressClosure(const Box& box, std::size_t species) : box_(box), species_(species) {}

  void add(const Grains& grains, const Frame<D>& frame);

  /// Largest component of the differences over the largest of sigma, by frame.
  WorstCase defect;

 private:
  Box box_;
  std::size_t species_;
};

class TrajectoryReader;

/// The contact law of a run, as its /parameters say; docs/studies/accuracy.md gives the laws.
struct ContactRules {
  std::optional<double> friction;     // Coulomb's mu
  std::optional<double> restitution;  // Newton's e
  double step = 0;                    // h, s
  /// Steps of free flight from mid-step after which a pair must touch to exert a force; 0: at
  /// mid-step.
  double look_ahead = 0;
  double margin = 0;     // m, within which a pair counts as touching then
  std::string accuracy;  // preset of the solver, "" where the file names none
  double horizon = 0;    // steps in which a pair that is still apart may close its gap; 0: may not
};

/// A run without the name of a law is one of pairs that touch at mid-step. FormatError where
/// the law is not known. What a law means is decided in sim/contact/contact_law.hpp, which analysis
/// must not include: a new law is named here, too.
ContactRules read_contact_rules(const TrajectoryReader& run);

/// Largest departures of a run's contacts from the laws of Coulomb, Signorini and Newton. With n
/// from j to i, f_n and f_t the parts of the force on i, and u the velocity of i relative to j
/// along n (u' before the step, from `force`):
///   Coulomb     |f_t| <= mu f_n                         (to round-off: each sweep ends with it)
///   tension     f_n >= 0                                (to round-off)
///   open gap    a force acts only where the pair, after `look_ahead` steps of free flight at the
///               velocities before the step, would be within `margin` of touching  (to round-off)
///   approach    u >= -e u' where the pair touches; where it does not, u >= -gap/(horizon h), or
///               -e u' where that is less (to the solver's tolerance; the deficit turns into
///               overlap, u h per step)
///   overlap     of pairs with gap < 0
class ContactViolations {
 public:
  explicit ContactViolations(const ContactRules& rules) : rules_(rules) {}

  /// s, of the frames that follow: of the rules, unless steps were taken in parts.
  void use_step(double step) { rules_.step = step; }
  template <int D>
  void add(const Grains& grains, const Frame<D>& frame);

  // By contact; forces over the largest contact force of the frame.
  WorstCase coulomb;   // (|f_t| - mu f_n)/f_max
  WorstCase tension;   // -f_n/f_max
  WorstCase open_gap;  // m, gap beyond the margin
  WorstCase approach;  // m, deficit of velocity times h
  WorstCase overlap;   // m

 private:
  template <int D>
  void add_forces(const Frame<D>& frame, std::size_t contact, double scale);
  template <int D>
  void add_motion(const Grains& grains, const Frame<D>& frame, std::size_t contact);

  ContactRules rules_;
};

}  // namespace grseg
