// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/import/convert/archive_frames.hpp"

#include "formats/cli/interruption.hpp"
#include "formats/cli/words.hpp"
#include "formats/import/common/text_values.hpp"

#include <fmt/format.h>
#include <xxhash.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace grseg {
namespace {

std::string in_words(const ArchiveFrame& frame)
{
  if (!frame.time) return fmt::format("step {}", *frame.step);
  if (!frame.step) return fmt::format("t = {:g}", *frame.time);
  return fmt::format("t = {:g} (step {})", *frame.time, *frame.step);
}

/// The step of a frame, or its time if it has no step.
double time_of(const ArchiveFrame& frame)
{
  return frame.step ? static_cast<double>(*frame.step) : *frame.time;
}

/// The times (or steps) of all frames, in the order of the archive.
std::vector<double> times_of(Archive& archive)
{
  std::vector<double> times;
  ArchiveFrame frame;
  try {
    while (archive.next_grains(frame)) {
      stop_if_interrupted();
      times.push_back(time_of(frame));
    }
  } catch (const TruncatedArchive&) {
    // The import itself reports this error.
  }
  return times;
}

/// Digest (hash) of ids and positions, independent of the order of the rows.
std::uint64_t digest_of(const ArchiveGrains& grains)
{
  std::uint64_t sum = 0;
  for (std::size_t g = 0; g < grains.size(); ++g)
    sum += XXH3_64bits_withSeed(grains.position[g].data(), sizeof(Vec3),
                                static_cast<std::uint64_t>(grains.id[g]));
  return sum;
}

}  // namespace

ArchiveRange::ArchiveRange(const std::optional<std::string>& begin,
                           const std::optional<std::string>& end)
{
  add("--begin", begin);
  add("--end", end);
}

void ArchiveRange::add(const char* option, const std::optional<std::string>& text)
{
  if (!text) return;
  text_ += fmt::format("{}{} {}", text_.empty() ? "" : " ", option, *text);
  auto& bound = bounds_.emplace_back(Bound{option, option == std::string_view("--end"), {}, 0});
  if (text->starts_with("step:")) {
    if (parse_whole(text->substr(5), bound.step)) return;
  } else if (double time = 0; parse_finite(*text, time)) {
    bound.time = time;
    return;
  }
  throw UsageError(
      fmt::format("{} {} is neither a time in the archive's units, as in 12.5, nor a step, as in "
                  "step:100000",
                  option, *text));
}

/// Position of a frame relative to a bound: -1 before, 0 at, 1 after the bound.
int ArchiveRange::compare(const ArchiveFrame& frame, const Bound& bound,
                          const std::optional<double>& step)
{
  const bool known = bound.time ? frame.time.has_value() : frame.step.has_value();
  if (!known && !(step && *step > 0))
    throw UsageError(fmt::format(
        "{} is a {}, but the archive has {} only, and the length of a time step is unknown: pass "
        "it with --step, or pass a {}",
        bound.option, bound.time ? "time" : "step", bound.time ? "steps" : "times",
        bound.time ? "step, as in step:100000" : "time"));
  if (!bound.time) {
    const auto at = frame.step ? *frame.step : std::llround(*frame.time / *step);
    return at < bound.step ? -1 : at > bound.step ? 1 : 0;
  }
  constexpr double digits = 1e-9;
  const double time = frame.time ? *frame.time : static_cast<double>(*frame.step) * *step;
  if (std::abs(time - *bound.time) <= digits * std::max(std::abs(time), std::abs(*bound.time)))
    return 0;
  return time < *bound.time ? -1 : 1;
}

ArchiveRange::Side ArchiveRange::side(const ArchiveFrame& frame, const std::optional<double>& step)
{
  last_ = in_words(frame);
  if (count_++ == 0) first_ = last_;
  for (const auto& bound : bounds_) {
    const int where = compare(frame, bound, step);
    if (bound.is_end && where >= 0) return Side::after;
    if (!bound.is_end && where < 0) return Side::before;
  }
  return Side::within;
}

std::string ArchiveRange::seen() const
{
  return count_ == 1 ? fmt::format("one frame, {}", first_)
                     : fmt::format("{} frames from {} to {}", count_, first_, last_);
}

RepeatedFrames::RepeatedFrames(const ImportSettings& settings)
{
  if (settings.repeated) which_ = choose(*settings.repeated, "--repeated", repeated_words);
  if (which_ != Repeated::last) return;
  const auto times = times_of(*open_archive(settings.format, settings.files));
  double earliest = std::numeric_limits<double>::infinity();  // time of later frames
  last_ones_.assign(times.size(), false);
  for (auto k = times.size(); k-- > 0;) {
    last_ones_[k] = times[k] < earliest;
    earliest = std::min(earliest, times[k]);
  }
}

