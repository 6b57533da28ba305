// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

/// Numbers that people like to read beside a picture: 1, 2 or 5 times a power of ten.
namespace grseg {

/// A span of numbers, low < high.
struct Range {
  double low = 0, high = 0;
  double length() const { return high - low; }
};

/// The largest such number not above `most`, and the smallest one not below `least`; both arguments
/// are positive.
double round_below(double most);
double round_above(double least);

/// The range widened to multiples of a round step, of which it then has 3 to 8; what is within
/// round-off of a multiple stays. A range without length is widened by half its place to either side;
/// that of 0 alone is 0 to 1.
Range round_range(const Range& range);

/// Multiples of a round step that lie in the range: at most `most` of them, which is at least 2.
std::vector<double> ticks(const Range& range, int most = 6);

/// Those as text, with as many decimals as their step needs.
std::vector<std::string> tick_labels(const std::vector<double>& ticks);

/// "5 mm", "2 cm", "1 m".
std::string length_text(double metres);
/// "0 to 5 mm", in the unit of the longer one.
std::string lengths_text(const Range& range);

}  // namespace grseg
