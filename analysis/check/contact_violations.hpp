// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/check/worst_case.hpp"
#include "formats/core/frame.hpp"

#include <optional>

namespace grseg {

/// What the contacts of a run obey, as its /parameters say.
struct ContactRules {
  std::optional<double> friction;     // Coulomb's mu
  std::optional<double> restitution;  // Newton's e
  double step = 0;                    // h, s
  /// Where on its free flight from mid-step, in steps, a pair must touch to act; 0 at mid-step.
  double look_ahead = 0;
  double margin = 0;   // m, within which it counts as touching there
  double horizon = 0;  // steps in which a pair still apart may close its gap; 0 not at all
};

/// How far the contacts of a run are from Coulomb's, Signorini's and Newton's laws. With n from j
/// to i, f_n and f_t the parts of the force on i, and u the velocity of i less that of j along n
/// (u' before the step, from `force`):
///   Coulomb     |f_t| <= mu f_n                         (exact: each sweep ends with it)
///   tension     f_n >= 0                                (likewise)
///   open gap    a force acts only where the pair, after `look_ahead` steps of free flight at the
///               velocities before the step, would be within `margin` of touching  (likewise)
///   approach    u >= e max(-u', 0) where the pair touches, u >= -gap/(horizon h) where it does not
///               (to the solver's tolerance; what is lacking makes overlap, u h per step)
///   overlap     of pairs with gap < 0
/// The laws of contact are those of docs/studies/numerics.md.
class ContactViolations {
 public:
  explicit ContactViolations(const ContactRules& rules) : rules_(rules) {}

  void add(const Grains& grains, const Frame& frame);
  /// Adds what another has seen later.
  void merge(const ContactViolations& later);

  // By contact; forces over the largest contact force of the frame.
  const WorstCase& coulomb() const { return coulomb_; }    // (|f_t| - mu f_n)/f_max
  const WorstCase& tension() const { return tension_; }    // -f_n/f_max
  const WorstCase& open_gap() const { return open_gap_; }  // m, gap beyond the margin there
  const WorstCase& approach() const { return approach_; }  // m, velocity that is lacking times h
  const WorstCase& overlap() const { return overlap_; }    // m

 private:
  void add_forces(const Frame& frame, std::size_t contact, double scale);
  void add_motion(const Grains& grains, const Frame& frame, std::size_t contact);

  ContactRules rules_;
  WorstCase coulomb_, tension_, open_gap_, approach_, overlap_;
};

}  // namespace grseg
