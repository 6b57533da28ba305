// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/check/checks.hpp"
#include "analysis/check/report.hpp"
#include "analysis/check/tolerances.hpp"
#include "analysis/check/worst_case.hpp"

#include <cstddef>
#include <string>

namespace grseg {

/// Holds what was measured against the tolerance of its check: makes the lines of the report.
class Judge {
 public:
  /// `single_precision`: the file stores float32.
  Judge(const CheckTolerances& tolerances, bool single_precision)
      : tolerances_(tolerances), single_precision_(single_precision)
  {
  }

  static CheckLine skipped(const Check& check, const std::string& why);
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
