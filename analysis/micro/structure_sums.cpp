// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/micro/structure_sums.hpp"

#include "analysis/frames/contacts.hpp"

#include <fmt/format.h>

#include <cmath>

namespace grseg {
namespace {

constexpr std::array<const char*, 2> species_names{"S", "L"};
// Names of stress sums by pair type, as in tables of grseg-stress.
constexpr std::array<const char*, pair_types> stress_names{"A_SS", "M", "A_LL", "A_Sb", "A_Lb"};

/// A column's name: a stem, in which a species or pair type replaces {}, a component, and a unit.
struct ColumnName {
  const char* stem;
  const char* component = "";
  const char* unit = "";
};

constexpr std::array<const char*, 3> vector_components{"x", "y", "z"};

/// Calls use(name, whose, number) for each component of a tensor; `whose` replaces {} in the name.
template <class Tensor, class Use>
void visit_tensor(Tensor& t, const char* stem, const char* unit, const char* whose, const Use& use)
{
  for (const auto& [suffix, row, column] : tensor_components(static_cast<int>(t.rows())))
    use({stem, suffix.c_str(), unit}, whose, t(row, column));
}

template <class Fabric, class Use>
void visit_fabric(Fabric& fabric, const char* whose, const Use& use)
{
  if constexpr (Fabric::dimension == 2) {
    const auto visit_moment = [&](auto& moment, const ColumnName& c2, const ColumnName& s2) {
      use(c2, whose, moment.x());
      use(s2, whose, moment.y());
    };
    visit_moment(fabric.normal, {"c2_{}"}, {"s2_{}"});
    visit_moment(fabric.normal_force, {"fn_c2_{}", "", "[N]"}, {"fn_s2_{}", "", "[N]"});
    visit_moment(fabric.tangential_force, {"ft_c2_{}", "", "[N]"}, {"ft_s2_{}", "", "[N]"});
  } else {
    visit_tensor(fabric.normal, "nn_{}", "", whose, use);
    visit_tensor(fabric.normal_force, "fn_nn_{}", "[N]", whose, use);
    visit_tensor(fabric.tangential_force, "ft_n_{}", "[N]", whose, use);
  }
}

template <class Sums, class Use>
void visit_pair(Sums& sums, const char* whose, const char* stress, const Use& use)
{
  use({"n_{}"}, whose, sums.contacts);
  use({"sum_f_{}", "", "[N]"}, whose, sums.force);
  use({"sum_fn_{}", "", "[N]"}, whose, sums.normal);
  use({"sum_ft/fn_{}"}, whose, sums.mobilised);
  use({"n_slide_{}"}, whose, sums.sliding);
  use({"n_strong_{}"}, whose, sums.strong);
  visit_fabric(sums.fabric, whose, use);
  visit_tensor(sums.stress, "{}", "[N m]", stress, use);
}

/// Calls use(name, whose, number) for each sum, in the order of the table. A new sum needs a member
/// and a line here; code that writes and reads tables uses this function.
template <class Sums, class Use>
void visit(Sums& sums, const Use& use)
{
  constexpr bool spheres = Sums::dimension == 3;
  const auto each_species = [&](const ColumnName& name, double SpeciesSums::*number) {
    for (std::size_t s = 0; s < 2; ++s) use(name, species_names[s], sums.species[s].*number);
  };
  each_species(spheres ? ColumnName{"volume_{}", "", "[m^3]"} : ColumnName{"area_{}", "", "[m^2]"},
               &SpeciesSums::content);
  each_species({"grains_{}"}, &SpeciesSums::grains);
  each_species({"ends_{}"}, &SpeciesSums::ends);
  each_species({"ends_{}_mixed"}, &SpeciesSums::mixed_ends);
  each_species({"ends_{}_base"}, &SpeciesSums::base_ends);
  for (std::size_t type = 0; type < pair_types; ++type)
    visit_pair(sums.pair[type], pair_type_names[type], stress_names[type], use);
  visit_tensor(sums.mixed_size, "{}", "[N m]", "Msize", use);
  for (std::size_t axis = 0; axis < Sums::dimension; ++axis)
    use({"base_f{}", "", "[N]"}, vector_components[axis],
        sums.base_force[static_cast<Eigen::Index>(axis)]);
}

}  // namespace

template <int D>
PairSums<D> StructureSums<D>::between_grains() const
{
  PairSums<D> all = of(PairType::SS);
  all += of(PairType::LS);
  all += of(PairType::LL);
  return all;
}

template <int D>
double StructureSums<D>::phi_large() const
{
  return ratio(species[1].content, species[0].content + species[1].content);
}

template <int D>
double StructureSums<D>::coordination(Species s) const
{
  return ratio(of(s).ends, of(s).grains);
}

template <int D>
double StructureSums<D>::mean_force(Species s, const ForceMeasure& measure) const
{
  const bool large = s == Species::large;
  const auto& own = of(large ? PairType::LL : PairType::SS);
  const auto& mixed = of(PairType::LS);
  const auto& base = of(large ? PairType::Lb : PairType::Sb);
  const double twice = measure.average == ForceAverage::ends ? 2 : 1;
  const auto force =
      measure.force == ContactForce::normal ? &PairSums<D>::normal : &PairSums<D>::force;
  return ratio(twice * own.*force + mixed.*force + base.*force,
               twice * own.contacts + mixed.contacts + base.contacts);
}

template <int D>
double StructureSums<D>::mixed_share() const
{
  return ratio(of(PairType::LS).contacts, between_grains().contacts);
}

template <int D>
PartialStress<D> StructureSums<D>::stress(const PartitionRule& rule) const
{
  ContactSums<D> sums;
  sums.content = {species[0].content, species[1].content};
  sums.of(OwnSum::inside, 0) = of(PairType::SS).stress;
  sums.of(OwnSum::inside, 1) = of(PairType::LL).stress;
  sums.of(PairSum::whole, 0) = of(PairType::LS).stress;
  sums.of(PairSum::by_size, 0) = mixed_size;
  sums.of(OwnSum::base, 0) = of(PairType::Sb).stress;
  sums.of(OwnSum::base, 1) = of(PairType::Lb).stress;
  return partial_stress(sums, rule, BasePart::contact_point, StressVolume::solid);
}

template <int D>
std::vector<Cell> StructureSums<D>::cells() const
{
  std::vector<Cell> cells;
  visit(*this, [&](const ColumnName& name, const char* whose, double number) {
    cells.push_back(
        {fmt::format(fmt::runtime(name.stem), whose) + name.component + name.unit, number});
  });
  return cells;
}

template <int D>
StructureSums<D> StructureSums<D>::from_values(const std::vector<double>& values)
{
  StructureSums<D> sums;
  auto next = values.begin();
  visit(sums, [&](const ColumnName&, const char*, double& number) { number = *next++; });
  return sums;
}

template struct StructureSums<2>;
template struct StructureSums<3>;

namespace {

std::size_t at(PairType type)
{
  return static_cast<std::size_t>(type);
}

bool is_base(PairType type)
{
  return type == PairType::Sb || type == PairType::Lb;
}

/// The large grain's share of a mixed contact under the rule `size`, r_L/(r_L + r_S).
template <int D>
double share_by_size(const Grains& grains, const ContactList<D>& list, std::size_t contact)
{
  const auto i = static_cast<std::size_t>(list.i[contact]);
  const auto j = static_cast<std::size_t>(list.j[contact]);
  const double r_large = grains.radius[grains.species[i] == Species::large ? i : j];
  return r_large / (grains.radius[i] + grains.radius[j]);
}

/// Number and sum of f_n (N) of the contacts between mobile grains of one layer in one frame.
struct LayerForce {
  double contacts = 0, normal = 0;
};

/// Tangential part of a force for FabricSums::add(): f_t, or in three dimensions a vector, N.
template <int D>
typename FabricSums<D>::Tangential tangential_part(const Vector<D>& force,
                                                   const ForceParts<D>& parts)
{
  if constexpr (D == 2)
    return parts.f_t;
  else
    return force - parts.f_n * parts.n;
}

/// A contact between mobile grains: its layer, pair type and normal force (N).
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
  const std::size_t count = layers_.count(grains, frame);
  std::vector<LayerForce> forces(sums_.size());
  std::vector<Located> between_grains;
  between_grains.reserve(list.size());
  for (std::size_t k = 0; k < list.size(); ++k) {
    if (!bears_force(list, k)) continue;
    const Vector<D>& force = list.force[k];
    const auto type = pair_type(grains, frame, k);
    const std::size_t layer = layer_of_contact(layers_, grains, frame, k, count);
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
