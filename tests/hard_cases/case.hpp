// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <utility>

namespace grseg::hard_cases {

/// One line of the table of scripts/hard-cases: expectation and result of a hard case. Each check is
/// also an expectation of the test. The check that came nearest to its bound is recorded as a
/// property of the test, with the key "H13: what" and the value
/// "expected<tab>measured<tab>bound<tab>used", which scripts/hard-cases collects.
class Case {
 public:
  /// `name` is the number of the case in docs/studies/hard-cases.md, as H13.
  Case(const std::string& name, const std::string& what) : key_(name + ": " + what) {}
  Case(const Case&) = delete;
  Case& operator=(const Case&) = delete;
  ~Case()
  {
    if (used_ < 0) return;
    testing::Test::RecordProperty(key_,
                                  fmt::format("{}\t{:.4g}\t{}", expected_, measured_, bound_));
  }

  /// Checks that `measured` differs from `expected` by at most `bound`.
  void near(double measured, double expected, double bound)
  {
    const double error = std::abs(measured - expected);
    // Not "error > bound": NaN must not pass.
    if (!(error <= bound))
      ADD_FAILURE() << fmt::format("{} is {:.17g}, not {:.17g} +- {:.3g}", key_, measured, expected,
                                   bound);
    // A small error would not be visible in the digits of `measured`.
    const bool visible = error > 1e-4 * std::abs(expected);
    keep(bound > 0 ? error / bound : (error > 0 ? 2 : 0), fmt::format("{:.6g}", expected),
         visible ? measured : error,
         visible ? fmt::format("± {:.2g}", bound) : fmt::format("error ≤ {:.2g}", bound));
  }

  /// Checks that `measured` is at most `bound`; both are positive or zero.
  void at_most(double measured, double bound)
  {
    if (!(measured <= bound))
      ADD_FAILURE() << fmt::format("{} is {:.17g}, above {:.3g}", key_, measured, bound);
    keep(bound > 0 ? measured / bound : (measured > 0 ? 2 : 0), "0", measured,
         fmt::format("≤ {:.2g}", bound));
  }

  /// Checks that `measured` is between `low` and `high`.
  void between(double measured, double low, double high)
  {
    if (!(low <= measured && measured <= high))
      ADD_FAILURE() << fmt::format("{} is {:.17g}, not in {:.6g} to {:.6g}", key_, measured, low,
                                   high);
    const double middle = (low + high) / 2;
    keep(std::abs(measured - middle) / (high - middle), fmt::format("{:.4g} to {:.4g}", low, high),
         measured, "inside");
  }

  /// Checks a statement that is true or false.
  void holds(bool fact)
  {
    if (!fact) ADD_FAILURE() << key_ << " does not hold";
    keep(fact ? 0 : 2, "yes", fact ? 1 : 0, "exact");
  }

 private:
  void keep(double part, std::string expected, double measured, std::string bound)
  {
    if (part <= used_) return;
    used_ = part;
    expected_ = std::move(expected);
    measured_ = measured;
    bound_ = fmt::format("{}\t{:.3g}", bound, part);
  }

  std::string key_;
  double used_ = -1;  // largest part of the bound that a check has used
  std::string expected_, bound_;
  double measured_ = 0;
};

}  // namespace grseg::hard_cases
