// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/check/laws_of_motion.hpp"
#include "analysis/frames/sums.hpp"
#include "formats/cli/provenance.hpp"
#include "formats/core/verdict.hpp"

#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace grseg {

/// Largest accepted deviations of a run from the laws of mechanics: tolerances of round-off, of the
/// solver, and of statistics. A statistical check compares its deviation with its tolerance and
/// with the chance limit: the standard error times the quantile of Student's t at `false_alarm`,
/// which all layers share. It fails if the deviation exceeds both, passes if deviation and chance
/// limit are within the tolerance, and is undecided otherwise.
struct CheckTolerances {
  double round_off = 1e-10, single_precision = 1e-5;     // relative deviation; for float32 files
  double mean_overlap = 5e-3, largest_overlap = 0.1;     // overlap, d_S
  double mean_approach = 1e-3, largest_approach = 0.05;  // missing separation, d_S per step
  double false_alarm = 1e-3;                             // probability of a failure by chance
  double weight = 0.01, slope = 0.005;  // relative load of a layer; stress ratio minus tan(slope)
  double overlap_drift = 1e-3;          // change of the mean overlap over the run, d_S
  double x_drift = 1e-3;                // difference of two mean velocities, sqrt(g d_S)
  double least_load = 0.02;  // smallest load of a checked layer, over the load of the first layer

  /// A tolerance with its command-line option, whose name is also a key in the table's header.
  struct Option {
    const char* name;
    double CheckTolerances::*value;
    const char* meaning;
  };
  static const std::array<Option, 12>& options();
  /// Name of the option that sets a tolerance.
  static const char* option_of(double CheckTolerances::*value);

  /// Throws UsageError, which names the option, if a value is impossible.
  void require_valid() const;
};

/// One check of grseg-check --physics.
struct Check {
  const char* name;      // name of the check's line in the output
  const char* measured;  // measured quantity, in words
  double CheckTolerances::*tolerance;
  const char* law;  // law by which the measured quantity should vanish
  bool of_spheres_only = false;
};

/// Table of all checks, in the order of the output. The output lines, their tolerances and --help
/// are made from it. docs/studies/check.md explains each check.
namespace checks {

using T = CheckTolerances;

inline constexpr auto all = std::to_array<Check>({
    {"force_balance", "|contact forces + m g - `force`| of a grain / the frame's largest force",
     &T::round_off, "Newton's second law"},
    {"torque_balance", "|torques - I dw/dt| of a grain / (frame's largest force x largest radius)",
     &T::round_off, "Euler's second law"},
    {"total_momentum", "change of the bed's momentum - impulses of gravity and base, relative",
     &T::round_off, "Newton's second law"},
    {"sum_of_partials", "sum of the species' partial stresses - stress of the bed, relative",  //
     &T::round_off, "Staron & Phillips 2015, eq. 1"},
    {"energy_defect", "energy that the simulator cannot account for in a step, relative",
     &T::round_off, "Moreau's energy balance"},
    {"coulomb_largest", "|f_t| - mu f_n of a contact / the frame's largest force", &T::round_off,
     "Coulomb's law"},
    {"coulomb_mean", "mean over contacts of the same quantity", &T::round_off, "Coulomb's law"},
    {"tension_largest", "tensile force -f_n of a contact / the frame's largest force",  //
     &T::round_off, "Signorini's law"},
    {"tension_mean", "mean over contacts of the same quantity", &T::round_off, "Signorini's law"},
    {"open_gap_largest", "gap across which a force acts against the contact law, d_S",
     &T::round_off, "Signorini's law"},
    {"open_gap_mean", "mean over contacts of the same quantity", &T::round_off, "Signorini's law"},
    {"approach_largest", "separation velocity that the solver did not reach, d_S per step",  //
     &T::largest_approach, "Newton's law of restitution"},
    {"approach_mean", "mean over contacts of the same quantity",  //
     &T::mean_approach, "Newton's law of restitution"},
    {"overlap_largest", "overlap of a pair, d_S", &T::largest_overlap, "rigid grains"},
    {"overlap_mean", "mean over overlapping pairs", &T::mean_overlap, "rigid grains"},
    {"weight", "stress in a layer / stress required by weight and acceleration above, minus 1",
     &T::weight, "momentum balance along y"},
    {"slope", "stress ratio of a layer - ratio required by slope and acceleration above",  //
     &T::slope, "momentum balance along x"},
    {"slope_across", "slope across the flow (spheres only)",  //
     &T::slope, "momentum balance along z", true},
    {"overlap_drift", "change of the mean overlap over the run, d_S",  //
     &T::overlap_drift, "errors do not accumulate"},
    {"energy_defect_drift", "change of the mean energy defect over the run",  //
     &T::round_off, "errors do not accumulate"},
    {"x_drift", "mean velocity of the bed from positions - from velocities, sqrt(g d_S)",
     &T::x_drift, "velocity is the rate of change of position"},
    {"z_drift", "x_drift across the flow (spheres only)",  //
     &T::x_drift, "velocity is the rate of change of position", true},
});

/// The check of this name. A name that is not in the table does not compile.
consteval Check named(std::string_view name)
{
  for (const auto& check : all)
    if (check.name == name) return check;
  throw "no such check";
}

/// Table of all checks for --help: measured quantity and, on a second line, tolerance and law.
std::string listed();

}  // namespace checks

