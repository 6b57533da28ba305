// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/segregation/flux.hpp"

#include "analysis/frames/composition.hpp"
#include "analysis/frames/mean_velocity.hpp"
#include "analysis/frames/sums.hpp"
#include "analysis/stress/contact_sums.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace grseg {
namespace {

/// A quantity that is printed with its error: name, unit and member.
struct Quantity {
  const char *name, *unit;
  double LayerSegregation::*place;
};
constexpr std::array quantities{Quantity{"phi_L", "", &LayerSegregation::phi_large},
                                Quantity{"w_S", "[m/s]", &LayerSegregation::w_small},
                                Quantity{"w_L", "[m/s]", &LayerSegregation::w_large},
                                Quantity{"q_S", "[m/s]", &LayerSegregation::q_small},
                                Quantity{"q_L", "[m/s]", &LayerSegregation::q_large},
                                Quantity{"D_S", "[m^2/s]", &LayerSegregation::D_small},
                                Quantity{"D_L", "[m^2/s]", &LayerSegregation::D_large},
                                Quantity{"D2_S", "[m^2/s]", &LayerSegregation::D2_small},
                                Quantity{"D2_L", "[m^2/s]", &LayerSegregation::D2_large},
                                Quantity{"Dhat_S", "", &LayerSegregation::Dhat_small},
                                Quantity{"Dhat_L", "", &LayerSegregation::Dhat_large},
                                Quantity{"D", "[m^2/s]", &LayerSegregation::D},
                                Quantity{"dphi_dy", "[1/m]", &LayerSegregation::gradient},
                                Quantity{"S", "[m/s]", &LayerSegregation::S},
                                Quantity{"Pe", "", &LayerSegregation::peclet}};

/// Jackknife standard errors; left_out[k] are the values without part k.
LayerSegregation jackknife(const std::vector<LayerSegregation>& left_out)
{
  LayerSegregation error{};
  const auto n = static_cast<double>(left_out.size());
  for (const auto& [name, unit, place] : quantities) {
    double mean = 0, squares = 0;
    for (const auto& value : left_out) mean += value.*place / n;
    for (const auto& value : left_out) squares += std::pow(value.*place - mean, 2);
    error.*place = n > 1 ? std::sqrt((n - 1) / n * squares) : no_number;
  }
  return error;
}

}  // namespace

template <int D>
SegregationFlux<D>::SegregationFlux(const Layers& layers, const Window& window,
                                    double small_diameter, double large_diameter)
    : layers_(layers),
      begin_(window.begin),
      length_(window.end - window.begin),
      diameter_{small_diameter, large_diameter}
{
}

template <int D>
void SegregationFlux<D>::add(const Grains& grains, const Frame<D>& frame)
{
  ++frames_;
  // The time of an imported frame may lie on the edge of a part; rounding must not move it before.
  constexpr double round_off = 1e-9;
  const double passed = (frame.time - begin_) / length_ * static_cast<double>(parts) + round_off;
  const auto part = static_cast<std::size_t>(std::clamp(passed, 0.0, parts - 1.0));
  if (!one_density_) one_density_ = have_one_density<D>(grains);
  Profile now(layers_.count(grains, frame));
  struct Moved {
    double weight = 0, all = 0, large = 0;  // weight, and weighted velocities of all and of large
  };
  std::vector<Moved> moved(now.size());
  Instant instant{frame.time, std::vector<std::array<double, 2>>(now.size())};
  for (std::size_t g = 0; g < grains.size(); ++g) {
    if (!is_mobile(grains, frame, g)) continue;
    const auto species = static_cast<std::size_t>(grains.species[g]);
    const double y = frame.position[g].y(), radius = grains.radius[g], mass = grains.mass[g];
    const std::size_t layer = layers_.at(y);
    const double content = grain_volume<D>(radius), weight = *one_density_ ? mass : content;
    now[layer].content[species] += content;
    now[layer].mass[species] += mass;
    now[layer].flow.add(mass, y - layers_.bottom(layer), frame.velocity[g]);
    const double v = frame.velocity[g].y();
    now[layer].mvv[species] += mass * v * v;
    instant.momentum[layer][species] += mass * v;
    moved[layer].weight += weight;
    moved[layer].all += weight * v;
    if (species == 1) moved[layer].large += weight * v;
  }
  for (std::size_t n = 0; n < now.size(); ++n)
    if (now[n].mass[0] > 0 && now[n].mass[1] > 0)
      now[n].excess =
          moved[n].large - now[n].weight(*one_density_)[1] * moved[n].all / moved[n].weight;
  accumulate(profile_[part], now);
  if (first_.momentum.empty() || frame.time < first_.time) first_ = instant;
  if (last_.momentum.empty() || frame.time > last_.time) last_ = instant;

  auto& [time, heights] = snapshot_[part];
  if (!heights.empty() && time <= frame.time) return;
  time = frame.time;
  heights.clear();
  for (const auto& position : frame.position) heights.push_back(position.y());
}

