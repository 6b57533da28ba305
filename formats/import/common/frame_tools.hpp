// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/core/frame.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

/// Helpers to build and verify frames. Until a frame of an import is written, its vectors have
/// three components. In a flow in a plane the component across the plane is 0.
namespace grseg {

/// The shortest vector that differs from `between` by whole periods of the cell.
inline Vec3 minimum_image(const Box& box, Vec3 between)
{
  if (box.periodic_x) between.x() -= box.length_x * std::round(between.x() / box.length_x);
  if (box.periodic_z) between.z() -= box.length_z * std::round(between.z() / box.length_z);
  return between;
}

/// A grain's row, converted to the type of an array index.
inline std::size_t row(std::int32_t index)
{
  return static_cast<std::size_t>(index);
}

/// The smallest and the largest of some positive numbers.
struct Range {
  double low = INFINITY, high = 0;

  void add(double value)
  {
    low = std::min(low, value);
    high = std::max(high, value);
  }
  double middle() const { return (low + high) / 2; }
};

/// Quantile: a fraction `share` of the values is smaller; 0 if there are no values. Reorders them.
inline double quantile(std::vector<double>& values, double share)
{
  if (values.empty()) return 0;
  const auto place =
      values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size()));
  std::nth_element(values.begin(), place, values.end());
  return *place;
}

/// Median; the larger of the two middle values if their number is even.
inline double median(std::vector<double>& values)
{
  return quantile(values, 0.5);
}

}  // namespace grseg
