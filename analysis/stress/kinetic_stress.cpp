// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/stress/kinetic_stress.hpp"

#include "analysis/frames/accumulate.hpp"

#include <limits>

namespace grseg {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// Of one grain that moves by `excess` more than the mean.
Fluctuations fluctuations(double mass, double radius, const Motion& excess)
{
  const Vec2 velocity = excess.head<2>();
  return {mass * velocity * velocity.transpose(),
          mass * radius * radius / 2 * excess[2] * excess[2]};
}

Fluctuations operator-(Fluctuations a, const Fluctuations& b)
{
  a.kinetic -= b.kinetic;
  a.rotational -= b.rotational;
  return a;
}

/// What the columns of a layer are made of.
struct LayerNumbers {
  KineticStress::Mean small, large;
  LayerFlow flow;
  Eigen::Vector3d equipartition;
  double shear_bias_small, shear_bias_large;
};

struct KineticColumn {
  const char* name;
  double (*of)(const LayerNumbers&);
};

/// The one list of the columns of grseg-kinetic behind the key: to add one is to add a line.
constexpr KineticColumn kinetic_columns[] = {
    {"mass_S[kg]", [](const LayerNumbers& r) { return r.small.mass; }},
    {"mass_L[kg]", [](const LayerNumbers& r) { return r.large.mass; }},
    {"u[m/s]", [](const LayerNumbers& r) { return r.flow.u; }},
    {"v[m/s]", [](const LayerNumbers& r) { return r.flow.v; }},
    {"du_dy[1/s]", [](const LayerNumbers& r) { return r.flow.du_dy; }},
    {"K_S_xx[J]", [](const LayerNumbers& r) { return r.small.about_mean.kinetic(0, 0); }},
    {"K_S_xy[J]", [](const LayerNumbers& r) { return r.small.about_mean.kinetic(0, 1); }},
    {"K_S_yx[J]", [](const LayerNumbers& r) { return r.small.about_mean.kinetic(1, 0); }},
    {"K_S_yy[J]", [](const LayerNumbers& r) { return r.small.about_mean.kinetic(1, 1); }},
    {"K_L_xx[J]", [](const LayerNumbers& r) { return r.large.about_mean.kinetic(0, 0); }},
    {"K_L_xy[J]", [](const LayerNumbers& r) { return r.large.about_mean.kinetic(0, 1); }},
    {"K_L_yx[J]", [](const LayerNumbers& r) { return r.large.about_mean.kinetic(1, 0); }},
    {"K_L_yy[J]", [](const LayerNumbers& r) { return r.large.about_mean.kinetic(1, 1); }},
    {"Kr_S[J]", [](const LayerNumbers& r) { return r.small.about_mean.rotational; }},
    {"Kr_L[J]", [](const LayerNumbers& r) { return r.large.about_mean.rotational; }},
    {"grains_S", [](const LayerNumbers& r) { return r.small.grains; }},
    {"grains_L", [](const LayerNumbers& r) { return r.large.grains; }},
    {"T_S_x[m^2/s^2]", [](const LayerNumbers& r) { return r.small.temperature()[0]; }},
    {"T_S_y[m^2/s^2]", [](const LayerNumbers& r) { return r.small.temperature()[1]; }},
    {"T_S_r[m^2/s^2]", [](const LayerNumbers& r) { return r.small.temperature()[2]; }},
    {"T_L_x[m^2/s^2]", [](const LayerNumbers& r) { return r.large.temperature()[0]; }},
    {"T_L_y[m^2/s^2]", [](const LayerNumbers& r) { return r.large.temperature()[1]; }},
    {"T_L_r[m^2/s^2]", [](const LayerNumbers& r) { return r.large.temperature()[2]; }},
    {"equipartition_x", [](const LayerNumbers& r) { return r.equipartition[0]; }},
    {"equipartition_y", [](const LayerNumbers& r) { return r.equipartition[1]; }},
    {"equipartition_r", [](const LayerNumbers& r) { return r.equipartition[2]; }},
    {"layer_bias_S_xx[J]", [](const LayerNumbers& r) { return r.small.layer_bias.kinetic(0, 0); }},
    {"layer_bias_S_xy[J]", [](const LayerNumbers& r) { return r.small.layer_bias.kinetic(0, 1); }},
    {"layer_bias_S_yy[J]", [](const LayerNumbers& r) { return r.small.layer_bias.kinetic(1, 1); }},
    {"layer_bias_S_r[J]", [](const LayerNumbers& r) { return r.small.layer_bias.rotational; }},
    {"shear_bias_S_xx[J]", [](const LayerNumbers& r) { return r.shear_bias_small; }},
    {"layer_bias_L_xx[J]", [](const LayerNumbers& r) { return r.large.layer_bias.kinetic(0, 0); }},
    {"layer_bias_L_xy[J]", [](const LayerNumbers& r) { return r.large.layer_bias.kinetic(0, 1); }},
    {"layer_bias_L_yy[J]", [](const LayerNumbers& r) { return r.large.layer_bias.kinetic(1, 1); }},
    {"layer_bias_L_r[J]", [](const LayerNumbers& r) { return r.large.layer_bias.rotational; }},
    {"shear_bias_L_xx[J]", [](const LayerNumbers& r) { return r.shear_bias_large; }},
};

}  // namespace

