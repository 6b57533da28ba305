// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/check/laws_of_motion.hpp"
#include "formats/core/frame.hpp"

#include <cstddef>
#include <optional>
#include <string>

namespace grseg {

class TrajectoryReader;

/// The contact law of a run, as its /parameters say; the laws are those of
/// docs/studies/accuracy.md.
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

/// How far the contacts of a run are from the laws of Coulomb, Signorini and Newton. With n from j
/// to i, f_n and f_t the parts of the force on i, and u the velocity of i less that of j along n
/// (u' before the step, from `force`):
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
  const WorstCase& coulomb() const { return coulomb_; }    // (|f_t| - mu f_n)/f_max
  const WorstCase& tension() const { return tension_; }    // -f_n/f_max
  const WorstCase& open_gap() const { return open_gap_; }  // m, gap beyond the margin
  const WorstCase& approach() const { return approach_; }  // m, deficit of velocity times h
  const WorstCase& overlap() const { return overlap_; }    // m

 private:
  template <int D>
  void add_forces(const Frame<D>& frame, std::size_t contact, double scale);
  template <int D>
  void add_motion(const Grains& grains, const Frame<D>& frame, std::size_t contact);

  ContactRules rules_;
  WorstCase coulomb_, tension_, open_gap_, approach_, overlap_;
};

}  // namespace grseg