template <int D>
void SegregationFlux<D>::merge(const SegregationFlux& others)
{
  frames_ += others.frames_;
  if (!one_density_) one_density_ = others.one_density_;
  for (std::size_t part = 0; part < parts; ++part) {
    accumulate(profile_[part], others.profile_[part]);
    const auto &own = snapshot_[part], &other = others.snapshot_[part];
    if (!other.y.empty() && (own.y.empty() || other.time < own.time)) snapshot_[part] = other;
  }
  if (others.first_.momentum.empty()) return;
  if (first_.momentum.empty() || others.first_.time < first_.time) first_ = others.first_;
  if (last_.momentum.empty() || others.last_.time > last_.time) last_ = others.last_;
}

template <int D>
void SegregationFlux<D>::add_displacements(const Grains& grains, std::size_t part, std::size_t lag,
                                           Profile& profile) const
{
  if (part + lag >= parts) return;
  const auto &from = snapshot_[part], &to = snapshot_[part + lag];
  if (from.y.empty() || to.y.empty()) return;
  struct Drift {
    double number = 0, sum = 0;
  };
  std::vector<std::array<Drift, 2>> drift(profile.size());
  const auto for_each_grain = [&](const auto& use) {
    for (std::size_t g = 0; g < grains.size(); ++g)
      if (is_mobile(grains, g) && !std::isnan(from.y[g]) && !std::isnan(to.y[g]))
        use(layers_.at(from.y[g]), static_cast<std::size_t>(grains.species[g]),
            to.y[g] - from.y[g]);
  };
  for_each_grain([&](std::size_t layer, std::size_t species, double dy) {
    drift[layer][species].number += 1;
    drift[layer][species].sum += dy;
  });
  for_each_grain([&](std::size_t layer, std::size_t species, double dy) {
    const auto [number, sum] = drift[layer][species];
    const double excess = dy - sum / number;
    profile[layer].squares[lag - 1][species] += excess * excess / (2 * (to.time - from.time));
  });
  for (std::size_t n = 0; n < profile.size(); ++n)
    for (std::size_t species = 0; species < 2; ++species)
      profile[n].number[lag - 1][species] += std::max(drift[n][species].number - 1, 0.0);
}

template <int D>
double SegregationFlux<D>::gradient(const Profile& profile, std::size_t layer) const
{
  // A neighbour with less than half of this layer's content, like the spray above the bed, is not
  // used.
  const auto content = [&](std::size_t n) { return profile[n].content[0] + profile[n].content[1]; };
  const auto usable = [&](std::size_t n) {
    return n < profile.size() && content(n) > 0 && content(n) >= content(layer) / 2;
  };
  const auto height = [&](std::size_t n) {
    return layers_.bottom(n) + profile[n].flow.my / profile[n].flow.mass;
  };
  const std::size_t below = layer > 0 && usable(layer - 1) ? layer - 1 : layer;
  const std::size_t above = usable(layer + 1) ? layer + 1 : layer;
  if (below == above) return no_number;
  return (profile[above].phi_large() - profile[below].phi_large()) /
         (height(above) - height(below));
}

