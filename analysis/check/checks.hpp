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

/// How far a run may be from the laws of mechanics. There are three kinds: tolerances of round-off,
/// of the solver, and of statistics. A statistical check fails only where the deviation is beyond
/// both the number given here and what chance explains, i.e. the quantile of Student's t at
/// `false_alarm`, over all layers together, times the standard error. It passes only where chance
/// explains no more than the number given here: else it is undecided, and a longer run decides.
struct CheckTolerances {
  double round_off = 1e-10, single_precision = 1e-5;     // relative
  double mean_overlap = 5e-3, largest_overlap = 0.1;     // d_S
  double mean_approach = 1e-3, largest_approach = 0.05;  // d_S per step
  double false_alarm = 1e-3;
  double weight = 0.01, slope = 0.005;
  double overlap_drift = 1e-3;  // d_S over the run
  double x_drift = 1e-3;        // sqrt(g d_S)
  double least_load = 0.02;     // of the load of the first layer; layers with less are left out

  /// A tolerance as an option of the command line and a line of the table's header.
  struct Option {
    const char* name;
    double CheckTolerances::*value;
    const char* meaning;
  };
  static const std::array<Option, 12>& options();
  /// The name of the option of a tolerance.
  static const char* option_of(double CheckTolerances::*value);

  /// UsageError, naming the option, where a value makes no sense.
  void require_valid() const;
};

/// One check of grseg-check --physics.
struct Check {
  const char* name;      // of its line in the output
  const char* measured;  // what the number is
  double CheckTolerances::*tolerance;
  const char* law;  // by which the number should vanish
  bool of_spheres_only = false;
};

/// All checks, in the order of the output: the table from which the lines of the output with their
/// tolerances and --help follow. docs/studies/check.md explains each.
namespace checks {

using T = CheckTolerances;

inline constexpr auto all = std::to_array<Check>({
    {"force_balance", "contact forces + m g - `force` of a grain, over the frame's largest force",
     &T::round_off, "Newton's second law"},
    {"torque_balance", "torques - I dw/dt of a grain, over that force and largest radius",
     &T::round_off, "Euler's second law"},
    {"total_momentum", "change of the bed's momentum less the impulses of gravity and base",
     &T::round_off, "Newton's second law"},
    {"sum_of_partials", "stresses of all species less sigma of the bed, over sigma",  //
     &T::round_off, "Staron & Phillips 2015, eq. 1"},
    {"energy_defect", "energy that the simulator cannot account for in a step, relative",
     &T::round_off, "Moreau's energy balance"},
    {"coulomb_largest", "|f_t| - mu f_n of a contact, over the frame's largest force",
     &T::round_off, "Coulomb's law"},
    {"coulomb_mean", "the same, mean over contacts", &T::round_off, "Coulomb's law"},
    {"tension_largest", "-f_n of a contact, over the frame's largest force",  //
     &T::round_off, "Signorini's law"},
    {"tension_mean", "the same, mean over contacts", &T::round_off, "Signorini's law"},
    {"open_gap_largest", "gap across which a force acts against the contact law, d_S",
     &T::round_off, "Signorini's law"},
    {"open_gap_mean", "the same, mean over contacts", &T::round_off, "Signorini's law"},
    {"approach_largest", "deficit of separation velocity, d_S per step",  //
     &T::largest_approach, "Newton's law of restitution"},
    {"approach_mean", "the same, mean over contacts",  //
     &T::mean_approach, "Newton's law of restitution"},
    {"overlap_largest", "overlap, d_S", &T::largest_overlap, "rigid grains"},
    {"overlap_mean", "the same, mean over pairs that overlap", &T::mean_overlap, "rigid grains"},
    {"weight", "stress a layer carries over what weight and acceleration above require, less 1",
     &T::weight, "momentum balance along y"},
    {"slope", "stress ratio of a layer less what slope and acceleration above require",  //
     &T::slope, "momentum balance along x"},
    {"slope_across", "the same across the flow, of spheres",  //
     &T::slope, "momentum balance along z", true},
    {"overlap_drift", "change of the mean overlap over the run, d_S",  //
     &T::overlap_drift, "errors do not accumulate"},
    {"energy_defect_drift", "change of the mean energy defect over the run",  //
     &T::round_off, "errors do not accumulate"},
    {"x_drift", "mean velocity of the bed by positions less that by velocities, sqrt(g d_S)",
     &T::x_drift, "velocity is the rate of position"},
    {"z_drift", "the same across the flow, of spheres",  //
     &T::x_drift, "velocity is the rate of position", true},
});

/// The check of that name. A name that is not in the table does not compile.
consteval Check named(std::string_view name)
{
  for (const auto& check : all)
    if (check.name == name) return check;
  throw "no such check";
}

/// The table as text for --help: for each check what is measured, and below it tolerance and law.
std::string listed();

}  // namespace checks

/// A quantity that was held against a tolerance. It is undecided if it is statistical and within
/// what chance alone explains, where that is more than the tolerance: a deviation that the
/// tolerance does not allow would not have been seen.
struct CheckLine {
  std::string quantity;  // "force_balance", or the path inside the file that departs
  double y0 = no_number, y1 = no_number;  // m, of a layer
  double measured = no_number;
  double error = no_number;      // standard error of `measured`, where it is statistical
  double tolerance = no_number;  // or what chance alone explains, where that is more
  Verdict verdict = Verdict::skipped;
  std::string remark;  // where the largest value is, or why the check was skipped
};

/// A line of the report for a measured value, which passes or fails by its tolerance.
CheckLine judged(const std::string& quantity, double measured, double tolerance,
                 const std::string& remark = "");
/// A line of the report for a quantity that was not measured, with the reason.
CheckLine skipped(const std::string& quantity, const std::string& why);

/// The output of grseg-check.
struct CheckReport {
  Header header;  // provenance and settings
  std::vector<CheckLine> lines;

  /// One sentence that names every line that failed, or "" if none did.
  std::string failures() const;
  /// One sentence that names the undecided quantities with their number, or "" if there are none.
  std::string undecided() const;
};

/// `#` lines, a line of column names, one row per line. Numbers have 17 significant digits.
std::string to_tsv(const CheckReport& report);
/// {"lines": [{"quantity", "layer", "measured", ...}, ...], "passed", "undecided", "settings",
/// "history"}
std::string to_json(const CheckReport& report);

/// Holds what was measured against the tolerance of its check: makes the lines of the report.
class Judge {
 public:
  /// `single_precision`: the file stores float32.
  Judge(const CheckTolerances& tolerances, bool single_precision)
      : tolerances_(tolerances), single_precision_(single_precision)
  {
  }

  /// The largest value, in units of `unit`; `what` ("grain") has the number that the remark names.
  CheckLine largest(const Check& check, const WorstCase& worst, const std::string& what,
                    double unit = 1) const;
  CheckLine mean(const Check& check, const WorstCase& worst, double unit) const;
  /// A mean over `windows` with its standard error, one of `together` such lines.
  CheckLine statistical(const Check& check, double deviation, double error, std::size_t windows,
                        std::size_t together) const;

 private:
  double tolerance_of(const Check& check) const;

  CheckTolerances tolerances_;
  bool single_precision_;
};

}  // namespace grseg
