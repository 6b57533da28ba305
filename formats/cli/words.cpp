// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/cli/words.hpp"

#include "formats/core/errors.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <numeric>
#include <utility>

namespace grseg {
namespace {

std::size_t edit_distance(const std::string& a, const std::string& b)
{
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = std::exchange(row[0], i);
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t replace = diagonal + (a[i - 1] != b[j - 1]);
      diagonal = row[j];
      row[j] = std::min({row[j] + 1, row[j - 1] + 1, replace});
    }
  }
  return row[b.size()];
}

}  // namespace

std::size_t choose(const std::string& word, const char* option,
                   const std::vector<std::string>& words)
{
  const auto found = std::find(words.begin(), words.end(), word);
  if (found == words.end())
    throw UsageError(fmt::format("{}: there is no '{}'; it is one of: {}", option, word,
                                 fmt::join(words, ", ")));
  return static_cast<std::size_t>(found - words.begin());
}

std::string nearest(const std::string& word, const std::vector<std::string>& known)
{
  std::string best;
  std::size_t least = std::max<std::size_t>(3, word.size() / 2);
  for (const auto& candidate : known) {
    const auto distance = edit_distance(word, candidate);
    if (distance < least) {
      least = distance;
      best = candidate;
    }
  }
  return best;
}

}  // namespace grseg