template <int D>
LayerSegregation SegregationFlux<D>::evaluate(const Profile& profile, std::size_t layer,
                                              double bed) const
{
  const auto& sums = profile[layer];
  const auto diffusivity = [&](std::size_t lag, std::size_t species) {
    return ratio(sums.squares[lag][species], sums.number[lag][species]);
  };
  LayerSegregation r{};
  r.phi_large = ratio(sums.content[1], sums.content[0] + sums.content[1]);
  const double phi_small = 1 - r.phi_large;
  const auto& weight = sums.weight(one_density_.value_or(true));
  r.w_small = ratio(-sums.excess, weight[0]);
  r.w_large = ratio(sums.excess, weight[1]);
  r.q_small = phi_small > 0 ? phi_small * r.w_small : 0 * phi_small;
  r.q_large = r.phi_large > 0 ? r.phi_large * r.w_large : 0 * r.phi_large;
  r.D_small = diffusivity(0, 0);
  r.D_large = diffusivity(0, 1);
  r.D2_small = diffusivity(1, 0);
  r.D2_large = diffusivity(1, 1);
  const double d = phi_small * diameter_[0] + r.phi_large * diameter_[1];
  const double unit = std::abs(sums.flow.mean(layers_.thickness()).du_dy) * d * d;
  r.Dhat_small = r.D_small / unit;
  r.Dhat_large = r.D_large / unit;
  r.D = std::isnan(r.D_large)   ? r.D_small
        : std::isnan(r.D_small) ? r.D_large
                                : phi_small * r.D_large + r.phi_large * r.D_small;
  r.gradient = gradient(profile, layer);
  const double both = r.phi_large * phi_small;
  r.S = ratio(r.q_large + r.D * r.gradient, both);
  r.peclet = r.S * bed / r.D;
  return r;
}

template <int D>
std::vector<SegregationResult> SegregationFlux<D>::results(const Grains& grains, double bed) const
{
  auto profile = profile_;
  std::size_t layers = 0;
  for (const auto& own : profile) layers = std::max(layers, own.size());
  for (std::size_t part = 0; part < parts; ++part) {
    profile[part].resize(layers);
    for (const std::size_t lag : {1U, 2U}) add_displacements(grains, part, lag, profile[part]);
  }
  const auto without = [&](std::size_t part) {
    Profile sum(layers);
    for (std::size_t k = 0; k < parts; ++k)
      if (k != part) accumulate(sum, profile[k]);
    return sum;
  };
  const Profile all = without(parts);
  std::vector<Profile> left_out;
  for (std::size_t part = 0; part < parts; ++part)
    if (!snapshot_[part].y.empty()) left_out.push_back(without(part));

  std::vector<SegregationResult> results;
  for (std::size_t n = 0; n < layers; ++n) {
    const auto values =
        listed(left_out, [&](const Profile& others) { return evaluate(others, n, bed); });
    const auto frames = static_cast<double>(frames_);
    const auto& sums = all[n];
    std::array<LayerMomentum, 2> momentum;
    for (std::size_t k = 0; k < 2; ++k)
      momentum[k] = {sums.mass[k] / frames, sums.mvv[k] / frames,
                     (last_.at(n, k) - first_.at(n, k)) / (last_.time - first_.time)};
    results.push_back({sums.content[0] / frames, sums.content[1] / frames, sums.flow.mass / frames,
                       sums.flow.mean(layers_.thickness()), sums.number[0], evaluate(all, n, bed),
                       jackknife(values), momentum});
  }
  return results;
}

