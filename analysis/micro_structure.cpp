// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/micro_structure.hpp"

#include "analysis/add_up.hpp"

#include <fmt/format.h>

#include <limits>
#include <numbers>

namespace grseg {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

double ratio(double a, double b)
{
  return b > 0 ? a / b : nan;
}

std::size_t at(PairType type)
{
  return static_cast<std::size_t>(type);
}

template <std::size_t n>
void divide(std::array<double, n>& sums, double number)
{
  for (double& sum : sums) sum /= number;
}

}  // namespace

double neutral_mixed_share(double phi_large, double size_ratio)
{
  const double x_large = phi_large / (phi_large + size_ratio * (1 - phi_large));
  return 2 * x_large * (1 - x_large);
}

MicroSums& MicroSums::operator+=(const MicroSums& other)
{
  add_up(grains, other.grains);
  add_up(ends, other.ends);
  add_up(contacts, other.contacts);
  add_up(force, other.force);
  add_up(normal, other.normal);
  base_force += other.base_force;
  return *this;
}

MicroSums MicroSums::operator/(double number) const
{
  MicroSums result = *this;
  divide(result.grains, number);
  divide(result.ends, number);
  divide(result.contacts, number);
  divide(result.force, number);
  divide(result.normal, number);
  result.base_force /= number;
  return result;
}

double MicroSums::coordination(Species species) const
{
  const auto s = static_cast<std::size_t>(species);
  return ratio(ends[s], grains[s]);
}

double MicroSums::mean_force(Species species) const
{
  const bool large = species == Species::large;
  const auto own = at(large ? PairType::LL : PairType::SS), mixed = at(PairType::LS);
  const auto base = at(large ? PairType::Lb : PairType::Sb);
  return ratio(force[own] + force[mixed] + force[base],
               contacts[own] + contacts[mixed] + contacts[base]);
}

double MicroSums::mixed_share() const
{
  const double mixed = contacts[at(PairType::LS)];
  return ratio(mixed, contacts[at(PairType::LL)] + mixed + contacts[at(PairType::SS)]);
}

PressureEstimate estimate_pressure(const MicroSums& sums, double phi_large, double small_diameter,
                                   double large_diameter)
{
  const auto partial = [&](Species species, double phi, double diameter) {
    if (phi == 0) return 0.0;
    return phi * sums.coordination(species) * sums.mean_force(species) /
           (std::numbers::pi * diameter);
  };
  return {partial(Species::small, 1 - phi_large, small_diameter),
          partial(Species::large, phi_large, large_diameter)};
}

MicroStructure::MicroStructure(const Layers& layers, GrainArea area, double small_diameter,
                               double large_diameter)
    : layers_(layers),
      composition_(layers, area),
      small_diameter_(small_diameter),
      large_diameter_(large_diameter)
{
}

void MicroStructure::add(const Grains& grains, const Frame& frame)
{
  ++frames_;
  composition_.add(grains, frame);
  add_heights(grains, frame);
  sums_.resize(composition_.layers());
  for (std::size_t g = 0; g < grains.size(); ++g)
    if (is_mobile(grains, g))
      ++sums_[layers_.at(frame.position[g].y())]
            .grains[static_cast<std::size_t>(grains.species[g])];

  const auto& list = frame.contacts;
  const auto add_end = [&](std::int32_t grain) {
    const auto g = static_cast<std::size_t>(grain);
    if (grain >= 0 && is_mobile(grains, g))
      ++sums_[layers_.at(frame.position[g].y())].ends[static_cast<std::size_t>(grains.species[g])];
  };
  for (std::size_t k = 0; k < list.size(); ++k) {
    const double modulus = list.force[k].norm();
    if (modulus == 0) continue;
    const auto type = at(pair_type(grains, frame, k));
    const bool base = type == at(PairType::Sb) || type == at(PairType::Lb);
    const double y = contact_point(grains, frame, k).y();
    auto& sums = sums_[std::min(layers_.at(y), sums_.size() - 1)];
    ++sums.contacts[type];
    sums.force[type] += modulus;
    sums.normal[type] += list.force[k].dot(list.branch[k]) / list.branch[k].norm();
    if (base) sums.base_force += list.force[k];
    add_end(list.i[k]);
    add_end(list.j[k]);
  }
}

