// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/frames/velocity_in_step.hpp"

#include "analysis/frames/contacts.hpp"
#include "formats/core/errors.hpp"

#include <fmt/format.h>

namespace grseg {

template <int D>
void to_middle_of_step(const Grains& grains, double step, bool turning, Frame<D>& frame)
{
  if (frame.force.size() != grains.size())
    throw FormatError(
        "the frame has no forces of grains (/particles/grains/force), from which the velocity in "
        "the middle of a step follows");
  const auto torque = torques_of(grains, frame.contacts);
  for (std::size_t g = 0; g < grains.size(); ++g) {
    if (!is_mobile(grains, frame, g)) continue;
    const double mass = grains.mass[g], radius = grains.radius[g];
    frame.velocity[g] -= step / (2 * mass) * frame.force[g];
    if (turning)
      frame.angular_velocity[g] -=
          step / (2 * inertia_factor<D> * mass * radius * radius) * torque[g];
  }
}

template void to_middle_of_step(const Grains&, double, bool, Frame<2>&);
template void to_middle_of_step(const Grains&, double, bool, Frame<3>&);

std::string velocity_line(const TrajectoryReader& run, const std::string& word, bool chosen)
{
  if (run.parameters().text("import_format").empty()) return word;
  if (chosen)
    throw UsageError(fmt::format(
        "--velocity {}: {} was imported, so that a frame is an instant, not a step, and has one "
        "velocity; leave --velocity out",
        word, run.path()));
  return "instant";
}

}  // namespace grseg
