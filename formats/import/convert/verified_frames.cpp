// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/import/convert/verified_frames.hpp"

#include <fmt/format.h>

namespace grseg {
namespace {

std::array<AxisInArchive, 3> axes_of(const ImportedBed& bed)
{
  std::array<AxisInArchive, 3> axes;
  for (int k = 0; k < 3; ++k)
    if (const auto axis = bed.axes.axis_of(k))
      axes[static_cast<std::size_t>(k)] = {"xyz"[*axis], bed.axes.is_forward(k), bed.shift[k]};
  return axes;
}

}  // namespace

VerifiedFrames::VerifiedFrames(ScannedArchive scanned, const ImportSettings& settings)
    : scanned_(std::move(scanned)),
      waivers_(settings.accept_residual),
      bed_(scanned_.all_grains(), facts(), settings, scanned_.roster() != nullptr),
      verification_(
          bed_.grains, bed_.box, bed_.gravity,
          {archive().facts().tolerance, archive().facts().forces_are_late,
           facts().knows_step ? facts().step : 0,
           facts().discs ? inertia_factor<2> : inertia_factor<3>, archive().facts().lists_all},
          waivers_, axes_of(bed_))
{
  if (bed_.walls.empty()) return;
  walls_ = std::make_unique<InferredWalls>(bed_);
  verification_.leave_out(walls_->inferred());
}

bool VerifiedFrames::next(Frame<3>& frame)
{
  if (!std::exchange(first_, false) && !scanned_.next()) return false;
  const auto& raw = scanned_.frame;
  if (raw.grains.size() > 0 && raw.grains.force.empty() == bed_.has_force)
    throw FormatError(
        fmt::format("{}: some frames have forces on grains and some do not; import them separately",
                    raw.place));
  bed_.build(raw, frame);
  if (walls_) walls_->add_to(frame);
  if (last_ && (frame.step <= last_->first || frame.time <= last_->second))
    throw FormatError(
        fmt::format("{}: step {} at {:.10g} comes after step {} at {:.10g}: time must increase by "
                    "at least one step; is --step too long?",
                    raw.place, frame.step, frame.time, last_->first, last_->second));
  last_ = {frame.step, frame.time};
  complaint_ = verification_.check(frame, !raw.grains.image.empty());
  return true;
}

}  // namespace grseg
