// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/segregation/closure.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

/// A bed that segregates by a closure with known coefficients, and functions that read its summary.
namespace grseg {

inline constexpr double b_over_c = 3e-4, d_over_c = 1.3e-4;   // s, m^2/s
inline constexpr double weight_of_mass = 9.02, layer = 0.02;  // g cos(slope), m/s^2; m
inline const std::vector<PartitionRule> two_rules = parse_rules({"uniform:0.8,half"});

inline Estimate number_of(const NamedNumbers& summary, const std::string& name)
{
  for (const auto& [known, estimate] : summary.numbers)
    if (known == name) return estimate;
  ADD_FAILURE() << name;
  return {};
}

inline bool remarks_hold(const NamedNumbers& summary, const std::string& words)
{
  return std::any_of(
      summary.remarks.begin(), summary.remarks.end(),
      [&](const std::string& remark) { return remark.find(words) != std::string::npos; });
}

/// phi_L of layer n of ten while the bed segregates: large grains are at the bottom at first, at
/// the top at the end.
inline double phi_of(int n, double progress)
{
  return 0.35 + 0.25 * (2 * progress - 1) * (n - 4.5) / 4.5;
}
inline double gradient_of(double progress)
{
  return 0.25 * (2 * progress - 1) / 4.5 / layer;
}

}  // namespace grseg
