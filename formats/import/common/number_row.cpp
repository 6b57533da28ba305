// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/import/common/number_row.hpp"

#include "formats/core/errors.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>

namespace grseg {

void read_numbers(const TextSource& source, std::vector<double>& numbers, char separator)
{
  numbers.clear();
  const auto line = source.line();
  const char *at = line.data(), *const end = at + line.size();
  const auto is_between = [separator](char c) { return c == ' ' || c == '\t' || c == separator; };
  for (;;) {
    while (at < end && is_between(*at)) ++at;
    if (at == end) return;
    const char* word = at;
    double value = 0;
    const auto parsed = std::from_chars(at + (*at == '+'), end, value);
    at = parsed.ptr;
    if (parsed.ec != std::errc() || !std::isfinite(value) || (at < end && !is_between(*at))) {
      while (at < end && !is_between(*at)) ++at;
      throw FormatError(fmt::format("{}: {} in column {} is not a finite number", source.place(),
                                    in_quotes({word, static_cast<std::size_t>(at - word)}),
                                    numbers.size() + 1));
    }
    numbers.push_back(value);
  }
}

}  // namespace grseg
