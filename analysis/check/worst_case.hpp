// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>

namespace grseg {

/// The largest and the mean of violations at many places, none of them negative, and the place of
/// the largest.
struct WorstCase {
  double largest = 0, sum = 0;
  double count = 0;        // of the places
  double time = 0;         // s, of the largest
  std::size_t number = 0;  // of the grain or contact of the largest

  void add(double value, double at, std::size_t what)
  {
    sum += value;
    if (count == 0 || value > largest) {
      largest = value;
      time = at;
      number = what;
    }
    ++count;
  }
  double mean() const { return count > 0 ? sum / count : 0; }
};

}  // namespace grseg