Fluctuations& Fluctuations::operator+=(const Fluctuations& other)
{
  kinetic += other.kinetic;
  rotational += other.rotational;
  return *this;
}

Fluctuations Fluctuations::operator/(double number) const
{
  return {kinetic / number, rotational / number};
}

Eigen::Vector3d KineticStress::Mean::temperature() const
{
  if (!(mass > 0)) return Eigen::Vector3d::Constant(nan);
  const auto& [kinetic, rotational] = about_mean;
  return Eigen::Vector3d{kinetic(0, 0), kinetic(1, 1), rotational} / mass;
}

KineticStress::Mean& KineticStress::Mean::operator+=(const Mean& other)
{
  mass += other.mass;
  grains += other.grains;
  about_mean += other.about_mean;
  layer_bias += other.layer_bias;
  return *this;
}

KineticStress::Sums& KineticStress::Sums::operator+=(const Sums& others)
{
  accumulate(species, others.species);
  flow += others.flow;
  return *this;
}

KineticStress::KineticStress(const Layers& layers, MeanFlow flow, const MeanVelocity& mean)
    : layers_(layers), flow_(flow), mean_velocity_(mean)
{
  mean_velocity_.finish();
}

Motion KineticStress::mean_at(std::size_t layer, Species species, double y,
                              const MeanVelocity& now) const
{
  switch (flow_) {
    case MeanFlow::profile:
      return mean_velocity_.on_profile(y);
    case MeanFlow::layer:
      return mean_velocity_.of_layer(layer);
    case MeanFlow::instant:
      return now.of_layer(layer);
    case MeanFlow::species:
      return mean_velocity_.of_species(layer, species);
  }
  return Motion::Constant(nan);
}

void KineticStress::add(const Grains& grains, const Frame<2>& frame)
{
  ++frames_;
  sums_.resize(std::max(sums_.size(), layers_.count(grains, frame)));
  MeanVelocity now(layers_, layers_.thickness());
  if (flow_ == MeanFlow::instant) now.add(grains, frame);
  for (std::size_t g = 0; g < grains.size(); ++g) {
    if (!is_mobile(grains, g)) continue;
    const double mass = grains.mass[g], radius = grains.radius[g];
    const double y = layers_.height(frame.position[g]);
    const Vec2 velocity = layers_.turned(frame.velocity[g], frame.position[g]);
    const Motion motion{velocity.x(), velocity.y(), frame.angular_velocity[g]};
    const auto species = grains.species[g];
    const std::size_t layer = layers_.at(y);
    const auto about = [&](const Motion& mean) {
      return fluctuations(mass, radius, motion - mean);
    };
    auto& own = sums_[layer].species[static_cast<std::size_t>(species)];
    own.mass += mass;
    own.grains += 1;
    own.about_mean += about(mean_at(layer, species, y, now));
    own.layer_bias += about(mean_velocity_.of_layer(layer)) - about(mean_velocity_.on_profile(y));
    sums_[layer].flow.add(mass, y - layers_.bottom(layer), velocity);
  }
}

void KineticStress::merge(const KineticStress& others)
{
  frames_ += others.frames_;
  accumulate(sums_, others.sums_);
}

KineticStress::Mean KineticStress::mean(std::size_t layer, Species species) const
{
  const auto& sum = sums_[layer].species[static_cast<std::size_t>(species)];
  const auto frames = static_cast<double>(frames_);
  return {sum.mass / frames, sum.grains / frames, sum.about_mean / frames, sum.layer_bias / frames};
}

LayerFlow KineticStress::flow(std::size_t layer) const
{
  return sums_[layer].flow.mean(layers_.thickness());
}

Eigen::Vector3d KineticStress::equipartition(std::size_t layer) const
{
  const auto energy = [&](Species species) -> Eigen::Vector3d {
    const auto own = mean(layer, species);
    return own.temperature() * own.mass / own.grains;
  };
  return energy(Species::large).array() / energy(Species::small).array();
}

double KineticStress::shear_bias(std::size_t layer, Species species) const
{
  const double difference = flow(layer).du_dy * layers_.thickness();
  return mean(layer, species).mass * difference * difference / 12;
}

std::vector<std::string> KineticStress::columns()
{
  std::vector<std::string> names;
  for (const auto& column : kinetic_columns) names.emplace_back(column.name);
  return names;
}

std::vector<double> KineticStress::row(std::size_t layer) const
{
  const LayerNumbers numbers{.small = mean(layer, Species::small),
                             .large = mean(layer, Species::large),
                             .flow = flow(layer),
                             .equipartition = equipartition(layer),
                             .shear_bias_small = shear_bias(layer, Species::small),
                             .shear_bias_large = shear_bias(layer, Species::large)};
  std::vector<double> row;
  for (const auto& column : kinetic_columns) row.push_back(column.of(numbers));
  return row;
}

}  // namespace grseg
