// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/micro/structure_sums.hpp"

namespace grseg {

/// Sums of the neutral contact model (docs/glossary.md): small grains of diameter 1, large grains of
/// diameter r. Contact ends are in proportion to perimeter, or in three dimensions to surface, and
/// are paired at random, 4 per small grain. All contacts touch and have the normal force 1, in all
/// directions equally.
template <int D = 2>
StructureSums<D> neutral_contacts(double phi_large, double r)
{
  StructureSums<D> sums;
  const auto set_species = [&](Species s, double phi, double diameter) {
    auto& species = sums.species[static_cast<std::size_t>(s)];
    species.content = 100 * phi;
    species.grains = species.content / grain_volume<D>(diameter / 2);
    species.ends = 4 * (D == 2 ? diameter : diameter * diameter) * species.grains;
  };
  set_species(Species::small, 1 - phi_large, 1);
  set_species(Species::large, phi_large, r);
  const double small = sums.of(Species::small).ends, large = sums.of(Species::large).ends;
  const double all = small + large, mixed = small * large / all;
  const auto set_pair = [&](PairType type, double contacts, double branch) {
    auto& pair = sums.pair[static_cast<std::size_t>(type)];
    pair.contacts = pair.force = pair.normal = contacts;
    pair.stress = contacts * branch / D * Tensor<D>::Identity();
  };
  set_pair(PairType::SS, small * small / all / 2, 1);
  set_pair(PairType::LS, mixed, (1 + r) / 2);
  set_pair(PairType::LL, large * large / all / 2, r);
  sums.mixed_size = r / (1 + r) * sums.of(PairType::LS).stress;
  for (auto& species : sums.species) species.mixed_ends = mixed;
  return sums;
}

}  // namespace grseg
