// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/import/convert/repeated_moments.hpp"

#include "formats/cli/words.hpp"

#include <fmt/format.h>
#include <xxhash.h>

#include <algorithm>
#include <limits>

namespace grseg {
namespace {

/// Of ids and positions, whatever the order of the rows.
std::uint64_t digest_of(const ArchiveGrains& grains)
{
  std::uint64_t sum = 0;
  for (std::size_t g = 0; g < grains.size(); ++g)
    sum += XXH3_64bits_withSeed(grains.position[g].data(), sizeof(Vec3),
                                static_cast<std::uint64_t>(grains.id[g]));
  return sum;
}

}  // namespace

double RepeatedMoments::time_of(const ArchiveMoment& moment)
{
  return moment.step ? static_cast<double>(*moment.step) : *moment.time;
}

void RepeatedMoments::set_times(const std::vector<double>& times)
{
  double earliest = std::numeric_limits<double>::infinity();  // of those behind
  last_ones_.assign(times.size(), false);
  for (auto k = times.size(); k-- > 0;) {
    last_ones_[k] = times[k] < earliest;
    earliest = std::min(earliest, times[k]);
  }
}

bool RepeatedMoments::counts(const ArchiveMoment& moment)
{
  if (which_ == Repeated::last) {
    const bool is_last = next_ >= last_ones_.size() || last_ones_[next_];
    ++next_;
    dropped_ += is_last ? 0 : 1;
    return is_last;
  }
  const double time = time_of(moment);
  if (!seen_.empty() && time <= seen_.rbegin()->first) return comes_again(moment, time);
  seen_.emplace(time, digest_of(moment.grains));
  return true;
}

/// False, or UsageError.
bool RepeatedMoments::comes_again(const ArchiveMoment& moment, double time)
{
  const auto before = seen_.find(time);
  if (before != seen_.end() && before->second == digest_of(moment.grains)) {
    ++same_;
    return false;
  }
  if (which_ == Repeated::first) {
    ++dropped_;
    return false;
  }
  throw UsageError(fmt::format(
      "{}: {} {:.10g} comes after {:.10g}{}: if a job began again from an earlier checkpoint, "
      "--repeated first takes the moments of the earlier job, --repeated last those of the later one",
      moment.place, moment.step ? "step" : "time", time, seen_.rbegin()->first,
      before == seen_.end() ? "" : ", and its grains are elsewhere than the first time"));
}

std::string RepeatedMoments::remark() const
{
  if (same_ > 0 && dropped_ == 0)
    return fmt::format("{} {} twice, the same; each counts once", counted(same_, "moment"),
                       same_ == 1 ? "comes" : "come");
  if (dropped_ > 0)
    return fmt::format("{} of a job that another one repeats are left out",
                       counted(same_ + dropped_, "moment"));
  return "";
}

}  // namespace grseg
