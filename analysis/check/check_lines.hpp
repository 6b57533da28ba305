// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/check/checks.hpp"
#include "analysis/check/laws_of_motion.hpp"
#include "analysis/frames/sums.hpp"
#include "formats/cli/provenance.hpp"
#include "formats/core/verdict.hpp"

#include <cstddef>
#include <string>
#include <vector>

namespace grseg {

/// A quantity that was held against a tolerance. It is undecided if it is statistical and within what
/// chance alone explains, where that is more than the tolerance: a deviation that the tolerance does
/// not allow would not have been seen.
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
/// {"lines": [{"quantity", "layer", "measured", ...}, ...], "passed", "undecided", "settings", "history"}
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
