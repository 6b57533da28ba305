// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/cli/numbers.hpp"

#include <charconv>
#include <limits>

namespace grseg {

std::optional<double> parse_number(std::string_view text)
{
  using Limits = std::numeric_limits<double>;
  if (text == "nan") return Limits::quiet_NaN();
  if (text == "inf") return Limits::infinity();
  if (text == "-inf") return -Limits::infinity();
  // from_chars would take other words for NaN and infinity.
  if (text.find_first_not_of("+-.0123456789eE") != std::string_view::npos) return {};
  double number = 0;
  const auto* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, number);
  if (error != std::errc() || stop != end) return {};
  return number;
}

}  // namespace grseg
