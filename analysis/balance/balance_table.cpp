// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/balance/balance_table.hpp"

#include "analysis/balance/driving_forces.hpp"
#include "analysis/frames/sums.hpp"
#include "analysis/stress/contact_sums.hpp"

#include <fmt/format.h>

#include <array>
#include <utility>

namespace grseg {
namespace {

struct Units {
  const char *density, *momentum, *stress, *force;
};
template <int D>
constexpr Units units = D == 2 ? Units{"[kg/m^2]", "[kg/(m s)]", "[N/m]", "[N/m^2]"}
                               : Units{"[kg/m^3]", "[kg/(m^2 s)]", "[Pa]", "[N/m^3]"};
constexpr std::array<char, 3> axes{'x', 'y', 'z'};

/// One species in one layer.
template <int D>
struct SpeciesPart {
  std::string name;  // S, L, or a species' own
  SpeciesMomentum<D> momentum;
  Vector<D> change = Vector<D>::Zero();          // N/m^2 or N/m^3
  Tensor<D> kinetic_stress = Tensor<D>::Zero();  // N/m or Pa
};

/// About a mean velocity, m/s.
template <int D>
Tensor<D> kinetic_stress(const SpeciesMomentum<D>& of, const Vector<D>& mean)
{
  const Tensor<D> carried = of.momentum * mean.transpose();
  return of.momentum_flux - carried - carried.transpose() + of.density * mean * mean.transpose();
}

template <int D>
void add_species(std::vector<Cell>& cells, const SpeciesPart<D>& part)
{
  const auto& of = part.momentum;
  constexpr Units unit = units<D>;
  const auto& name = part.name;
  const auto component = [](const auto& row, const auto& column) {
    return fmt::format("{}{}", axes[static_cast<std::size_t>(row)],
                       axes[static_cast<std::size_t>(column)]);
  };
  cells.push_back({fmt::format("rho_{}{}", name, unit.density), of.density});
  for (Eigen::Index a = 0; a < D; ++a)
    cells.push_back(
        {fmt::format("j{}_{}{}", axes[static_cast<std::size_t>(a)], name, unit.momentum),
         of.momentum[a]});
  for (Eigen::Index a = 0; a < D; ++a)
    for (Eigen::Index b = 0; b < D; ++b)
      cells.push_back(
          {fmt::format("Sc_{}_{}{}", name, component(a, b), unit.stress), of.contact_stress(a, b)});
  for (Eigen::Index a = 0; a < D; ++a)
    for (Eigen::Index b = a; b < D; ++b)
      cells.push_back({fmt::format("Sk_{}_{}{}", name, component(a, b), unit.stress),
                       part.kinetic_stress(a, b)});
  const auto add_force = [&](const char* term, const Vector<D>& value) {
    for (Eigen::Index a = 0; a < D; ++a)
      cells.push_back(
          {fmt::format("{}_{}_{}{}", term, name, axes[static_cast<std::size_t>(a)], unit.force),
           value[a]});
  };
  add_force("rate", of.rate);
  add_force("gravity", of.gravity);
  add_force("contact", of.contact);
  add_force("kinetic", of.kinetic);
  add_force("interaction", of.interaction);
  add_force("base", of.base);
  add_force("force", of.force);
  add_force("residual", of.residual());
  add_force("change", part.change);
}

void add_forces(std::vector<Cell>& cells, const DrivingForces& forces,
                const Units& units_of_columns)
{
  const std::string unit = units_of_columns.force;
  cells.insert(cells.end(), {{"phi_L", forces.phi},
                             {"psi_L", forces.psi},
                             {"psik_L", forces.psi_kinetic},
                             {"B", forces.b},
                             {"B_kappa", forces.b_kinetic},
                             {"push" + unit, forces.push},
                             {"push_kinetic" + unit, forces.push_kinetic},
                             {"spread" + unit, forces.spread},
                             {"spread_kinetic" + unit, forces.spread_kinetic},
                             {"drag" + unit, forces.drag},
                             {"scatter" + unit, forces.scatter},
                             {fmt::format("drift{}", units_of_columns.momentum), forces.drift},
                             {"drag_rate[1/s]", forces.drag_rate()}});
}

template <int D>
std::vector<Cell> cells_of(const std::vector<SpeciesPart<D>>& parts, const DrivingForces& forces)
{
  std::vector<Cell> cells;
  for (const auto& part : parts) add_species(cells, part);
  if (parts.size() == 2) add_forces(cells, forces, units<D>);
  return cells;
}

/// "contact_L_y@half[N/m^2]" and the others of this vector.
template <int D>
void add_vector(std::vector<Cell>& cells, const std::string& name, const std::string& rule,
                const Vector<D>& value)
{
  for (Eigen::Index a = 0; a < D; ++a)
    cells.push_back({fmt::format("{}_{}{}{}", name, axes[static_cast<std::size_t>(a)],
                                 rule.empty() ? "" : "@" + rule, units<D>.force),
                     value[a]});
}

/// What one rule makes of one layer, of all species and, of two, of the forces that drive them.
template <int D>
struct RulePart {
  std::string rule;
  std::vector<PartitionedForces<D>> of_species;
  RuleForces forces{};
};

template <int D>
void add_rule(std::vector<Cell>& cells, const std::vector<std::string>& words,
              const RulePart<D>& part)
{
  for (std::size_t k = 0; k < words.size(); ++k) {
    add_vector<D>(cells, "contact_" + words[k], part.rule, part.of_species[k].contact);
    add_vector<D>(cells, "interaction_" + words[k], part.rule, part.of_species[k].interaction);
  }
  if (words.size() != 2) return;
  const auto add = [&](const char* name, const char* unit, double value) {
    cells.push_back({fmt::format("{}@{}{}", name, part.rule, unit), value});
  };
  add("psi_L", "", part.forces.psi);
  add("B", "", part.forces.b);
  add("push", units<D>.force, part.forces.push);
  add("spread", units<D>.force, part.forces.spread);
  add("drag", units<D>.force, part.forces.drag);
}

}  // namespace

template <int D>
std::vector<std::string> partition_columns(const SpeciesList& species,
                                           const std::vector<PartitionRule>& rules)
{
  const auto words = column_words(species);
  std::vector<Cell> cells;
  for (const auto& rule : rules)
    add_rule<D>(cells, words,
                {rule.name(), std::vector<PartitionedForces<D>>(words.size()), RuleForces{}});
  for (const auto& word : words) add_vector<D>(cells, "N_" + word, "", Vector<D>::Zero());
  if (words.size() == 2) cells.push_back({"p_zero", 0});
  return columns_of(cells);
}

template <int D>
std::vector<double> partition_row(const MomentumBalance<D>& balance,
                                  const PartitionedBalance<D>& contacts, std::size_t layer)
{
  const std::vector<std::string> words(contacts.species());
  const bool two = words.size() == 2;
  const auto forces = two ? driving_forces(balance, layer) : DrivingForces{};
  std::vector<Cell> cells;
  for (std::size_t rule = 0; rule < contacts.rules().size(); ++rule) {
    RulePart<D> part{"", {}, two ? rule_forces(forces, contacts, layer, rule) : RuleForces{}};
    for (std::size_t k = 0; k < words.size(); ++k)
      part.of_species.push_back(contacts.mean(layer, static_cast<Species>(k), rule));
    add_rule(cells, words, part);
  }
  for (std::size_t k = 0; k < words.size(); ++k)
    add_vector<D>(cells, "N", "", contacts.contact_force(layer, static_cast<Species>(k)));
  if (two) cells.push_back({"p_zero", push_over_share(forces, contacts, layer).zero()});
  return values_of(cells);
}

template <int D>
std::vector<std::string> balance_columns(const SpeciesList& species)
{
  std::vector<SpeciesPart<D>> parts;
  for (auto& word : column_words(species)) parts.push_back({std::move(word), {}});
  return columns_of(cells_of(parts, {}));
}

template <int D>
std::vector<double> balance_row(const MomentumBalance<D>& balance, std::size_t layer)
{
  std::vector<SpeciesPart<D>> parts;
  Vector<D> momentum = Vector<D>::Zero();
  double density = 0;
  for (std::size_t k = 0; k < balance.species(); ++k) {
    const auto species = static_cast<Species>(k);
    parts.push_back({"", balance.mean(layer, species), balance.change(layer, species)});
    momentum += parts.back().momentum.momentum;
    density += parts.back().momentum.density;
  }
  const Vector<D> mean = momentum / density;
  for (auto& part : parts) part.kinetic_stress = kinetic_stress<D>(part.momentum, mean);
  const bool two = parts.size() == 2;
  return values_of(cells_of(parts, two ? driving_forces(balance, layer) : DrivingForces{}));
}

template std::vector<std::string> partition_columns<2>(const SpeciesList&,
                                                       const std::vector<PartitionRule>&);
template std::vector<std::string> partition_columns<3>(const SpeciesList&,
                                                       const std::vector<PartitionRule>&);
template std::vector<double> partition_row(const MomentumBalance<2>&, const PartitionedBalance<2>&,
                                           std::size_t);
template std::vector<double> partition_row(const MomentumBalance<3>&, const PartitionedBalance<3>&,
                                           std::size_t);
template std::vector<std::string> balance_columns<2>(const SpeciesList&);
template std::vector<std::string> balance_columns<3>(const SpeciesList&);
template std::vector<double> balance_row(const MomentumBalance<2>&, std::size_t);
template std::vector<double> balance_row(const MomentumBalance<3>&, std::size_t);

}  // namespace grseg
