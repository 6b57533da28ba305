// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/stress/kinetic_stress.hpp"

#include "analysis/frames/contacts.hpp"
#include "analysis/stress/contact_sums.hpp"
#include "formats/core/errors.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>

namespace grseg {

template <int D>
UnbiasedFluctuations<D>::UnbiasedFluctuations(const Layers& layers, const Grains& grains,
                                              const Frame<D>& frame)
    : cells_(layers.count(grains, frame))
{
  const auto each = [&](const auto& book) {
    for (std::size_t g = 0; g < grains.size(); ++g)
      if (is_mobile(grains, frame, g)) {
        const auto& position = frame.position[g];
        book(cells_[layers.template holding<D>(position, layers.template height<D>(position))],
             grains.mass[g], motion_of<D>(layers, frame, g));
      }
  };
  each([](CellSums& cell, double mass, const Motion<D>& motion) {
    ++cell.grains;
    cell.mass += mass;
    cell.squares += mass * mass;
    cell.mean += mass * motion;
  });
  for (auto& cell : cells_)
    if (cell.grains > 0) cell.mean /= cell.mass;
  each([](CellSums& cell, double mass, const Motion<D>& motion) {
    const Motion<D> excess = motion - cell.mean;
    cell.weighted += mass * mass * excess;
    cell.product += symmetric_product<D>(mass * mass, excess, excess);
  });
}

template <int D>
typename UnbiasedFluctuations<D>::Product UnbiasedFluctuations<D>::of(std::size_t layer,
                                                                      double mass,
                                                                      const Motion<D>& motion) const
{
  const CellSums& cell = cells_[layer];
  const Motion<D> excess = motion - cell.mean;
  const double pairs =
      (cell.mass - mass) * (cell.mass - mass) - cell.squares + mass * mass;  // sum m_j m_k, j != k
  auto product =
      symmetric_product<D>((cell.mass * cell.mass - cell.squares) / pairs, excess, excess);
  product += symmetric_product<D>(2 / pairs, excess, cell.weighted);
  product += {-1 / pairs * cell.product.velocities, -1 / pairs * cell.product.spins};
  return product;
}

template class UnbiasedFluctuations<2>;
template class UnbiasedFluctuations<3>;

namespace {

template <int D>
double moment_of_inertia(double mass, double radius)
{
  return inertia_factor<D> * mass * radius * radius;
}

/// Fluctuations of one grain with the motion `excess` relative to the mean.
template <int D>
Fluctuations<D> fluctuations(double mass, double radius, const Motion<D>& excess)
{
  const Vector<D> velocity = excess.template head<D>();
  const double moment = moment_of_inertia<D>(mass, radius);
  double rotational = moment * excess[D] * excess[D];
  for (Eigen::Index axis = D + 1; axis < excess.size(); ++axis)
    rotational += moment * excess[axis] * excess[axis];
  return {mass * velocity * velocity.transpose(), rotational};
}

template <int D>
Fluctuations<D> operator-(Fluctuations<D> a, const Fluctuations<D>& b)
{
  a.kinetic -= b.kinetic;
  a.rotational -= b.rotational;
  return a;
}

/// Product of fluctuations of a grain about the mean of others, less the covariance of that mean.
template <int D>
std::optional<MotionProduct<D>> about_others(const std::optional<MotionOfOthers<D>>& others,
                                             const Motion<D>& motion)
{
  if (!others) return std::nullopt;
  const Motion<D> excess = motion - others->mean;
  auto product = symmetric_product<D>(1, excess, excess);
  product += {-others->covariance.velocities, -others->covariance.spins};
  return product;
}

bool is_unbiased(MeanFlow flow)
{
  return flow == MeanFlow::instant_unbiased || flow == MeanFlow::profile_unbiased;
}

}  // namespace

template <int D>
typename KineticStress<D>::Temperatures KineticStress<D>::Mean::temperature() const
{
  if (!(mass > 0)) return Temperatures::Constant(no_number);
  Temperatures energies;
  energies << about_mean.kinetic.diagonal(), about_mean.rotational;
  return energies / mass;
}

template <int D>
KineticStress<D>::KineticStress(const Layers& layers, MeanFlow flow, const MeanVelocity<D>& mean,
                                std::size_t species)
    : layers_(layers), flow_(flow), mean_velocity_(mean), species_(species)
{
  mean_velocity_.finish();
}

template <int D>
void KineticStress<D>::add(const Grains& grains, const Frame<D>& frame)
{
  ++frames_;
  sums_.resize(std::max(sums_.size(), layers_.count(grains, frame)),
               {std::vector<Mean>(species_), {}});
  const auto* over_map = mean_velocity_.over_map();
  MeanVelocity<D> now(layers_, layers_.thickness(), species_);
  if (flow_ == MeanFlow::instant) now.add(grains, frame);
  std::optional<UnbiasedFluctuations<D>> unbiased;
  if (flow_ == MeanFlow::instant_unbiased) unbiased.emplace(layers_, grains, frame);
  for (std::size_t g = 0; g < grains.size(); ++g) {
    if (!is_mobile(grains, frame, g)) continue;
    const double mass = grains.mass[g], radius = grains.radius[g];
    const auto& position = frame.position[g];
    const double y = layers_.height<D>(position);
    const Motion<D> motion = motion_of<D>(layers_, frame, g);
    const auto species = static_cast<std::size_t>(grains.species[g]);
    const std::size_t layer = layers_.holding<D>(position, y);
    const auto about = [&](const Motion<D>& mean) {
      return fluctuations<D>(mass, radius, motion - mean);
    };
    sums_[layer].flow.template add<D>(mass, layers_.above_bottom(y, layer),
                                      motion.template head<D>());
    auto& own = sums_[layer].species[species];
    std::optional<MotionProduct<D>> product;  // for means that do not include the grain
    if (unbiased && unbiased->has(layer)) product = unbiased->of(layer, mass, motion);
    if (flow_ == MeanFlow::profile_unbiased)
      product = over_map
                    ? over_map->about_others(position, mass, motion)
                    : about_others(mean_velocity_.on_profile_of_others(y, mass, motion), motion);
    if (is_unbiased(flow_) && !product) {
      own.left_out += 1;
      continue;
    }
    own.mass += mass;
    own.content += grain_volume<D>(radius);
    own.grains += 1;
    if (product) {
      own.about_mean +=
          {mass * product->velocities, moment_of_inertia<D>(mass, radius) * product->spins};
    } else if (flow_ == MeanFlow::species) {
      own.about_mean += about(mean_velocity_.of_species(layer, grains.species[g]));
    } else if (flow_ != MeanFlow::profile) {
      own.about_mean += about((flow_ == MeanFlow::instant ? now : mean_velocity_).of_layer(layer));
    }
    const auto about_profile =
        about(over_map ? over_map->at(position) : mean_velocity_.on_profile(y));
    if (flow_ == MeanFlow::profile) {
      own.about_mean += about_profile;
      own.own_part +=
          mass * (over_map ? over_map->own_part(position, mass) : mean_velocity_.own_part(y, mass));
    }
    own.layer_bias += about(mean_velocity_.of_layer(layer)) - about_profile;
  }
}

template <int D>
void KineticStress<D>::merge(const KineticStress& others)
{
  frames_ += others.frames_;
  accumulate(sums_, others.sums_);
}

template <int D>
typename KineticStress<D>::Mean KineticStress<D>::mean(std::size_t layer, Species species) const
{
  return sums_[layer].species[static_cast<std::size_t>(species)] / static_cast<double>(frames_);
}

template <int D>
LayerFlow KineticStress<D>::flow(std::size_t layer) const
{
  return sums_[layer].flow.mean(layers_.thickness());
}

template <int D>
typename KineticStress<D>::Temperatures KineticStress<D>::equipartition(std::size_t layer) const
{
  const auto energy = [&](Species species) -> Temperatures {
    const auto own = mean(layer, species);
    return own.temperature() * own.mass / own.grains;
  };
  return energy(Species::large).array() / energy(Species::small).array();
}

template <int D>
double KineticStress<D>::shear_bias(std::size_t layer, Species species) const
{
  const double difference = flow(layer).du_dy * layers_.thickness();
  return mean(layer, species).mass * difference * difference / 12;
}

template <int D>
std::vector<Cell> KineticStress<D>::cells(const SpeciesList& species,
                                          std::optional<std::size_t> layer) const
{
  const auto words = column_words(species);
  const auto components = tensor_components(D);
  std::vector<Cell> cells;
  std::vector<Mean> means;
  for (std::size_t k = 0; k < words.size(); ++k)
    means.push_back(layer ? mean(*layer, static_cast<Species>(k)) : Mean{});
  const auto each = [&](const char* name, const auto& number) {
    for (std::size_t k = 0; k < words.size(); ++k)
      cells.push_back({fmt::format(fmt::runtime(name), words[k]), number(means[k])});
  };
  const auto shear = layer ? flow(*layer) : LayerFlow{};
  each("mass_{}[kg]", [](const Mean& own) { return own.mass; });
  add_all(cells, {{"u[m/s]", shear.u}, {"v[m/s]", shear.v}, {"du_dy[1/s]", shear.du_dy}});
  for (std::size_t k = 0; k < words.size(); ++k)
    for (const auto& [suffix, row, column] : components)
      cells.push_back(
          {fmt::format("K_{}{}[J]", words[k], suffix), means[k].about_mean.kinetic(row, column)});
  each("Kr_{}[J]", [](const Mean& own) { return own.about_mean.rotational; });
  each("grains_{}", [](const Mean& own) { return own.grains; });
  const auto each_freedom = [&](const std::string& name, const char* unit, const auto& numbers) {
    Eigen::Index place = 0;
    for (const char freedom : std::string_view(D == 2 ? "xyr" : "xyzr"))  // r: rotation
      cells.push_back({fmt::format("{}_{}{}", name, freedom, unit), numbers[place++]});
  };
  for (std::size_t k = 0; k < words.size(); ++k)
    each_freedom("T_" + words[k], "[m^2/s^2]", means[k].temperature());
  if (words.size() == 2)
    each_freedom("equipartition", "",
                 layer ? equipartition(*layer) : Temperatures(Temperatures::Constant(no_number)));
  if (is_unbiased(flow_)) each("left_out_{}", [](const Mean& own) { return own.left_out; });
  for (std::size_t k = 0; k < words.size(); ++k) {
    for (const auto& [suffix, row, column] : components)
      if (row <= column)
        cells.push_back({fmt::format("layer_bias_{}{}[J]", words[k], suffix),
                         means[k].layer_bias.kinetic(row, column)});
    cells.push_back({fmt::format("layer_bias_{}_r[J]", words[k]), means[k].layer_bias.rotational});
    cells.push_back({fmt::format("shear_bias_{}_xx[J]", words[k]),
                     layer ? shear_bias(*layer, static_cast<Species>(k)) : no_number});
  }
  return cells;
}

template class KineticStress<2>;
template class KineticStress<3>;

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
  add_all(cells, flow_fields<D>(velocity, all));
  cells.push_back({"shear_rate[1/s]", layer ? stress.shear_rate(*layer) : no_number});
  return cells;
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
        "{:.3g} % of K_xx about the layers' means is due to shear inside the layers (mass (du/dy "
        "h)^2/12: {:.3g} %); see the columns layer_bias",
        100 * layer_bias_ / (profile_ + layer_bias_), 100 * of_shear_ / (profile_ + layer_bias_)));
  if (left_out_ > 0)
    all.push_back(fmt::format(
        "{:.0f} of {:.0f} grains (summed over frames) are left out, because fewer than two others "
        "are in their layer or cell; see the columns left_out",
        left_out_, grains_));
  constexpr double little = 0.01;
  if (own_part_ > little)
    all.push_back(fmt::format(
        "with {} {} in a window, a grain contributes up to {:.2g} % to the mean velocity at its "
        "place, which reduces its fluctuations by this share; --mean profile-unbiased avoids it",
        own_frames_, own_frames_ == 1 ? "frame" : "frames", 100 * own_part_));
  return all;
}

template <int D>
void to_middle_of_step(const Grains& grains, double step, bool turning, Frame<D>& frame)
{
  if (frame.force.size() != grains.size())
    throw FormatError(
        "the frame has no forces of grains (/particles/grains/force), which the velocity in the "
        "middle of a step needs");
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
        "--velocity {}: {} was imported, so each frame has only one velocity of a grain; leave out "
        "--velocity",
        word, run.path()));
  return "instant";
}

}  // namespace grseg