void MicroStructure::merge(const MicroStructure& others)
{
  frames_ += others.frames_;
  composition_.merge(others.composition_);
  add_up(sums_, others.sums_);
  heights_.large += others.heights_.large;
  heights_.small += others.heights_.small;
  heights_.bed += others.heights_.bed;
}

void MicroStructure::add_heights(const Grains& grains, const Frame& frame)
{
  std::array<double, 2> mass{}, moment{};
  double area = 0, area_moment = 0;
  for (std::size_t g = 0; g < grains.size(); ++g) {
    if (!is_mobile(grains, g)) continue;
    const auto species = static_cast<std::size_t>(grains.species[g]);
    const double y = frame.position[g].y(), square = grains.radius[g] * grains.radius[g];
    mass[species] += grains.mass[g];
    moment[species] += grains.mass[g] * y;
    area += square;
    area_moment += square * y;
  }
  heights_.small += ratio(moment[0], mass[0]);
  heights_.large += ratio(moment[1], mass[1]);
  heights_.bed += 2 * ratio(area_moment, area);
}

MicroSums MicroStructure::mean(std::size_t layer) const
{
  return sums_[layer] / static_cast<double>(frames_);
}

MicroSums MicroStructure::mean() const
{
  MicroSums all;
  for (const auto& sums : sums_) all += sums;
  return all / static_cast<double>(frames_);
}

BedHeights MicroStructure::heights() const
{
  const auto frames = static_cast<double>(frames_);
  return {heights_.large / frames, heights_.small / frames, heights_.bed / frames};
}

std::vector<std::string> MicroStructure::columns()
{
  std::vector<std::string> names{"grains_S", "grains_L", "ends_S", "ends_L"};
  for (const char* type : pair_type_names)
    for (const char* name : {"n_{}", "sum_f_{}[N]", "sum_fn_{}[N]"})
      names.push_back(fmt::format(fmt::runtime(name), type));
  names.insert(names.end(), {"yL[m]", "yS[m]", "height[m]", "phi_L", "z_S", "z_L", "f_S[N]",
                             "f_L[N]", "mixed_share", "neutral_share", "Pi[N/m]", "Pi_S[N/m]",
                             "Pi_L[N/m]", "Pi_printed[N/m]", "Pi_S_printed[N/m]",
                             "Pi_L_printed[N/m]", "base_fx[N]", "base_fy[N]"});
  return names;
}

std::vector<double> MicroStructure::row(const MicroSums& sums, double phi_large,
                                        const BedHeights& heights) const
{
  std::vector<double> row{sums.grains[0], sums.grains[1], sums.ends[0], sums.ends[1]};
  for (std::size_t type = 0; type < pair_types; ++type)
    row.insert(row.end(), {sums.contacts[type], sums.force[type], sums.normal[type]});
  const auto pi = estimate_pressure(sums, phi_large, small_diameter_, large_diameter_);
  row.insert(row.end(),
             {heights.large, heights.small, heights.bed, phi_large,
              sums.coordination(Species::small), sums.coordination(Species::large),
              sums.mean_force(Species::small), sums.mean_force(Species::large), sums.mixed_share(),
              neutral_mixed_share(phi_large, large_diameter_ / small_diameter_), pi.total(),
              pi.small, pi.large, 2 * pi.total(), 2 * pi.small, 2 * pi.large, sums.base_force.x(),
              sums.base_force.y()});
  return row;
}

std::vector<double> MicroStructure::row(std::size_t layer) const
{
  return row(mean(layer), composition_.mean(layer).phi_large(), {nan, nan, nan});
}

std::vector<double> MicroStructure::bed_row() const
{
  return row(mean(), composition_.mean().phi_large(), heights());
}

}  // namespace grseg
