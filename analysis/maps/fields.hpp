// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/frames/cells.hpp"
#include "analysis/stress/kinetic_stress.hpp"
#include "analysis/stress/partial_stress.hpp"
#include "formats/core/species.hpp"

#include <vector>

/// The fields that follow from the sums of one cell of a map. Where a cell is empty sums and
/// densities are 0, and what is divided by them is NaN.
namespace grseg {

/// How the stress of a map is made of its sums.
struct MapStress {
  PartitionRule rule;
  BasePart base = BasePart::contact_point;
  StressVolume volume = StressVolume::bulk;
};

/// nu, the solid fraction; phi_L, or phi_NAME of each species where they are not two; pressure, the
/// mean of the normal components; sigma_yy; stress_ratio = -sigma_xy/sigma_yy, the friction of a
/// flow along x.
template <int D>
std::vector<Cell> stress_fields(const ContactSums<D>& sums, const SpeciesList& species,
                                const MapStress& how);

/// w, the third component of the mean velocity, in three dimensions; T, the granular temperature:
/// the mean of dv^2 over the grains' mass and the D components.
template <int D>
std::vector<Cell> flow_fields(const Vector<D>& velocity,
                              const typename KineticStress<D>::Mean& all_species);

}  // namespace grseg
