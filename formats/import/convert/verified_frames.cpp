// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/import/convert/verified_frames.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace grseg {
namespace {

OwnFacts own_facts(const ArchiveMoment& all, const ArchiveMoment& moment)
{
  const auto& mass = all.grains.mass;
  const bool masses = !mass.empty() && std::all_of(mass.begin(), mass.end(), [](double m) {
    return std::isfinite(m) && m > 0;
  });
  return {masses, !moment.time ? "steps" : moment.step ? "both" : "times"};
}

std::array<AxisInArchive, 3> axes_of(const ImportedBed& bed)
{
  std::array<AxisInArchive, 3> axes;
  for (int k = 0; k < 3; ++k)
    if (const auto axis = bed.axes.axis_of(k))
      axes[static_cast<std::size_t>(k)] = {"xyz"[*axis], bed.axes.is_forward(k), bed.shift[k]};
  return axes;
}

}  // namespace

template <int D>
VerifiedFrames<D>::VerifiedFrames(OpenedArchive opened, const ImportSettings& settings)
    : opened_(std::move(opened)),
      waivers_(settings.accept_residual),
      own_(own_facts(opened_.all_grains(), opened_.moment)),
      builder_(std::make_unique<FrameBuilder>(opened_.all_grains(), facts(), settings,
                                              opened_.roster() != nullptr)),
      verification_(
          builder_->bed().grains, builder_->bed().box,
          facts().orientation.gravity.template head<D>(),
          {archive().facts().tolerance, archive().facts().forces_are_late, facts().step,
           facts().discs ? inertia_factor<2> : inertia_factor<3>, archive().facts().lists_all},
          waivers_, axes_of(builder_->bed())),
      has_force_(!opened_.all_grains().grains.force.empty()),
      has_angular_velocity_(!opened_.all_grains().grains.angular_velocity.empty())
{
  const auto& bed = builder_->bed();
  if (!bed.walls.empty())
    walls_ = std::make_unique<InferredWalls<D>>(bed.walls, bed,
                                                facts().orientation.gravity.template head<D>());
  if (walls_) verification_.leave_out(walls_->inferred());
}

template <int D>
void VerifiedFrames<D>::skip(std::size_t moments)
{
  for (std::size_t k = 1; k < moments; ++k) opened_.next_grains();
  if (moments > 0) opened_.next();
}

template <int D>
bool VerifiedFrames<D>::next(Frame<D>& frame)
{
  if (!std::exchange(first_, false) && !opened_.next()) return false;
  const auto& moment = opened_.moment;
  if (moment.grains.size() > 0 && moment.grains.force.empty() == has_force_)
    throw FormatError(fmt::format(
        "{}: some moments have forces on grains and some do not; import them separately",
        moment.place));
  builder_->build(moment, frame);
  if (walls_) walls_->add_to(frame);
  if (last_ && (frame.step <= last_->first || frame.time <= last_->second))
    throw FormatError(
        fmt::format("{}: step {} at {:.10g} comes after step {} at {:.10g}: time must increase by "
                    "at least one step; is --step too long?",
                    moment.place, frame.step, frame.time, last_->first, last_->second));
  last_ = {frame.step, frame.time};
  complaint_ = verification_.check(frame, !moment.grains.image.empty());
  return true;
}

template class VerifiedFrames<2>;
template class VerifiedFrames<3>;

}  // namespace grseg
