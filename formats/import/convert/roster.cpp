// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/import/convert/roster.hpp"

#include "formats/cli/interruption.hpp"
#include "formats/import/convert/moments.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <unordered_map>

namespace grseg {
namespace {

/// Collects the grains of one moment after another.
class Collector {
 public:
  void add(const ArchiveMoment& moment)
  {
    const auto& now = moment.grains;
    if (moments_++ == 0) begin(moment);
    enclose(moment);
    roster_.fewest = std::min(roster_.fewest, now.size());
    roster_.most = std::max(roster_.most, now.size());
    for (std::size_t g = 0; g < now.size(); ++g) add_grain(moment, g);
    if (now.size() > 0) roster_.all.grains.missing = now.missing;
    roster_.all.grains.type_names = now.type_names;
    if (now.size() > 0) counts_periods_ = counts_periods_ && now.counts_periods();
  }
  Roster finish();

 private:
  void begin(const ArchiveMoment& first)
  {
    roster_.all.step = first.step;
    roster_.all.time = first.time;
    roster_.all.low = first.low;
    roster_.all.high = first.high;
    roster_.all.periodic = first.periodic;
    roster_.all.cell = first.cell;
    roster_.all.place = fmt::format("all moments from {} on", first.place);
    roster_.fewest = first.grains.size();
  }
  void enclose(const ArchiveMoment& moment)
  {
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
      if (roster_.all.periodic[static_cast<std::size_t>(axis)]) continue;
      roster_.all.low[axis] = std::min(roster_.all.low[axis], moment.low[axis]);
      roster_.all.high[axis] = std::max(roster_.all.high[axis], moment.high[axis]);
    }
  }
  void add_grain(const ArchiveMoment& moment, std::size_t g);
  void add_new(const ArchiveMoment& moment, std::size_t g);

  struct Seen {
    std::size_t times = 0, last = 0;  // the number of the moment
  };
  Roster roster_;
  std::size_t moments_ = 0;
  bool counts_periods_ = true;  // every moment so far
  std::unordered_map<std::int64_t, std::size_t> row_;
  std::vector<Seen> seen_;
};

void Collector::add_grain(const ArchiveMoment& moment, std::size_t g)
{
  const auto& now = moment.grains;
  auto& all = roster_.all.grains;
  const auto [place, is_new] = row_.try_emplace(now.id[g], all.size());
  const std::size_t row = place->second;
  if (is_new) add_new(moment, g);
  auto& seen = seen_[row];
  if (seen.last == moments_)
    throw FormatError(fmt::format("{}: grain {} appears twice", moment.place, now.id[g]));
  seen.last = moments_;
  ++seen.times;
  if (!is_new) require_same_grain(all, row, now, g, moment.place);
  all.position[row] += now.position[g];
  if (!now.velocity.empty() && now.velocity[g].norm() > all.velocity[row].norm())
    all.velocity[row] = now.velocity[g];
}

void Collector::add_new(const ArchiveMoment& moment, std::size_t g)
{
  const auto& now = moment.grains;
  auto& all = roster_.all.grains;
  const auto copy = [g](const auto& from, auto& to) {
    if (!from.empty()) to.push_back(from[g]);
  };
  all.id.push_back(now.id[g]);
  copy(now.type, all.type);
  copy(now.radius, all.radius);
  copy(now.mass, all.mass);
  copy(now.fixed, all.fixed);
  all.position.emplace_back(Vec3::Zero());
  const auto make_room = [](const auto& from, auto& to) {
    if (!from.empty()) to.emplace_back(Vec3::Zero());
  };
  make_room(now.velocity, all.velocity);
  make_room(now.angular_velocity, all.angular_velocity);
  make_room(now.force, all.force);
  seen_.emplace_back();
  const auto require = [&](const auto& values, const char* what) {
    if (!values.empty() && values.size() != all.size())
      throw FormatError(fmt::format(
          "{}: some moments have {} of grains and some do not; import them separately, with --begin "
          "and --end",
          moment.place, what));
  };
  require(all.type, "types");
  require(all.radius, "radii");
  require(all.mass, "masses");
  require(all.fixed, "fixed flags");
  require(all.velocity, "velocities");
  require(all.angular_velocity, "angular velocities");
  require(all.force, "forces");
}

Roster Collector::finish()
{
  auto& all = roster_.all.grains;
  for (std::size_t row = 0; row < all.size(); ++row)
    all.position[row] /= static_cast<double>(seen_[row].times);
  all.unwrapped = counts_periods_;
  roster_.moments = moments_;
  return std::move(roster_);
}

bool same_ids(const ArchiveGrains& a, const ArchiveGrains& b)
{
  if (a.size() != b.size()) return false;
  if (a.id == b.id) return true;  // programs often keep the order
  auto first = a.id, second = b.id;
  std::sort(first.begin(), first.end());
  std::sort(second.begin(), second.end());
  return first == second;
}

}  // namespace

Roster read_roster(const ImportSettings& settings)
{
  Moments moments(settings, settings.files.columns);
  Collector collector;
  for (ArchiveMoment moment; moments.next_grains(moment);) {
    stop_if_interrupted();
    collector.add(moment);
  }
  return collector.finish();
}

bool grains_change_early(const ImportSettings& settings)
{
  constexpr int early = 20;
  try {
    Moments moments(settings, settings.files.columns);
    ArchiveMoment first, moment;
    if (!moments.next_grains(first)) return false;
    for (int k = 1; k < early && moments.next_grains(moment); ++k)
      if (!same_ids(first.grains, moment.grains)) return true;
  } catch (const ToolError&) {  // to be reported when it is that moment's turn
  }
  return false;
}

void require_same_grain(const ArchiveGrains& known, std::size_t row, const ArchiveGrains& now,
                        std::size_t g, const std::string& place)
{
  const auto refuse = [&](const char* what, double before, double after, const char* remedy) {
    throw FormatError(fmt::format("{}: the {} of grain {} changes from {:g} to {:g}; {}", place,
                                  what, now.id[g], before, after, remedy));
  };
  constexpr const char* used_again =
      "was its id used again after a grain had been removed? Then import the moments before and "
      "after it separately, with --begin and --end";
  constexpr const char* later =
      "was its mass set only after it had been poured in, or its id used again after a removal? Then "
      "import the moments before and after it separately, with --begin and --end";
  constexpr const char* frozen =
      "grains that are frozen or let go later are another bed: import the phases separately, with "
      "--begin and --end";
  const auto differ = [](double a, double b) { return !(std::abs(a - b) <= 1e-5 * std::abs(a)); };
  const auto compare = [&](const auto& before, const auto& after, const char* what,
                           const auto& different, const char* remedy) {
    if (before.empty() || after.empty() || !different(before[row], after[g])) return;
    refuse(what, before[row], after[g], remedy);
  };
  const auto unequal = [](auto a, auto b) { return a != b; };
  compare(known.radius, now.radius, "radius", differ, used_again);
  compare(known.mass, now.mass, "mass", differ, later);
  compare(known.type, now.type, "type", unequal, frozen);
  compare(known.fixed, now.fixed, "fixed flag", unequal, frozen);
}

}  // namespace grseg
