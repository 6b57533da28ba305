// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/micro/micro_structure.hpp"

#include "analysis/frames/accumulate.hpp"

#include <cmath>

namespace grseg {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

std::size_t at(PairType type)
{
  return static_cast<std::size_t>(type);
}

bool is_base(PairType type)
{
  return type == PairType::Sb || type == PairType::Lb;
}

/// The large grain's share of a mixed contact, r_L/(r_L + r_S).
double share_by_size(const Grains& grains, const ContactList& list, std::size_t contact)
{
  const auto i = static_cast<std::size_t>(list.i[contact]);
  const auto j = static_cast<std::size_t>(list.j[contact]);
  const double r_large = grains.radius[grains.species[i] == Species::large ? i : j];
  return r_large / (grains.radius[i] + grains.radius[j]);
}

/// Of the contacts between mobile grains of one layer in one frame.
struct LayerForce {
  double contacts = 0, normal = 0;
};

/// A contact that has been booked.
struct Booked {
  std::size_t layer;
  PairType type;
  double f_n;
};

}  // namespace

ForceParts force_parts(const ContactList& contacts, std::size_t contact)
{
  const Vec2& f = contacts.force[contact];
  const Vec2 n = contacts.branch[contact].normalized();
  return {n, f.dot(n), f.y() * n.x() - f.x() * n.y()};
}

MicroStructure::MicroStructure(const Layers& layers, GrainArea area, double friction)
    : layers_(layers), composition_(layers, area), friction_(friction)
{
}

void MicroStructure::add(const Grains& grains, const Frame& frame)
{
  ++frames_;
  composition_.add(grains, frame);
  sums_.resize(composition_.layers());
  add_grains(grains, frame);
  add_contacts(grains, frame);
}

void MicroStructure::merge(const MicroStructure& others)
{
  frames_ += others.frames_;
  composition_.merge(others.composition_);
  accumulate(sums_, others.sums_);
  heights_.large += others.heights_.large;
  heights_.small += others.heights_.small;
  heights_.bed += others.heights_.bed;
}

void MicroStructure::add_grains(const Grains& grains, const Frame& frame)
{
  std::array<double, 2> mass{}, moment{};
  double area = 0, area_moment = 0;
  for (std::size_t g = 0; g < grains.size(); ++g) {
    if (!is_mobile(grains, g)) continue;
    const auto species = static_cast<std::size_t>(grains.species[g]);
    const double y = frame.position[g].y(), square = grains.radius[g] * grains.radius[g];
    ++sums_[layers_.at(y)].species[species].grains;
    mass[species] += grains.mass[g];
    moment[species] += grains.mass[g] * y;
    area += square;
    area_moment += square * y;
  }
  heights_.small += moment[0] / mass[0];
  heights_.large += moment[1] / mass[1];
  heights_.bed += 2 * area_moment / area;
}

void MicroStructure::add_ends(const Grains& grains, const Frame& frame, std::size_t contact,
                              PairType type)
{
  const auto add_end = [&](std::int32_t grain) {
    const auto g = static_cast<std::size_t>(grain);
    auto& sums = sums_[layers_.at(frame.position[g].y())]
                     .species[static_cast<std::size_t>(grains.species[g])];
    ++sums.ends;
    if (type == PairType::LS) ++sums.mixed_ends;
    if (is_base(type)) ++sums.base_ends;
  };
  add_end(frame.contacts.i[contact]);
  if (!is_base(type)) add_end(frame.contacts.j[contact]);
}

double MicroStructure::slides(double f_n, double f_t) const
{
  if (std::isnan(friction_)) return nan;
  return f_n > 0 && std::abs(f_t) >= (1 - sliding_tolerance) * friction_ * f_n ? 1 : 0;
}

void MicroStructure::add_contacts(const Grains& grains, const Frame& frame)
{
  const auto& list = frame.contacts;
  std::vector<LayerForce> forces(sums_.size());
  std::vector<Booked> booked;
  booked.reserve(list.size());
  for (std::size_t k = 0; k < list.size(); ++k) {
    const Vec2& force = list.force[k];
    if (force.x() == 0 && force.y() == 0) continue;
    const auto type = pair_type(grains, frame, k);
    const double y = contact_point(grains, frame, k).y();
    const std::size_t layer = std::min(layers_.at(y), sums_.size() - 1);
    const auto [n, f_n, f_t] = force_parts(list, k);
    const Tensor2 stress = force * list.branch[k].transpose();

    auto& pair = sums_[layer].pair[at(type)];
    ++pair.contacts;
    pair.force += force.norm();
    pair.normal += f_n;
    if (f_n > 0) pair.mobilised += std::abs(f_t) / f_n;
    pair.sliding += slides(f_n, f_t);
    pair.fabric.add(n, f_n, f_t);
    pair.stress += (is_base(type) ? share_of_first(grains, list, k) : 1) * stress;
    if (is_base(type)) {
      sums_[layer].base_force += force;
    } else {
      ++forces[layer].contacts;
      forces[layer].normal += f_n;
      booked.push_back({layer, type, f_n});
    }
    if (type == PairType::LS) sums_[layer].mixed_size += share_by_size(grains, list, k) * stress;
    add_ends(grains, frame, k, type);
  }
  for (const auto& [layer, type, f_n] : booked)
    if (f_n * forces[layer].contacts > forces[layer].normal) ++sums_[layer].pair[at(type)].strong;
}

MicroSums MicroStructure::mean(std::size_t layer) const
{
  MicroSums mean = sums_[layer] / static_cast<double>(frames_);
  const auto areas = composition_.mean(layer);
  mean.species[0].area = areas.small;
  mean.species[1].area = areas.large;
  return mean;
}

MicroSums MicroStructure::mean() const
{
  MicroSums all;
  for (std::size_t layer = 0; layer < layers(); ++layer) all += mean(layer);
  return all;
}

BedHeights MicroStructure::heights() const
{
  const auto frames = static_cast<double>(frames_);
  return {heights_.large / frames, heights_.small / frames, heights_.bed / frames};
}

std::vector<std::string> MicroStructure::columns()
{
  auto names = MicroSums::columns();
  names.insert(names.end(), {"yL[m]", "yS[m]", "height[m]"});
  return names;
}

std::vector<double> MicroStructure::row(std::size_t layer) const
{
  auto row = mean(layer).numbers();
  row.insert(row.end(), {nan, nan, nan});
  return row;
}

std::vector<double> MicroStructure::bed_row() const
{
  const auto heights = this->heights();
  auto row = mean().numbers();
  row.insert(row.end(), {heights.large, heights.small, heights.bed});
  return row;
}

}  // namespace grseg
