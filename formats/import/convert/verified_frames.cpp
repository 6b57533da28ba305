// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/import/convert/verified_frames.hpp"

#include "formats/cli/interruption.hpp"
#include "formats/import/open_archive.hpp"

#include <fmt/format.h>

namespace grseg {

VerifiedFrames::VerifiedFrames(const ImportSettings& settings, const std::string& columns)
    : settings_(settings)
{
  auto files = settings.files;
  files.columns = columns;
  archive_ = open_archive(settings.format, files);
  if (!read_moment()) throw FormatError("the archive holds no moment with grains and contacts");
  const auto& facts = archive_->facts();
  facts_ = collect_facts(facts, moment_.grains, settings);
  tolerance_ = settings.accept_residual.value_or(facts.tolerance);
  builder_ = std::make_unique<FrameBuilder>(moment_, facts_, settings);
  verification_ = std::make_unique<Verification>(
      builder_->bed().grains, builder_->bed().box, facts_.plane.gravity,
      OutputAccuracy{tolerance_, facts.forces_are_late, facts_.step, facts_.discs ? 0.5 : 0.4});
  has_force_ = !moment_.grains.force.empty();
  has_angular_velocity_ = !moment_.grains.angular_velocity.empty();
}

/// With --drop-incomplete an incomplete moment is the end.
bool VerifiedFrames::read_moment()
{
  try {
    return archive_->next(moment_);
  } catch (const TruncatedArchive&) {
    if (!settings_.drop_incomplete) throw;
    return false;
  }
}

bool VerifiedFrames::next(Frame<2>& frame)
{
  if (!std::exchange(first_, false) && !read_moment()) return false;
  if (moment_.grains.force.empty() == has_force_)
    throw FormatError(fmt::format(
        "{}: some moments have forces on grains and some do not; import them separately",
        moment_.place));
  builder_->build(moment_, frame);
  if (last_ && (frame.step <= last_->first || frame.time <= last_->second))
    throw FormatError(
        fmt::format("{}: step {} at {:.10g} comes after step {} at {:.10g}: time must increase by "
                    "at least one step; is --step too long?",
                    moment_.place, frame.step, frame.time, last_->first, last_->second));
  last_ = {frame.step, frame.time};
  complaint_ = verification_->check(frame);
  return true;
}

namespace {

/// The largest residual of the first moments if all of them verify with these columns.
std::optional<double> residual_with(const ImportSettings& settings, const std::string& columns,
                                    std::size_t moments)
{
  try {
    VerifiedFrames frames(settings, columns);
    Frame<2> frame;
    std::optional<double> largest;
    for (std::size_t k = 0; k < moments && frames.next(frame); ++k) {
      if (frames.complaint()) return std::nullopt;
      if (frames.residual())
        largest = std::max(largest.value_or(0), frames.residual()->unexplained);
    }
    return largest;
  } catch (const Interruption&) {
    throw;
  } catch (const ToolError&) {
    return std::nullopt;
  }
}

}  // namespace

std::string columns_that_fit(const ImportSettings& settings, const Archive& archive,
                             std::size_t moments)
{
  std::string best;
  double least = INFINITY;
  for (const auto& columns : archive.other_columns()) {
    const auto residual = residual_with(settings, columns, moments);
    if (!residual || *residual >= least) continue;
    least = *residual;
    best = fmt::format("; with --columns {} they balance to {:.2g}", columns, *residual);
  }
  return best;
}

}  // namespace grseg
