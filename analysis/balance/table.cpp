// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/balance/table.hpp"

#include "analysis/balance/driving_forces.hpp"
#include "analysis/frames/cells.hpp"

#include <fmt/format.h>

namespace grseg {
namespace {

/// One species in one layer.
struct SpeciesPart {
  const char* name;  // S or L
  SpeciesMomentum momentum;
  Vec2 change = Vec2::Zero();                // N/m^2
  Tensor2 kinetic_stress = Tensor2::Zero();  // N/m
};

/// About a mean velocity, m/s.
Tensor2 kinetic_stress(const SpeciesMomentum& of, const Vec2& mean)
{
  const Tensor2 carried = of.momentum * mean.transpose();
  return of.momentum_flux - carried - carried.transpose() + of.density * mean * mean.transpose();
}

void add_species(std::vector<Cell>& cells, const SpeciesPart& part)
{
  const auto& of = part.momentum;
  const auto add = [&](const char* name, double value) {
    cells.push_back({fmt::format(fmt::runtime(name), part.name), value});
  };
  add("rho_{}[kg/m^2]", of.density);
  add("jx_{}[kg/(m s)]", of.momentum.x());
  add("jy_{}[kg/(m s)]", of.momentum.y());
  add("Sc_{}_xx[N/m]", of.contact_stress(0, 0));
  add("Sc_{}_xy[N/m]", of.contact_stress(0, 1));
  add("Sc_{}_yx[N/m]", of.contact_stress(1, 0));
  add("Sc_{}_yy[N/m]", of.contact_stress(1, 1));
  add("Sk_{}_xx[N/m]", part.kinetic_stress(0, 0));
  add("Sk_{}_xy[N/m]", part.kinetic_stress(0, 1));
  add("Sk_{}_yy[N/m]", part.kinetic_stress(1, 1));
  const auto add_force = [&](const char* name, const Vec2& density) {
    cells.push_back({fmt::format("{}_{}_x[N/m^2]", name, part.name), density.x()});
    cells.push_back({fmt::format("{}_{}_y[N/m^2]", name, part.name), density.y()});
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

std::vector<Cell> cells_of(const SpeciesPart& small, const SpeciesPart& large,
                           const DrivingForces& forces)
{
  std::vector<Cell> cells;
  add_species(cells, small);
  add_species(cells, large);
  cells.insert(cells.end(), {{"phi_L", forces.phi},
                             {"psi_L", forces.psi},
                             {"psik_L", forces.psi_kinetic},
                             {"B", forces.b},
                             {"B_kappa", forces.b_kinetic},
                             {"push[N/m^2]", forces.push},
                             {"push_kinetic[N/m^2]", forces.push_kinetic},
                             {"spread[N/m^2]", forces.spread},
                             {"spread_kinetic[N/m^2]", forces.spread_kinetic},
                             {"drag[N/m^2]", forces.drag},
                             {"scatter[N/m^2]", forces.scatter},
                             {"drift[kg/(m^2 s)]", forces.drift},
                             {"drag_rate[1/s]", forces.drag_rate()}});
  return cells;
}

}  // namespace

std::vector<std::string> balance_columns()
{
  return columns_of(cells_of({"S", {}}, {"L", {}}, {}));
}

std::vector<double> balance_row(const MomentumBalance& balance, std::size_t layer)
{
  SpeciesPart small{"S", balance.mean(layer, Species::small),
                    balance.change(layer, Species::small)};
  SpeciesPart large{"L", balance.mean(layer, Species::large),
                    balance.change(layer, Species::large)};
  const Vec2 mean = (small.momentum.momentum + large.momentum.momentum) /
                    (small.momentum.density + large.momentum.density);
  for (SpeciesPart* part : {&small, &large})
    part->kinetic_stress = kinetic_stress(part->momentum, mean);
  return values_of(cells_of(small, large, driving_forces(balance, layer)));
}

}  // namespace grseg
