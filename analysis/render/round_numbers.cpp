// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/render/round_numbers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace grseg {
namespace {

constexpr double round_off = 1e-9;

/// Round number with index `number`: indices are in order of size; index 0 is 1, index -1 is 0.5.
double round_number(long number)
{
  constexpr double factors[] = {1, 2, 5};
  const long exponent = number >= 0 ? number / 3 : -((2 - number) / 3);
  const double power = std::pow(10, std::abs(static_cast<double>(exponent)));
  const double factor = factors[std::clamp(number - 3 * exponent, 0L, 2L)];
  return exponent < 0 ? factor / power : factor * power;
}

/// Index (see round_number()) of a round number that is below `value` by less than a factor of ten.
long number_below(double value)
{
  return 3 * static_cast<long>(std::floor(std::log10(value))) - 1;
}

int exponent_of(double value)
{
  return static_cast<int>(std::floor(std::log10(value) + round_off));
}

/// Unit that suits a length: size of the unit, m, and its name.
std::pair<double, const char*> unit_of(double metres)
{
  if (metres < 0.01 * (1 - round_off)) return {1e-3, "mm"};
  if (metres < 1 - round_off) return {1e-2, "cm"};
  return {1, "m"};
}

}  // namespace

double round_below(double most)
{
  long number = number_below(most);
  while (round_number(number + 1) <= most * (1 + round_off)) ++number;
  return round_number(number);
}

double round_above(double least)
{
  long number = number_below(least);
  while (round_number(number) < least * (1 - round_off)) ++number;
  return round_number(number);
}

Range round_range(const Range& range)
{
  if (!(range.length() > round_off * std::max(std::abs(range.low), std::abs(range.high)))) {
    if (range.low == 0) return {0, 1};
    const double half = std::abs(range.low) / 2;
    return {range.low - half, range.low + half};
  }
  const double step = round_above(range.length() / 6);
  return {std::floor(range.low / step + round_off) * step,
          std::ceil(range.high / step - round_off) * step};
}

std::vector<double> ticks(const Range& range, int most)
{
  std::vector<double> all;
  for (double step = round_above(range.length() / most);; step = round_above(1.5 * step)) {
    const double first = std::ceil(range.low / step - round_off);
    const double last = std::floor(range.high / step + round_off);
    if (last - first >= most) continue;
    // Products instead of sums, which would add up round-off; 0.0, because 0 * step may be -0.
    for (long k = std::lround(first); k <= std::lround(last); ++k)
      all.push_back(k == 0 ? 0.0 : static_cast<double>(k) * step);
    return all;
  }
}

std::vector<std::string> tick_labels(const std::vector<double>& ticks)
{
  double largest = 0;
  for (const double tick : ticks) largest = std::max(largest, std::abs(tick));
  const double step = ticks.size() > 1 ? ticks[1] - ticks[0] : largest;
  const int last = exponent_of(step);  // power of ten of the last digit that is written
  const bool plain = largest < 1e5 && (step >= 1e-3 || largest >= 1e-2);
  const int digits = std::clamp(plain ? -last : exponent_of(largest) - last + 1, plain ? 0 : 1, 17);
  std::vector<std::string> labels;
  labels.reserve(ticks.size());
  for (const double tick : ticks)
    labels.push_back(plain ? fmt::format("{:.{}f}", tick, digits)
                           : fmt::format("{:.{}g}", tick, digits));
  return labels;
}

std::string length_text(double metres)
{
  const auto [unit, name] = unit_of(metres);
  return fmt::format("{:.3g} {}", metres / unit, name);
}

std::string lengths_text(const Range& range)
{
  const auto [unit, name] = unit_of(std::max(std::abs(range.low), std::abs(range.high)));
  return fmt::format("{:.3g} to {:.3g} {}", range.low / unit, range.high / unit, name);
}

}  // namespace grseg
