// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/balance/balance_table.hpp"

#include "analysis/balance/segregation_forces.hpp"

#include <fmt/format.h>

namespace grseg {
namespace {

constexpr std::array terms{"rate",        "gravity", "contact", "kinetic",
                           "interaction", "base",    "force",   "residual"};

/// About a mean velocity, m/s.
Tensor2 kinetic_stress(const SpeciesMomentum& of, const Vec2& mean)
{
  const Tensor2 carried = of.momentum * mean.transpose();
  return of.momentum_flux - carried - carried.transpose() + of.density * mean * mean.transpose();
}

void append(std::vector<double>& row, const SpeciesMomentum& of, const Vec2& mean)
{
  const Tensor2 &contact = of.contact_stress, kinetic = kinetic_stress(of, mean);
  row.insert(row.end(),
             {of.density, of.momentum.x(), of.momentum.y(), contact(0, 0), contact(0, 1),
              contact(1, 0), contact(1, 1), kinetic(0, 0), kinetic(0, 1), kinetic(1, 1)});
  for (const Vec2& term : {of.rate, of.gravity, of.contact, of.kinetic, of.interaction, of.base,
                           of.force, of.residual()})
    row.insert(row.end(), {term.x(), term.y()});
}

}  // namespace

std::vector<std::string> balance_columns()
{
  std::vector<std::string> names;
  for (const char* species : {"S", "L"}) {
    names.push_back(fmt::format("rho_{}[kg/m^2]", species));
    for (const char* axis : {"x", "y"})
      names.push_back(fmt::format("j{}_{}[kg/(m s)]", axis, species));
    for (const char* component : {"xx", "xy", "yx", "yy"})
      names.push_back(fmt::format("Sc_{}_{}[N/m]", species, component));
    for (const char* component : {"xx", "xy", "yy"})
      names.push_back(fmt::format("Sk_{}_{}[N/m]", species, component));
    for (const char* term : terms)
      for (const char* axis : {"x", "y"})
        names.push_back(fmt::format("{}_{}_{}[N/m^2]", term, species, axis));
    for (const char* axis : {"x", "y"})
      names.push_back(fmt::format("change_{}_{}[N/m^2]", species, axis));
  }
  for (const char* name : {"phi_L", "psi_L", "psik_L", "B", "B_kappa", "push[N/m^2]",
                           "push_kinetic[N/m^2]", "spread[N/m^2]", "spread_kinetic[N/m^2]",
                           "drag[N/m^2]", "scatter[N/m^2]", "drift[kg/(m^2 s)]", "drag_rate[1/s]"})
    names.emplace_back(name);
  return names;
}

std::vector<double> balance_row(const MomentumBalance& balance, std::size_t layer)
{
  const auto small = balance.mean(layer, Species::small);
  const auto large = balance.mean(layer, Species::large);
  const Vec2 mean = (small.momentum + large.momentum) / (small.density + large.density);
  std::vector<double> row;
  for (const auto species : {Species::small, Species::large}) {
    append(row, balance.mean(layer, species), mean);
    const Vec2 change = balance.change(layer, species);
    row.insert(row.end(), {change.x(), change.y()});
  }
  const auto of = segregation_forces(balance, layer);
  row.insert(row.end(),
             {of.phi, of.psi, of.psi_kinetic, of.b, of.b_kinetic, of.push, of.push_kinetic,
              of.spread, of.spread_kinetic, of.drag, of.scatter, of.drift, of.drag_rate()});
  return row;
}

}  // namespace grseg
