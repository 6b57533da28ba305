// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/import/facts/number_list.hpp"

#include "formats/core/errors.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <optional>
#include <sstream>

namespace grseg {
namespace {

std::optional<std::int64_t> whole(std::string_view text)
{
  std::int64_t number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || end != text.data() + text.size() || number < 0) return std::nullopt;
  return number;
}

}  // namespace

NumberList::NumberList(const std::string& text, const std::string& option)
{
  if (text == "none") return;
  bool good = !text.empty() && text.back() != ',';
  std::istringstream parts(text);
  for (std::string part; good && std::getline(parts, part, ',');) {
    const auto dash = part.find('-');
    const auto first = whole(std::string_view(part).substr(0, dash));
    const auto last = dash == std::string::npos ? first : whole(part.substr(dash + 1));
    good = first && last && *first <= *last;
    if (good) ranges_.emplace_back(*first, *last);
  }
  if (!good)
    throw UsageError(
        fmt::format("{} '{}' is not a list of numbers, such as 3 or 1,4-9, or none", option, text));
}

bool NumberList::contains(std::int64_t number) const
{
  return std::any_of(ranges_.begin(), ranges_.end(), [&](const auto& range) {
    return range.first <= number && number <= range.second;
  });
}

}  // namespace grseg