/// Line of the report: a quantity compared with its tolerance. A statistical quantity is undecided
/// if it is within the chance limit (CheckTolerances) but this limit exceeds the tolerance: the run
/// is too short to show a deviation as small as the tolerance.
struct CheckLine {
  std::string quantity;  // name of the check, or path in the file that deviates from its format
  double y0 = no_number, y1 = no_number;  // bottom and top of a layer, m; NaN: not of a layer
  double measured = no_number;
  double error = no_number;      // standard error of `measured`, if the check is statistical
  double tolerance = no_number;  // tolerance, or the chance limit if that is larger
  Verdict verdict = Verdict::skipped;
  std::string remark;  // place of the largest value, or reason why the check was skipped
};

/// Line of the report for a measured value, which passes if it is within its tolerance.
CheckLine judged(const std::string& quantity, double measured, double tolerance,
                 const std::string& remark = "");
/// Line of the report for a quantity that was not measured; `why` is the reason.
CheckLine skipped(const std::string& quantity, const std::string& why);

/// The output of grseg-check.
struct CheckReport {
  Header header;  // provenance and settings
  std::vector<CheckLine> lines;

  /// One sentence that names every failed line; "" if no line failed.
  std::string failures() const;
  /// One sentence that names each undecided quantity and its number of layers; "" if there is none.
  std::string undecided() const;
};

/// The report as a table (formats/cli/table.hpp), with one row per CheckLine.
std::string to_tsv(const CheckReport& report);
/// The report as JSON: {"lines": [{"quantity", "layer", "measured", ...}, ...], "passed",
/// "undecided", "settings", "history"}.
std::string to_json(const CheckReport& report);

/// Compares measured quantities with the tolerances of their checks, and returns report lines.
class Judge {
 public:
  /// `single_precision`: true if the file stores real numbers as float32.
  Judge(const CheckTolerances& tolerances, bool single_precision)
      : tolerances_(tolerances), single_precision_(single_precision)
  {
  }

  /// Line for the largest violation, divided by `unit`. The remark names its time and its place:
  /// `what` (e.g. "grain") and the number of the grain or contact.
  CheckLine largest(const Check& check, const WorstCase& worst, const std::string& what,
                    double unit = 1) const;
  CheckLine mean(const Check& check, const WorstCase& worst, double unit) const;
  /// Line for a mean over `windows` windows with standard error `error`. The check consists of
  /// `together` such lines (layers), which share the probability of a false alarm.
  CheckLine statistical(const Check& check, double deviation, double error, std::size_t windows,
                        std::size_t together) const;

 private:
  double tolerance_of(const Check& check) const;

  CheckTolerances tolerances_;
  bool single_precision_;
};

}  // namespace grseg
