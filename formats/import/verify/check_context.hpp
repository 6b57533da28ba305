// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/core/frame.hpp"
#include "formats/core/species.hpp"
#include "formats/core/verdict.hpp"
#include "formats/import/facts/units.hpp"

#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

/// Findings of the verification of an import. The name of a check is used in --accept-residual
/// NAME=R, which waives the check up to the measure R:
///
///   contacts      contacts join grains that touch, and each is listed once
///   completeness  overlapping grains are listed as contacts; no grains form a rigid body
///   overlap       overlaps of grains are not too deep
///   pull          contact forces push rather than pull
///   balance       contact forces and weight add up to the force on each grain
///   gravity       the weight of the grains is mass times the stated gravity
///   masses        the weights of small and large grains agree with their masses
///   sizes         small grains are smaller than large grains
///   time          displacements are velocity times time
namespace grseg {

inline constexpr const char* check_names[] = {
    "contacts", "completeness", "overlap", "pull", "balance", "gravity", "masses", "sizes", "time"};

/// The result of one check.
struct Finding {
  std::string check;
  Verdict verdict = Verdict::passed;
  std::string sentence;
  double measure = 0;  // size of the error; --accept-residual NAME=R accepts it up to R
};

/// Waivers (values of --accept-residual): the largest accepted measure of each named check.
class Waivers {
 public:
  Waivers() = default;
  /// Each text is "NAME=R", or "R" for balance=R. Throws UsageError for an unknown check or if R is
  /// not a positive number.
  explicit Waivers(const std::vector<std::string>& texts);

  std::optional<double> of(const std::string& check) const;
  /// The limit of a check: the measure that the user accepts (--accept), or `otherwise` without
  /// one.
  double limit(const std::string& check, double otherwise) const
  {
    return of(check).value_or(otherwise);
  }
  /// The finding with the waivers applied: its verdict is `waived` if its measure is accepted.
  Finding applied_to(Finding finding) const;

 private:
  std::map<std::string, double> largest_;
};

/// Text "check: sentence" of all findings with this verdict; "" if there are none.
std::string lines_with(const std::vector<Finding>& findings, Verdict verdict,
                       const char* between = "\n");

/// The diameters of the grains of a species, m.
struct SpeciesSizes {
  std::string name, types;  // name; types of the archive by --small and --large, or ""
  double nominal = 0, mean = 0, smallest = 0, largest = 0;
};

/// Facts of an imported run that the checks need.
struct CheckContext {
  int dimension = 2;
  bool has_force = true;
  Vec3 gravity = Vec3::Zero();        // stated gravity, m/s^2, in the axes of the flow
  std::array<Vec3, 3> axes;           // axes of the flow, as vectors in the archive's axes
  Units units;                        // units of the archive
  double step = 0;                    // length of a time step, s
  double frame_interval = 0;          // value of --frame-interval, s; 0: not given
  bool gravity_is_given = true;       // true: by the command line; false: by the archive
  bool masses_are_given = false;      // true: by --density; false: by the archive
  std::string doubt_of_masses;        // RunFacts::doubt_of_masses (run_facts.hpp)
  bool step_is_given = true;          // true: by the command line; false: by the archive
  bool times_are_own = false;         // true: the archive states times; false: steps times length
  bool steps_are_own = true;          // true: the archive states numbers of steps
  double tolerance = 0;               // largest residual of force balances in correct output
  std::string reason;                 // reason for this tolerance
  std::vector<SpeciesSizes> species;  // species that have grains, in the order of the file
  double size_ratio = 1;              // mean radius of larger over mean radius of smaller grains
  Waivers waivers;
};

/// Sizes of the species that have grains, in the order of `species`; `types` has a line for each.
std::vector<SpeciesSizes> species_sizes(const Grains& grains, const SpeciesList& species,
                                        const std::string& types);
/// Mean radius of larger over mean radius of smaller mobile grains; 1 if all have nearly one size.
double ratio_of_sizes(const Grains& grains);

/// Radius, m, from which mobile grains count as the larger ones: the geometric mean of the smallest
/// and the largest radius. 0 if all grains have nearly the same size.
double split_of_sizes(const Grains& grains);

}  // namespace grseg
