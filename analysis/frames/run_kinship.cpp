// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/frames/run_kinship.hpp"

#include <algorithm>
#include <sstream>

namespace grseg {
namespace {

/// The value of --seed in a command; "" where it has none.
std::string seed_in(const std::string& command)
{
  std::istringstream words(command);
  for (std::string word; words >> word;) {
    if (word.starts_with("--seed=")) return word.substr(7);
    if (word == "--seed") return words >> word ? word : "";
  }
  return "";
}

/// True where one history goes on where the other ends, or both go on from a common beginning by
/// restarts. Equal ones tell nothing: the same command may have run in several folders.
bool goes_on(const std::vector<std::string>& a, const std::vector<std::string>& b)
{
  const auto [x, y] = std::mismatch(a.begin(), a.end(), b.begin(), b.end());
  if (x == a.begin()) return false;
  const auto restarts = [](auto at, auto end) {
    return at != end && at->find(" --restart") != std::string::npos;
  };
  const bool one = restarts(x, a.end()), other = restarts(y, b.end());
  return (one && other) || (one && y == b.end()) || (other && x == a.end());
}

/// The kinship of two beds with the same grains.
Kinship kinship_of_beds(const Bed& a, const Bed& b)
{
  const bool seeds = !a.seed.empty() && !b.seed.empty();
  if (seeds && a.seed != b.seed) return Kinship::none;
  if (!seeds) return a.varied ? Kinship::same_grains : Kinship::untold;
  return a.flow.empty() || a.flow != b.flow ? Kinship::one_bed : Kinship::same_motion;
}

}  // namespace

std::string RunSource::seed() const
{
  if (bed) return bed->seed;
  return history.empty() ? "" : seed_in(history.front());
}

std::vector<RunSource> sources_of(const Table& table)
{
  std::vector<RunSource> sources(1);
  for (const auto& [key, value] : table.header) {
    auto* last = &sources.back();
    const bool next = key == "history" || key == "input";
    if (next && !last->input.empty()) last = &sources.emplace_back();
    if (key == "history") last->history.push_back(value);
    if (key == "input") last->input = value;
    if (key == "bed") last->bed = parse_bed(value);
  }
  // Behind the last run of several stands what merged them.
  if (sources.size() > 1 && sources.back().input.empty()) sources.pop_back();
  for (auto& source : sources)
    if (!source.history.empty()) source.history.pop_back();
  return sources;
}

Kinship kinship(const RunSource& a, const RunSource& b)
{
  if (!a.input.empty() && a.input == b.input) return Kinship::same_motion;
  if (a.bed && b.bed) {
    if (a.bed->grains == b.bed->grains) return kinship_of_beds(*a.bed, *b.bed);
    if (!a.bed->come_and_go && !b.bed->come_and_go) return Kinship::none;
  }
  if (goes_on(a.history, b.history)) return Kinship::one_bed;
  const bool seeds = !a.seed().empty() && !b.seed().empty();
  return seeds && a.seed() != b.seed() ? Kinship::none : Kinship::untold;
}

Kinship kinship(const std::vector<RunSource>& a, const std::vector<RunSource>& b)
{
  auto closest = Kinship::none;
  for (const auto& one : a)
    for (const auto& other : b) closest = std::max(closest, kinship(one, other));
  return closest;
}

}  // namespace grseg
