// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/balance/balance_table.hpp"

#include "analysis/balance/driving_forces.hpp"
#include "analysis/frames/sums.hpp"
#include "analysis/stress/contact_sums.hpp"

#include <fmt/format.h>

#include <array>

namespace grseg {
namespace {

struct Units {
  const char *density, *momentum, *stress, *force;
};
template <int D>
constexpr Units units = D == 2 ? Units{"[kg/m^2]", "[kg/(m s)]", "[N/m]", "[N/m^2]"}
                               : Units{"[kg/m^3]", "[kg/(m^2 s)]", "[Pa]", "[N/m^3]"};
constexpr std::array<char, 3> axes{'x', 'y', 'z'};

/// About a mean velocity, m/s.
template <int D>
Tensor<D> kinetic_stress(const SpeciesMomentum<D>& of, const Vector<D>& mean)
{
  const Tensor<D> carried = of.momentum * mean.transpose();
  return of.momentum_flux - carried - carried.transpose() + of.density * mean * mean.transpose();
}

/// "contact_L_y@half[N/m^2]" and the others of this vector; the rule may be "".
template <int D>
void add_vector(std::vector<Cell>& cells, const std::string& name, const std::string& rule,
                const Vector<D>& value)
{
  for (std::size_t a = 0; a < D; ++a)
    cells.push_back({fmt::format("{}_{}{}{}", name, axes[a], rule, units<D>.force),
                     value[static_cast<Eigen::Index>(a)]});
}

/// The cells of one species in one layer; its kinetic stress is in N/m or Pa.
template <int D>
void add_species(std::vector<Cell>& cells, const std::string& name, const SpeciesMomentum<D>& of,
                 const Vector<D>& change, const Tensor<D>& kinetic_stress)
{
  constexpr Units unit = units<D>;
  cells.push_back({fmt::format("rho_{}{}", name, unit.density), of.density});
  for (std::size_t a = 0; a < D; ++a)
    cells.push_back({fmt::format("j{}_{}{}", axes[a], name, unit.momentum),
                     of.momentum[static_cast<Eigen::Index>(a)]});
  const auto components = tensor_components(D);
  for (const auto& [suffix, a, b] : components)
    cells.push_back({fmt::format("Sc_{}{}{}", name, suffix, unit.stress), of.contact_stress(a, b)});
  for (const auto& [suffix, a, b] : components)
    if (a <= b)
      cells.push_back({fmt::format("Sk_{}{}{}", name, suffix, unit.stress), kinetic_stress(a, b)});
  add_vector<D>(cells, "rate_" + name, "", of.rate);
  add_vector<D>(cells, "gravity_" + name, "", of.gravity);
  add_vector<D>(cells, "contact_" + name, "", of.contact);
  add_vector<D>(cells, "kinetic_" + name, "", of.kinetic);
  add_vector<D>(cells, "interaction_" + name, "", of.interaction);
  add_vector<D>(cells, "base_" + name, "", of.base);
  add_vector<D>(cells, "force_" + name, "", of.force);
  add_vector<D>(cells, "residual_" + name, "", of.residual());
  add_vector<D>(cells, "change_" + name, "", change);
}

template <int D>
void add_forces(std::vector<Cell>& cells, const DrivingForces& forces)
{
  const std::string unit = units<D>.force;
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
                             {std::string("drift") + units<D>.momentum, forces.drift},
                             {"drag_rate[1/s]", forces.drag_rate()}});
}

}  // namespace

template <int D>
std::vector<Cell> balance_cells(const MomentumBalance<D>& balance, const SpeciesList& species,
                                std::optional<std::size_t> layer)
{
  std::vector<SpeciesMomentum<D>> parts(species.size());
  Vector<D> momentum = Vector<D>::Zero();
  double density = 0;
  for (std::size_t k = 0; layer && k < parts.size(); ++k) {
    parts[k] = balance.mean(*layer, static_cast<Species>(k));
    momentum += parts[k].momentum;
    density += parts[k].density;
  }
  const Vector<D> mean = momentum / density;
  const auto words = column_words(species);
  std::vector<Cell> cells;
  for (std::size_t k = 0; k < parts.size(); ++k)
    add_species<D>(cells, words[k], parts[k],
                   layer ? balance.change(*layer, static_cast<Species>(k)) : mean,
                   kinetic_stress<D>(parts[k], mean));
  if (parts.size() == 2)
    add_forces<D>(cells, layer ? driving_forces(balance, *layer) : DrivingForces{});
  return cells;
}

template <int D>
std::vector<Cell> partition_cells(const MomentumBalance<D>& balance,
                                  const PartitionedBalance<D>& contacts, const SpeciesList& species,
                                  std::optional<std::size_t> layer)
{
  const auto words = column_words(species);
  const bool two = words.size() == 2;
  const auto forces = two && layer ? driving_forces(balance, *layer) : DrivingForces{};
  std::vector<Cell> cells;
  for (std::size_t k = 0; k < contacts.rules().size(); ++k) {
    const auto rule = fmt::format("@{}", contacts.rules()[k].name());
    for (std::size_t s = 0; s < words.size(); ++s) {
      const auto own =
          layer ? contacts.mean(*layer, static_cast<Species>(s), k) : PartitionedForces<D>{};
      add_vector<D>(cells, "contact_" + words[s], rule, own.contact);
      add_vector<D>(cells, "interaction_" + words[s], rule, own.interaction);
    }
    if (!two) continue;
    const auto of_rule = layer ? rule_forces(forces, contacts, *layer, k) : RuleForces{};
    const char* unit = units<D>.force;
    cells.insert(cells.end(), {{"psi_L" + rule, of_rule.psi},
                               {"B" + rule, of_rule.b},
                               {"push" + rule + unit, of_rule.push},
                               {"spread" + rule + unit, of_rule.spread},
                               {"drag" + rule + unit, of_rule.drag}});
  }
  for (std::size_t s = 0; s < words.size(); ++s)
    add_vector<D>(cells, "N_" + words[s], "",
                  layer ? contacts.contact_force(*layer, static_cast<Species>(s))
                        : Vector<D>(Vector<D>::Zero()));
  if (two)
    cells.push_back({"p_zero", layer ? push_over_share(forces, contacts, *layer).zero() : 0});
  return cells;
}

template std::vector<Cell> balance_cells(const MomentumBalance<2>&, const SpeciesList&,
                                         std::optional<std::size_t>);
template std::vector<Cell> balance_cells(const MomentumBalance<3>&, const SpeciesList&,
                                         std::optional<std::size_t>);
template std::vector<Cell> partition_cells(const MomentumBalance<2>&, const PartitionedBalance<2>&,
                                           const SpeciesList&, std::optional<std::size_t>);
template std::vector<Cell> partition_cells(const MomentumBalance<3>&, const PartitionedBalance<3>&,
                                           const SpeciesList&, std::optional<std::size_t>);

}  // namespace grseg
