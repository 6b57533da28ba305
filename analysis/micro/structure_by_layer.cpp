// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/micro/structure_by_layer.hpp"

#include "analysis/frames/accumulate.hpp"
#include "analysis/frames/contact_force.hpp"

#include <cmath>
#include <utility>

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

/// The large grain's share of a mixed contact by size, r_L/(r_L + r_S).
double share_by_size(const Grains& grains, const ContactList<2>& list, std::size_t contact)
{
  const auto i = static_cast<std::size_t>(list.i[contact]);
  const auto j = static_cast<std::size_t>(list.j[contact]);
  const double r_large = grains.radius[grains.species[i] == Species::large ? i : j];
  return r_large / (grains.radius[i] + grains.radius[j]);
}

/// The contacts between mobile grains of one layer in one frame.
struct LayerForce {
  double contacts = 0, normal = 0;
};

std::vector<Cell> cells(const StructureSums& sums, const BedHeights& heights)
{
  auto cells = sums.cells();
  for (auto& cell : grseg::cells(heights)) cells.push_back(std::move(cell));
  return cells;
}

/// A contact between mobile grains and the layer it belongs to.
struct Located {
  std::size_t layer;
  PairType type;
  double f_n;
};

}  // namespace

StructureByLayer::StructureByLayer(const Layers& layers, GrainArea area, double friction)
    : layers_(layers), composition_(layers, area), friction_(friction)
{
}

void StructureByLayer::add(const Grains& grains, const Frame<2>& frame)
{
  ++frames_;
  composition_.add(grains, frame);
  sums_.resize(composition_.layers());
  add_grains(grains, frame);
  add_contacts(grains, frame);
}

void StructureByLayer::merge(const StructureByLayer& others)
{
  frames_ += others.frames_;
  composition_.merge(others.composition_);
  accumulate(sums_, others.sums_);
  heights_.large += others.heights_.large;
  heights_.small += others.heights_.small;
  heights_.bed += others.heights_.bed;
}

void StructureByLayer::add_grains(const Grains& grains, const Frame<2>& frame)
{
  for (std::size_t g = 0; g < grains.size(); ++g)
    if (is_mobile(grains, g))
      ++sums_[layers_.at(frame.position[g].y())]
            .species[static_cast<std::size_t>(grains.species[g])]
            .grains;
  const auto now = bed_heights(grains, frame);
  heights_.small += now.small;
  heights_.large += now.large;
  heights_.bed += now.bed;
}

void StructureByLayer::add_ends(const Grains& grains, const Frame<2>& frame, std::size_t contact,
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

double StructureByLayer::slides(double f_n, double f_t) const
{
  if (std::isnan(friction_)) return nan;
  return f_n > 0 && std::abs(f_t) >= (1 - sliding_tolerance) * friction_ * f_n ? 1 : 0;
}

void StructureByLayer::add_contacts(const Grains& grains, const Frame<2>& frame)
{
  const auto& list = frame.contacts;
  std::vector<LayerForce> forces(sums_.size());
  std::vector<Located> between_grains;
  between_grains.reserve(list.size());
  for (std::size_t k = 0; k < list.size(); ++k) {
    if (!bears_force(list, k)) continue;
    const Vec2& force = list.force[k];
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
      between_grains.push_back({layer, type, f_n});
    }
    if (type == PairType::LS) sums_[layer].mixed_size += share_by_size(grains, list, k) * stress;
    add_ends(grains, frame, k, type);
  }
  for (const auto& [layer, type, f_n] : between_grains)
    if (f_n * forces[layer].contacts > forces[layer].normal) ++sums_[layer].pair[at(type)].strong;
}

StructureSums StructureByLayer::mean(std::size_t layer) const
{
  StructureSums mean = sums_[layer] / static_cast<double>(frames_);
  const auto areas = composition_.mean(layer);
  mean.species[0].area = areas[0];
  mean.species[1].area = areas[1];
  return mean;
}

StructureSums StructureByLayer::mean() const
{
  StructureSums all;
  for (std::size_t layer = 0; layer < layers(); ++layer) all += mean(layer);
  return all;
}

BedHeights StructureByLayer::heights() const
{
  const auto frames = static_cast<double>(frames_);
  return {heights_.large / frames, heights_.small / frames, heights_.bed / frames};
}

std::vector<std::string> StructureByLayer::columns()
{
  return columns_of(cells({}, {}));
}

std::vector<double> StructureByLayer::row(std::size_t layer) const
{
  return values_of(cells(mean(layer), {}));
}

std::vector<double> StructureByLayer::bed_row() const
{
  return values_of(cells(mean(), heights()));
}

}  // namespace grseg