bool RepeatedFrames::counts(const ArchiveFrame& frame)
{
  if (which_ == Repeated::last) {
    const bool is_last = next_ >= last_ones_.size() || last_ones_[next_];
    ++next_;
    dropped_ += is_last ? 0 : 1;
    return is_last;
  }
  const double time = time_of(frame);
  if (!seen_.empty() && time <= seen_.rbegin()->first) return comes_again(frame, time);
  seen_.emplace(time, digest_of(frame.grains));
  return true;
}

/// Counts a frame that is not later than the previous ones and returns false, or throws UsageError.
bool RepeatedFrames::comes_again(const ArchiveFrame& frame, double time)
{
  const auto before = seen_.find(time);
  if (before != seen_.end() && before->second == digest_of(frame.grains)) {
    ++same_;
    return false;
  }
  if (which_ == Repeated::first) {
    ++dropped_;
    return false;
  }
  const int digits = frame.step ? 17 : 10;  // steps are written exactly
  throw UsageError(fmt::format(
      "{}: {} {:.{}g} comes after {:.{}g}{}: if a job began again from an earlier checkpoint, "
      "--repeated first reads the frames of the earlier job, "
      "--repeated last the frames of the later job",
      frame.place, frame.step ? "step" : "time", time, digits, seen_.rbegin()->first, digits,
      before == seen_.end() ? "" : ", and its grains are not where they were the first time"));
}

std::string RepeatedFrames::remark() const
{
  if (same_ > 0 && dropped_ == 0)
    return fmt::format("{} {} twice with equal grains; each is imported once",
                       counted(same_, "frame"), same_ == 1 ? "comes" : "come");
  if (dropped_ > 0)
    return fmt::format("{} of a job are left out, because another job repeats them",
                       counted(same_ + dropped_, "frame"));
  return "";
}

ArchiveFrames::ArchiveFrames(const ImportSettings& settings)
    : archive_(open_archive(settings.format, settings.files)),
      step_(settings.step),
      interval_(settings.interval),
      drop_incomplete_(settings.drop_incomplete),
      cells_(parse_cells(settings.cells)),
      repeated_(settings),
      range_(settings.begin, settings.end)
{
}

bool ArchiveFrames::read_one(ArchiveFrame& frame, Read read)
{
  for (;;) try {
      if (!((*archive_).*read)(frame)) return false;
      if (interval_) set_time(frame);
      for (const auto& cell : cells_) tell(cell, frame);
      return true;
    } catch (const TruncatedArchive& incomplete) {
      if (!drop_incomplete_) throw;
      ++dropped_;
      if (!incomplete.goes_on) return false;
    }
}

std::vector<std::string> ArchiveFrames::remarks() const
{
  std::vector<std::string> remarks;
  if (!range_.text().empty())
    remarks.push_back(fmt::format("only frames in the range {} are imported", range_.text()));
  if (dropped_ > 0)
    remarks.push_back(fmt::format("{} incomplete frame{} left out (--drop-incomplete)", dropped_,
                                  dropped_ == 1 ? " is" : "s are"));
  if (auto repeated = repeated_.remark(); !repeated.empty()) remarks.push_back(std::move(repeated));
  return remarks;
}

/// Sets the time of a frame to its number times --frame-interval.
void ArchiveFrames::set_time(ArchiveFrame& frame) const
{
  if (frame.time)
    throw UsageError(fmt::format(
        "{}: --frame-interval is given, but the archive has times; leave the option out",
        frame.place));
  if (!(*interval_ > 0))
    throw UsageError(fmt::format("--frame-interval {:g} is not positive", *interval_));
  frame.time = static_cast<double>(*frame.step) * *interval_;
  frame.step.reset();
}

bool ArchiveFrames::advance(ArchiveFrame& frame, Read read)
{
  while (!ended_ && read_one(frame, read)) {
    stop_if_interrupted();
    if (!repeated_.counts(frame)) continue;
    const auto side = range_.side(frame, step_ ? step_ : archive_->facts().step);
    if (side == ArchiveRange::Side::within) return found_ = true;
    // If no frame is in the range, the archive is read to its end, for the text of the error.
    ended_ = found_ && side == ArchiveRange::Side::after;
  }
  if (!found_ && range_.any_seen())
    throw UsageError(fmt::format("no frame lies in the range {}: the archive has {}", range_.text(),
                                 range_.seen()));
  return false;
}

}  // namespace grseg
