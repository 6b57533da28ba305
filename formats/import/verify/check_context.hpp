// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/core/frame.hpp"
#include "formats/core/parameters.hpp"
#include "formats/core/species.hpp"
#include "formats/core/verdict.hpp"
#include "formats/import/facts/units.hpp"

#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

/// Findings of the verification of an import. Every check has a name, by which it can be waived:
///
///   contacts      they join grains that touch, and each is listed once
///   completeness  grains that overlap are listed, and none are parts of one body
///   overlap       they are not too deep
///   pull          they push rather than pull
///   balance       they add up to the force on each grain
///   gravity       the weight of the grains is their mass times gravity as given
///   masses        small and large grains weigh what their masses say
///   sizes         small grains are smaller than large ones
///   time          displacements are velocity times time
namespace grseg {

inline constexpr const char* check_names[] = {
    "contacts", "completeness", "overlap", "pull", "balance", "gravity", "masses", "sizes", "time"};

/// The answer of one check.
struct Finding {
  std::string check;
  Verdict verdict = Verdict::passed;
  std::string sentence;
  double measure = 0;  // what --accept-residual NAME=R is compared with
};

/// Values of --accept-residual: the largest accepted measure of each check that is named.
class Waivers {
 public:
  Waivers() = default;
  /// From "NAME=R", or "R" for balance=R. UsageError for another check or another number.
  explicit Waivers(const std::vector<std::string>& texts);

  std::optional<double> of(const std::string& check) const;
  /// The limit of a check: what is accepted, or else `otherwise`.
  double limit(const std::string& check, double otherwise) const
  {
    return of(check).value_or(otherwise);
  }
  /// "balance=0.1 overlap=0.6": what the constructor takes, one word each.
  std::string text() const;

  /// The finding as it stands after the waivers: waived where its measure is accepted.
  Finding applied_to(Finding finding) const;

 private:
  std::map<std::string, double> largest_;
};

/// "check: sentence" of all findings with this verdict; "" where there are none.
std::string lines_with(const std::vector<Finding>& findings, Verdict verdict,
                       const char* between = "\n");

/// The diameters of the grains of a species, m.
struct SpeciesSizes {
  std::string name, types;  // of the archive, as --small and --large named them; or ""
  double nominal = 0, mean = 0, smallest = 0, largest = 0;
};

/// Facts of an imported run that the checks need; everything is in its file.
struct CheckContext {
  int dimension = 2;
  bool has_force = true;
  Vec3 gravity = Vec3::Zero();        // as given, m/s^2, in the axes of the flow
  std::array<Vec3, 3> axes;           // of the flow, as vectors in the archive's axes
  Units units;                        // of the archive
  double step = 0;                    // s
  double frame_interval = 0;          // s, as given; 0: it is not
  bool gravity_is_given = true;       // on the command line, and not by the archive
  bool masses_are_given = false;      // likewise, as a density
  std::string doubt_of_masses;        // of the import, a sentence
  bool step_is_given = true;          // likewise
  bool times_are_own = false;         // times are the archive's, not steps times their length
  bool steps_are_own = true;          // numbers of steps are the archive's
  double tolerance = 0;               // of the balance, of the program
  std::string reason;                 // of this tolerance
  std::vector<SpeciesSizes> species;  // that have grains, in the order of the file
  double size_ratio = 1;              // of the larger to the smaller grains: mean radii
  Waivers waivers;
};

/// The context from the parameters in the file of an imported run. FormatError naming `file` where
/// it is no import that can be judged.
CheckContext check_context(const Grains& grains, const SpeciesList& species,
                           const Parameters& parameters, bool has_force,
                           const std::string& file = "");

/// Mobile grains with a radius from here on (m) are the larger ones: half-way, as a factor, between
/// the smallest and the largest. 0 where all have nearly the same size.
double split_of_sizes(const Grains& grains);

}  // namespace grseg