std::vector<Cell> SegregationResult::cells(int dimension) const
{
  const auto contents = content_columns(two_sizes(0, 0), dimension);
  std::vector<Cell> cells{{contents[0], content_small},
                          {contents[1], content_large},
                          {"u[m/s]", flow.u},
                          {"v[m/s]", flow.v},
                          {"du_dy[1/s]", flow.du_dy},
                          {"displacements_S", displacements[0]},
                          {"displacements_L", displacements[1]}};
  for (const auto& [name, unit, place] : quantities) {
    cells.push_back({fmt::format("{}{}", name, unit), value.*place});
    cells.push_back({fmt::format("{}_error{}", name, unit), error.*place});
  }
  for (const auto& [name, place] : {std::pair{"mass_{}[kg]", &LayerMomentum::mass},
                                    {"mvv_{}_yy[J]", &LayerMomentum::flux},
                                    {"gain_{}_y[N]", &LayerMomentum::gain}})
    for (std::size_t k = 0; k < 2; ++k)
      cells.push_back({fmt::format(fmt::runtime(name), k == 0 ? "S" : "L"), momentum[k].*place});
  return cells;
}

template class SegregationFlux<2>;
template class SegregationFlux<3>;

template <int D>
double mixing_index(const Layers& layers, const Grains& grains, const Frame<D>& frame)
{
  Composition<D> composition(layers, GrainArea::centre);
  composition.add(grains, frame);
  std::array<double, 2> number{};
  for (std::size_t g = 0; g < grains.size(); ++g)
    if (is_mobile(grains, frame, g)) ++number[static_cast<std::size_t>(grains.species[g])];
  const auto all = composition.mean();
  const double volume = all[0] + all[1], phi = all[1] / volume;
  if (!(phi > 0 && phi < 1)) return no_number;

  double variance = 0, occupied = 0;
  for (std::size_t n = 0; n < composition.layers(); ++n) {
    const auto here = composition.mean(n);
    const double own = here[0] + here[1];
    if (!(own > 0)) continue;
    const double excess = here[1] / own - phi;
    variance += own * excess * excess / volume;
    ++occupied;
  }
  const double apart = phi * (1 - phi);
  const double of_one = (1 - phi) * all[1] / number[1] + phi * all[0] / number[0];
  const double random = occupied * apart * of_one / volume;
  return (apart - variance) / (apart - random);
}

template double mixing_index(const Layers&, const Grains&, const Frame<2>&);
template double mixing_index(const Layers&, const Grains&, const Frame<3>&);

namespace {

/// Slope of the least-squares line u(y) from 10 to 90 % of the height of the bed, 1/s.
template <int D>
double shear_rate(const Grains& grains, const Frame<D>& frame, double bed)
{
  LayerFlowSums sums;
  for (std::size_t g = 0; g < grains.size(); ++g) {
    const double y = frame.position[g].y();
    if (is_mobile(grains, frame, g) && y > 0.1 * bed && y < 0.9 * bed)
      sums.add(grains.mass[g], y, frame.velocity[g]);
  }
  return sums.mean(bed).du_dy;
}

}  // namespace

template <int D>
void SegregationSeries<D>::add(const Grains& grains, const Frame<D>& frame)
{
  const auto heights = bed_heights(grains, frame);
  BedState now;
  now.time = frame.time;
  now.large = heights.large;
  now.small = heights.small;
  now.bed = heights.bed;
  now.shear_rate = shear_rate(grains, frame, now.bed);
  now.mixing = mixing_index(layers_, grains, frame);
  if (!states_.empty()) {
    const auto& last = states_.back();
    now.strain = last.strain + (last.shear_rate + now.shear_rate) / 2 * (now.time - last.time);
  }
  states_.push_back(now);
}

template <int D>
void SegregationSeries<D>::merge(const SegregationSeries& later)
{
  if (later.states_.empty()) return;
  double offset = 0;
  if (!states_.empty()) {
    const auto &last = states_.back(), &next = later.states_.front();
    offset = last.strain + (last.shear_rate + next.shear_rate) / 2 * (next.time - last.time);
  }
  for (auto state : later.states_) {
    state.strain += offset;
    states_.push_back(state);
  }
}

template class SegregationSeries<2>;
template class SegregationSeries<3>;

}  // namespace grseg
