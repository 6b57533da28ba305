// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>

namespace grseg {

class TrajectoryReader;

/// The contact law of a run, as its /parameters say; the laws are those of
/// docs/studies/numerics.md.
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

/// Of runs that name no contact law it is that of pairs that touch at mid-step. FormatError where
/// the law is not known. What a law means is decided in sim/contact/contact_law.hpp, which analysis
/// must not include: a new law is named here, too.
ContactRules read_contact_rules(const TrajectoryReader& run);

}  // namespace grseg
