// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/micro/structure_sums.hpp"

#include "analysis/frames/sums.hpp"

#include <fmt/format.h>

namespace grseg {
namespace {

constexpr std::array<const char*, 2> species_names{"S", "L"};
// As in the table of grseg-stress.
constexpr std::array<const char*, pair_types> stress_names{"A_SS", "M", "A_LL", "A_Sb", "A_Lb"};

/// The name of a column: stem, in which whose name replaces {}, component and unit.
struct ColumnName {
  const char* stem;
  const char* component = "";
  const char* unit = "";
};

constexpr std::array<const char*, 3> vector_components{"x", "y", "z"};

/// Calls use(name, whose, number) with all components of a tensor.
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

/// All sums in the order of the table: use(name, whose, number). A new sum is added here and as a
/// member; writing and reading follow.
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

}  // namespace grseg
