// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/import/convert/moments.hpp"

#include "formats/cli/interruption.hpp"
#include "formats/import/open_archive.hpp"

#include <fmt/format.h>

namespace grseg {
namespace {

ArchiveFiles with_columns(ArchiveFiles files, const std::string& columns)
{
  files.columns = columns;
  return files;
}

/// Of all moments, as they follow in the archive.
std::vector<double> times_of(Archive& archive)
{
  std::vector<double> times;
  ArchiveMoment moment;
  try {
    while (archive.next_grains(moment)) {
      stop_if_interrupted();
      times.push_back(RepeatedMoments::time_of(moment));
    }
  } catch (const TruncatedArchive&) {
    // Told when it is imported.
  }
  return times;
}

}  // namespace

Moments::Moments(const ImportSettings& settings, const std::string& columns)
    : archive_(open_archive(settings.format, with_columns(settings.files, columns))),
      step_(settings.step),
      interval_(settings.interval),
      drop_incomplete_(settings.drop_incomplete),
      cells_(parse_cells(settings.cells)),
      repeated_(settings.repeated ? choose(*settings.repeated, "--repeated", repeated_words)
                                  : Repeated::ask),
      range_(settings.begin, settings.end)
{
  if (repeated_.needs_all_times())
    repeated_.set_times(
        times_of(*open_archive(settings.format, with_columns(settings.files, columns))));
}

bool Moments::read_one(ArchiveMoment& moment, Read read)
{
  for (;;) try {
      if (!((*archive_).*read)(moment)) return false;
      if (interval_) set_time(moment);
      for (const auto& cell : cells_) tell(cell, moment);
      return true;
    } catch (const TruncatedArchive& incomplete) {
      if (!drop_incomplete_) throw;
      ++dropped_;
      if (!incomplete.goes_on) return false;
    }
}

std::vector<std::string> Moments::remarks() const
{
  std::vector<std::string> remarks;
  if (!range_.is_all())
    remarks.push_back(fmt::format("only moments in the range {} are imported", range_.text()));
  if (dropped_ > 0)
    remarks.push_back(fmt::format("{} incomplete moment{} left out (--drop-incomplete)", dropped_,
                                  dropped_ == 1 ? " is" : "s are"));
  if (auto repeated = repeated_.remark(); !repeated.empty()) remarks.push_back(std::move(repeated));
  return remarks;
}

/// The number of a moment times --frame-interval.
void Moments::set_time(ArchiveMoment& moment) const
{
  if (moment.time)
    throw UsageError(fmt::format(
        "{}: --frame-interval is given, but the archive has times; leave the option out",
        moment.place));
  if (!(*interval_ > 0))
    throw UsageError(fmt::format("--frame-interval {:g} is not positive", *interval_));
  moment.time = static_cast<double>(*moment.step) * *interval_;
  moment.step.reset();
}

bool Moments::advance(ArchiveMoment& moment, Read read)
{
  while (!ended_ && read_one(moment, read)) {
    stop_if_interrupted();
    if (!repeated_.counts(moment)) continue;
    range_.set_step(step_ ? step_ : archive_->facts().step);
    const auto side = range_.side(moment);
    if (side == MomentRange::Side::within) return found_ = true;
    // Without a moment in the range it is read to its end, to say what it has.
    ended_ = found_ && side == MomentRange::Side::after;
  }
  if (!found_ && range_.any_seen())
    throw UsageError(fmt::format("no moment lies in the range {}: the archive has {}",
                                 range_.text(), range_.seen()));
  return false;
}

}  // namespace grseg
