// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/micro/structure_sums.hpp"

#include "analysis/frames/ratio.hpp"

#include <fmt/format.h>

namespace grseg {
namespace {

constexpr std::array<const char*, 2> species_names{"S", "L"};
// As in the table of grseg-stress.
constexpr std::array<const char*, pair_types> stress_names{"A_SS", "M", "A_LL", "A_Sb", "A_Lb"};

/// Calls use(name, whose, number) with both components of a vector; `whose` replaces the {} of a
/// name.
template <class Vector, class Use>
void visit_vector(Vector& v, const char* x, const char* y, const char* whose, const Use& use)
{
  use(x, whose, v.x());
  use(y, whose, v.y());
}

template <class Tensor, class Use>
void visit_tensor(Tensor& t, const char* whose, const Use& use)
{
  use("{}_xx[N m]", whose, t(0, 0));
  use("{}_xy[N m]", whose, t(0, 1));
  use("{}_yx[N m]", whose, t(1, 0));
  use("{}_yy[N m]", whose, t(1, 1));
}

template <class Sums, class Use>
void visit_pair(Sums& sums, const char* whose, const char* stress, const Use& use)
{
  use("n_{}", whose, sums.contacts);
  use("sum_f_{}[N]", whose, sums.force);
  use("sum_fn_{}[N]", whose, sums.normal);
  use("sum_ft/fn_{}", whose, sums.mobilised);
  use("n_slide_{}", whose, sums.sliding);
  use("n_strong_{}", whose, sums.strong);
  visit_vector(sums.fabric.normal, "c2_{}", "s2_{}", whose, use);
  visit_vector(sums.fabric.normal_force, "fn_c2_{}[N]", "fn_s2_{}[N]", whose, use);
  visit_vector(sums.fabric.tangential_force, "ft_c2_{}[N]", "ft_s2_{}[N]", whose, use);
  visit_tensor(sums.stress, stress, use);
}

/// The one list of all sums, in the order of the table: use(name, whose, number). A new sum is
/// added here and as a member; table, reading, merging and scaling follow.
template <class Sums, class Use>
void visit(Sums& sums, const Use& use)
{
  const auto each_species = [&](const char* name, double SpeciesSums::*number) {
    for (std::size_t s = 0; s < 2; ++s) use(name, species_names[s], sums.species[s].*number);
  };
  each_species("area_{}[m^2]", &SpeciesSums::area);
  each_species("grains_{}", &SpeciesSums::grains);
  each_species("ends_{}", &SpeciesSums::ends);
  each_species("ends_{}_mixed", &SpeciesSums::mixed_ends);
  each_species("ends_{}_base", &SpeciesSums::base_ends);
  for (std::size_t type = 0; type < pair_types; ++type)
    visit_pair(sums.pair[type], pair_type_names[type], stress_names[type], use);
  visit_tensor(sums.mixed_size, "Msize", use);
  visit_vector(sums.base_force, "base_fx[N]", "base_fy[N]", "", use);
}

template <class Change>
StructureSums changed(StructureSums sums, const Change& change)
{
  visit(sums, [&](const char*, const char*, double& number) { number = change(number); });
  return sums;
}

/// Adds every number that `visit_all` visits.
template <class Sums, class Visit>
void add(Sums& sums, const Sums& others, const Visit& visit_all)
{
  std::vector<double> values;
  visit_all(others, [&](const char*, const char*, double number) { values.push_back(number); });
  auto value = values.begin();
  visit_all(sums, [&](const char*, const char*, double& number) { number += *value++; });
}

}  // namespace

PairSums& PairSums::operator+=(const PairSums& others)
{
  add(*this, others, [](auto& sums, const auto& use) { visit_pair(sums, "", "", use); });
  return *this;
}

StructureSums& StructureSums::operator+=(const StructureSums& others)
{
  add(*this, others, [](auto& sums, const auto& use) { visit(sums, use); });
  return *this;
}

StructureSums StructureSums::operator*(double factor) const
{
  return changed(*this, [factor](double number) { return number * factor; });
}

StructureSums StructureSums::operator/(double divisor) const
{
  return changed(*this, [divisor](double number) { return number / divisor; });
}

PairSums StructureSums::between_grains() const
{
  PairSums all = of(PairType::SS);
  all += of(PairType::LS);
  all += of(PairType::LL);
  return all;
}

double StructureSums::phi_large() const
{
  return ratio(species[1].area, species[0].area + species[1].area);
}

double StructureSums::coordination(Species s) const
{
  return ratio(of(s).ends, of(s).grains);
}

double StructureSums::mean_force(Species s, const ForceMeasure& measure) const
{
  const bool large = s == Species::large;
  const auto& own = of(large ? PairType::LL : PairType::SS);
  const auto& mixed = of(PairType::LS);
  const auto& base = of(large ? PairType::Lb : PairType::Sb);
  const double twice = measure.average == ForceAverage::ends ? 2 : 1;
  const auto force = measure.force == ContactForce::normal ? &PairSums::normal : &PairSums::force;
  return ratio(twice * own.*force + mixed.*force + base.*force,
               twice * own.contacts + mixed.contacts + base.contacts);
}

double StructureSums::mixed_share() const
{
  return ratio(of(PairType::LS).contacts, between_grains().contacts);
}

PartialStress<2> StructureSums::stress(const PartitionRule& rule) const
{
  ContactSums<2> sums;
  sums.content = {species[0].area, species[1].area};
  sums.of(OwnSum::inside, 0) = of(PairType::SS).stress;
  sums.of(OwnSum::inside, 1) = of(PairType::LL).stress;
  sums.of(PairSum::whole, 0) = of(PairType::LS).stress;
  sums.of(PairSum::by_size, 0) = mixed_size;
  sums.of(OwnSum::base, 0) = of(PairType::Sb).stress;
  sums.of(OwnSum::base, 1) = of(PairType::Lb).stress;
  return partial_stress(sums, rule, BasePart::contact_point, StressVolume::solid);
}

std::vector<Cell> StructureSums::cells() const
{
  std::vector<Cell> cells;
  visit(*this, [&](const char* name, const char* whose, double number) {
    cells.push_back({fmt::format(fmt::runtime(name), whose), number});
  });
  return cells;
}

StructureSums StructureSums::from_values(const std::vector<double>& values)
{
  StructureSums sums;
  auto next = values.begin();
  visit(sums, [&](const char*, const char*, double& number) { number = *next++; });
  return sums;
}

}  // namespace grseg
