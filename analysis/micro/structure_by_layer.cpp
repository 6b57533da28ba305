// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/micro/structure_by_layer.hpp"

#include "analysis/frames/contacts.hpp"
#include "analysis/frames/sums.hpp"

#include <cmath>
#include <utility>

namespace grseg {
namespace {

std::size_t at(PairType type)
{
  return static_cast<std::size_t>(type);
}

bool is_base(PairType type)
{
  return type == PairType::Sb || type == PairType::Lb;
}

/// The large grain's share of a mixed contact by size, r_L/(r_L + r_S).
template <int D>
double share_by_size(const Grains& grains, const ContactList<D>& list, std::size_t contact)
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

/// What FabricSums adds.
template <int D>
typename FabricSums<D>::Tangential tangential_part(const Vector<D>& force,
                                                   const ForceParts<D>& parts)
{
  if constexpr (D == 2)
    return parts.f_t;
  else
    return force - parts.f_n * parts.n;
}

/// A contact between mobile grains and the layer it belongs to.
struct Located {
  std::size_t layer;
  PairType type;
  double f_n;
};

}  // namespace

template <int D>
StructureByLayer<D>::StructureByLayer(const Layers& layers, GrainArea area, double friction)
    : layers_(layers), composition_(layers, area), friction_(friction)
{
}

template <int D>
void StructureByLayer<D>::add(const Grains& grains, const Frame<D>& frame)
{
  ++frames_;
  composition_.add(grains, frame);
  sums_.resize(composition_.layers());
  add_grains(grains, frame);
  add_contacts(grains, frame);
}

template <int D>
void StructureByLayer<D>::merge(const StructureByLayer& others)
{
  frames_ += others.frames_;
  composition_.merge(others.composition_);
  accumulate(sums_, others.sums_);
  heights_ += others.heights_;
}

template <int D>
void StructureByLayer<D>::add_grains(const Grains& grains, const Frame<D>& frame)
{
  for (std::size_t g = 0; g < grains.size(); ++g)
    if (is_mobile(grains, frame, g))
      ++sums_[holding(frame.position[g])]
            .species[static_cast<std::size_t>(grains.species[g])]
            .grains;
  heights_ += bed_heights(grains, frame);
}

template <int D>
void StructureByLayer<D>::add_ends(const Grains& grains, const Frame<D>& frame, std::size_t contact,
                                   PairType type)
{
  const auto add_end = [&](std::int32_t grain) {
    const auto g = static_cast<std::size_t>(grain);
    auto& sums =
        sums_[holding(frame.position[g])].species[static_cast<std::size_t>(grains.species[g])];
    ++sums.ends;
    if (type == PairType::LS) ++sums.mixed_ends;
    if (is_base(type)) ++sums.base_ends;
  };
  add_end(frame.contacts.i[contact]);
  if (!is_base(type)) add_end(frame.contacts.j[contact]);
}

template <int D>
double StructureByLayer<D>::slides(double f_n, double f_t) const
{
  if (std::isnan(friction_)) return no_number;
  return f_n > 0 && std::abs(f_t) >= (1 - sliding_tolerance) * friction_ * f_n ? 1 : 0;
}

template <int D>
void StructureByLayer<D>::add_contacts(const Grains& grains, const Frame<D>& frame)
{
  const auto& list = frame.contacts;
  std::vector<LayerForce> forces(sums_.size());
  std::vector<Located> between_grains;
  between_grains.reserve(list.size());
  for (std::size_t k = 0; k < list.size(); ++k) {
    if (!bears_force(list, k)) continue;
    const Vector<D>& force = list.force[k];
    const auto type = pair_type(grains, frame, k);
    const std::size_t layer = std::min(holding(contact_point(grains, frame, k)), sums_.size() - 1);
    const auto [n, f_n, f_t] = force_parts(list, k);
    const Tensor<D> stress = force * list.branch[k].transpose();

    auto& pair = sums_[layer].pair[at(type)];
    ++pair.contacts;
    pair.force += force.norm();
    pair.normal += f_n;
    if (f_n > 0) pair.mobilised += std::abs(f_t) / f_n;
    pair.sliding += slides(f_n, f_t);
    pair.fabric.add(n, f_n, tangential_part<D>(force, {n, f_n, f_t}));
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

template <int D>
StructureSums<D> StructureByLayer<D>::mean(std::size_t layer) const
{
  StructureSums<D> mean = sums_[layer] / static_cast<double>(frames_);
  const auto contents = composition_.mean(layer);
  mean.species[0].content = contents[0];
  mean.species[1].content = contents[1];
  return mean;
}

template <int D>
StructureSums<D> StructureByLayer<D>::mean() const
{
  StructureSums<D> all;
  for (std::size_t layer = 0; layer < layers(); ++layer) all += mean(layer);
  return all;
}

template <int D>
std::vector<Cell> map_cells(const StructureSums<D>& sums)
{
  auto cells = sums.cells();
  const auto between = sums.between_grains();
  const auto &small = sums.of(Species::small), &large = sums.of(Species::large);
  cells.insert(cells.end(), {{"z", ratio(small.ends + large.ends, small.grains + large.grains)},
                             {"z_S", sums.coordination(Species::small)},
                             {"z_L", sums.coordination(Species::large)},
                             {"f_n[N]", ratio(between.normal, between.contacts)},
                             {"sliding", ratio(between.sliding, between.contacts)},
                             {"mixed_share", sums.mixed_share()}});
  return cells;
}

template std::vector<Cell> map_cells(const StructureSums<2>&);
template std::vector<Cell> map_cells(const StructureSums<3>&);
template class StructureByLayer<2>;
template class StructureByLayer<3>;

}  // namespace grseg
