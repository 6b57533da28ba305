// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

/// Round numbers for axes and bars: 1, 2 or 5 times a power of ten.
namespace grseg {

/// A span of numbers, low < high.
struct Range {
  double low = 0, high = 0;
  double length() const { return high - low; }
};

/// Largest round number not above `most`, and smallest one not below `least`; both are positive.
double round_below(double most);
double round_above(double least);

/// Widens a range to multiples of a round step; it then has 3 to 8 steps. Ends within round-off of a
/// multiple stay there. A range without length, at x, becomes x - |x|/2 to x + |x|/2, or 0 to 1 if x is 0.
Range round_range(const Range& range);

/// Multiples of a round step that lie in the range: at most `most` of them, which is at least 2.
std::vector<double> ticks(const Range& range, int most = 6);

/// Ticks as text, with as many decimals as their step needs.
std::vector<std::string> tick_labels(const std::vector<double>& ticks);

/// "5 mm", "2 cm", "1 m".
std::string length_text(double metres);
/// "0 to 5 mm", in the unit of the end that is farther from 0.
std::string lengths_text(const Range& range);

}  // namespace grseg
