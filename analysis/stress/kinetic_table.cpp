// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/stress/kinetic_table.hpp"

#include "analysis/frames/contacts.hpp"
#include "analysis/stress/contact_sums.hpp"
#include "formats/core/errors.hpp"

#include <fmt/format.h>

#include <cmath>

namespace grseg {

template <int D>
KineticStress<D> kinetic_stress(FrameLoop& loop, const Window& window, MeanFlow flow,
                                VelocityInStep which, const MeanVelocity<D>& no_grains)
{
  const bool middle = which == VelocityInStep::middle;
  const TrajectoryReader::Fields fields{.velocity = true, .contacts = middle, .force = middle};
  const bool turning = loop.run().parameters().find_number("rotation") != 0.0;
  const auto add_up = [&]<class Sums>(const Sums& nothing) {
    const AtVelocity<D, Sums> none{nothing, which, loop.run().step(), turning};
    return std::get<0>(loop.sum<D>(window, fields, none)).sums;
  };
  const auto mean = add_up(no_grains);
  return add_up(KineticStress<D>(loop.layers(), flow, mean, loop.species().size()));
}

template KineticStress<2> kinetic_stress(FrameLoop&, const Window&, MeanFlow, VelocityInStep,
                                         const MeanVelocity<2>&);
template KineticStress<3> kinetic_stress(FrameLoop&, const Window&, MeanFlow, VelocityInStep,
                                         const MeanVelocity<3>&);

template <int D>
std::vector<Cell> flow_fields(const Vector<D>& velocity,
                              const typename KineticStress<D>::Mean& all_species)
{
  std::vector<Cell> fields;
  if (D == 3) fields.push_back({"w[m/s]", velocity[D - 1]});
  const double energy = all_species.about_mean.kinetic.trace();
  fields.push_back({"T[m^2/s^2]", ratio(energy, D * all_species.mass)});
  return fields;
}

template std::vector<Cell> flow_fields<2>(const Vec2&, const KineticStress<2>::Mean&);
template std::vector<Cell> flow_fields<3>(const Vec3&, const KineticStress<3>::Mean&);

template <int D>
std::vector<Cell> kinetic_cells(const KineticStress<D>& stress, const SpeciesList& species,
                                bool with_contents, bool map, std::optional<std::size_t> layer)
{
  auto cells = stress.cells(species, layer);
  typename KineticStress<D>::Mean all;
  const auto contents = content_columns(species, D);
  for (std::size_t k = 0; k < species.size(); ++k) {
    const auto own = layer ? stress.mean(*layer, static_cast<Species>(k)) : all;
    if (with_contents) cells.push_back({contents[k], own.content});
    if (layer) all += own;
  }
  if (!map) return cells;
  const Vector<D> velocity = layer ? stress.velocity(*layer) : Vector<D>(Vector<D>::Zero());
  return add_all(cells, flow_fields<D>(velocity, all));
}

template std::vector<Cell> kinetic_cells(const KineticStress<2>&, const SpeciesList&, bool, bool,
                                         std::optional<std::size_t>);
template std::vector<Cell> kinetic_cells(const KineticStress<3>&, const SpeciesList&, bool, bool,
                                         std::optional<std::size_t>);

template <int D>
void KineticRemarks::add(const KineticStress<D>& stress, std::size_t species, std::size_t frames)
{
  for (std::size_t k = 0; k < species; ++k) {
    typename KineticStress<D>::Mean all;
    for (std::size_t layer = 0; layer < stress.layers(); ++layer) {
      const auto mean = stress.mean(layer, static_cast<Species>(k));
      all += mean;
      const double of_shear = stress.shear_bias(layer, static_cast<Species>(k));
      if (!std::isfinite(of_shear)) continue;
      profile_ += mean.about_mean.kinetic(0, 0) - mean.layer_bias.kinetic(0, 0);
      layer_bias_ += mean.layer_bias.kinetic(0, 0);
      of_shear_ += of_shear;
    }
    left_out_ += all.left_out * static_cast<double>(frames);
    grains_ += (all.left_out + all.grains) * static_cast<double>(frames);
    const double part = all.own_part / all.mass;
    if (part > own_part_) own_part_ = part, own_frames_ = frames;
  }
}

template void KineticRemarks::add(const KineticStress<2>&, std::size_t, std::size_t);
template void KineticRemarks::add(const KineticStress<3>&, std::size_t, std::size_t);

std::vector<std::string> KineticRemarks::sentences(bool about_layer) const
{
  std::vector<std::string> all;
  if (about_layer)
    all.push_back(fmt::format(
        "{:.3g} % of K_xx about the layers' means is shear inside the layers (mass (du/dy h)^2/12: "
        "{:.3g} %); the columns layer_bias have it",
        100 * layer_bias_ / (profile_ + layer_bias_), 100 * of_shear_ / (profile_ + layer_bias_)));
  if (left_out_ > 0)
    all.push_back(fmt::format(
        "{:.0f} of {:.0f} grains (summed over frames) have fewer than two others in their layer or "
        "cell and do not count; the columns left_out have their number",
        left_out_, grains_));
  constexpr double little = 0.01;
  if (own_part_ > little)
    all.push_back(fmt::format(
        "with {} {} in a window the mean velocity at a grain is made of the grain itself by up to "
        "{:.2g} %, and its fluctuations are too small by as much; --mean profile-unbiased leaves "
        "the grain out",
        own_frames_, own_frames_ == 1 ? "frame" : "frames", 100 * own_part_));
  return all;
}

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
