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

/// Largest round number not above `most`; smallest round number not below `least`. Arguments are positive.
double round_below(double most);
double round_above(double least);

/// Widens a range so that its ends are multiples of a round step; it then has 3 to 8 steps. An end that
/// equals a multiple within round-off is not moved further. A range of length 0 at x becomes x - |x|/2 to
/// x + |x|/2, or 0 to 1 if x is 0.
Range round_range(const Range& range);

/// Multiples of a round step that lie in the range: at most `most` numbers; `most` is at least 2.
std::vector<double> ticks(const Range& range, int most = 6);

/// Texts of the ticks, with as many decimals as their step needs.
std::vector<std::string> tick_labels(const std::vector<double>& ticks);

/// A length as text: "5 mm", "2 cm", "1 m".
std::string length_text(double metres);
/// A range of lengths (m) as text, "0 to 5 mm", in the unit of the end that is farther from 0.
std::string lengths_text(const Range& range);

}  // namespace grseg
