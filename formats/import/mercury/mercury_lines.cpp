// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/import/mercury/mercury_lines.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>

namespace grseg {

bool MercuryLines::next()
{
  if (!source_.next()) return false;
  words_ = words_of(source_.line());
  return true;
}

void MercuryLines::need_next(const std::string& where)
{
  if (!next() || !source_.line_is_whole())
    throw TruncatedArchive(
        fmt::format("{}: the file ends {}; copy it again", source_.place(), where));
  if (kind() == "...") fail("the rest of the block is left out; write the restart file whole");
}

std::size_t MercuryLines::place_of(std::string_view key) const
{
  std::size_t at = 0;
  while (at < words_.size() && words_[at] != key) ++at;
  return at;
}

double MercuryLines::number(std::size_t place, std::string_view behind) const
{
  const auto word = words_[place];
  double number = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
  if (error != std::errc() || end != word.data() + word.size() || !std::isfinite(number))
    fail(fmt::format("{} after '{}' is not a finite number", in_quotes(word), behind));
  return number;
}

double MercuryLines::value(std::string_view key, std::size_t place) const
{
  const auto at = place_of(key) + 1 + place;
  if (at >= words_.size()) fail(fmt::format("'{}' with its value is missing", key));
  return number(at, key);
}

std::int64_t MercuryLines::whole_number(std::string_view key, std::size_t place) const
{
  const double number = value(key, place);
  if (std::abs(number) > 2147483647 || std::trunc(number) != number)
    fail(fmt::format("{:g} after '{}' is not a whole number", number, key));
  return static_cast<std::int64_t>(number);
}

std::optional<std::size_t> MercuryLines::count(std::string_view key) const
{
  if (kind() != key) return std::nullopt;
  const double number = value(key);
  if (number < 0 || number > 1e9 || std::trunc(number) != number)
    fail(fmt::format("{} is not a number of {}", in_quotes(source_.line()), key));
  return static_cast<std::size_t>(number);
}

std::vector<double> MercuryLines::numbers(std::size_t first) const
{
  std::vector<double> numbers;
  for (auto k = first; k < words_.size(); ++k)
    numbers.push_back(number(k, k > 0 ? words_[k - 1] : "the beginning of the line"));
  return numbers;
}

void MercuryLines::fail(const std::string& why) const
{
  throw FormatError(fmt::format("{}: {}", source_.place(), why));
}

}  // namespace grseg
