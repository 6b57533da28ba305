// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>

namespace grseg {

/// The largest and the mean of what goes wrong in many places, none of it below 0, and the place of
/// the largest.
struct WorstCase {
  double largest = 0, sum = 0;
  double count = 0;        // of the places looked at
  double time = 0;         // s, of the largest
  std::size_t number = 0;  // of the grain or contact, likewise

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
  /// Adds what another has seen later.
  void merge(const WorstCase& other)
  {
    if (other.count > 0 && (count == 0 || other.largest > largest)) {
      largest = other.largest;
      time = other.time;
      number = other.number;
    }
    sum += other.sum;
    count += other.count;
  }
  double mean() const { return count > 0 ? sum / count : 0; }
};

}  // namespace grseg
