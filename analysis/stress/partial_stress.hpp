// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/frames/sums.hpp"
#include "analysis/stress/contact_sums.hpp"
#include "analysis/stress/partition_rule.hpp"
#include "formats/cli/table.hpp"
#include "formats/cli/words.hpp"
#include "formats/core/species.hpp"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace grseg {

/// Part of the branch of a contact with the base or a wall that belongs to the mobile grain.
enum class BasePart {
  contact_point,  ///< from the grain's centre to the contact point
  half,           ///< half the whole branch (LAMMPS and LIGGGHTS)
  none,
};
inline constexpr Choice<BasePart> base_parts[] = {
    {"contact-point", BasePart::contact_point}, {"half", BasePart::half}, {"none", BasePart::none}};

enum class StressVolume {
  bulk,   ///< volume of the layer with its voids
  solid,  ///< volume of the mobile grains in the layer
};
inline constexpr Choice<StressVolume> stress_volumes[] = {
    {"bulk", StressVolume::bulk, "V"}, {"solid", StressVolume::solid, "area_S + area_L"}};

/// Stress, N/m or Pa. The species' stresses add up to `total`, except under the rule `drop`.
template <int D>
struct PartialStress {
  std::vector<Tensor<D>> of_species;
  Tensor<D> total;

  // Stress of small and large grains, if there are two species.
  const Tensor<D>& small() const { return of_species.front(); }
  const Tensor<D>& large() const { return of_species.back(); }
};

/// Stress of Staron & Phillips (2015), eq. 1, divided among the species:
///   sigma^L = (A_LL + share + base_L)/V,  sigma^S = (A_SS + M - share + base_S)/V,
/// with `share` the large grains' part of the sum M over mixed contacts. Under the rule `size` it
/// has the prefactor d_L/(d_L + d_S) of the text below eq. 1. With more species, each pair of
/// species is divided in this way. For sums at grains' centres (--assign grain) the rules half and
/// uniform:P use P ML and (1 - P) MS, and half of each contact of equal grains at either centre.
/// The rule half is then equal to compute stress/atom of LAMMPS, summed by species and layer.
template <int D>
PartialStress<D> partial_stress(const ContactSums<D>& sums, const PartitionRule& rule,
                                BasePart base = BasePart::contact_point,
                                StressVolume volume = StressVolume::bulk);

/// Choices that define the stress of a map.
struct MapStress {
  PartitionRule rule;
  BasePart base = BasePart::contact_point;
  StressVolume volume = StressVolume::bulk;
};

/// Fields of a map's cell for pictures: nu, the solid fraction; phi_L, or phi_NAME of each species
/// unless there are two; pressure, the mean of the normal components; sigma_yy; stress_ratio =
/// -sigma_xy/sigma_yy, the friction of a flow along x. In an empty cell sums and densities are 0,
/// and quotients by them are NaN.
template <int D>
std::vector<Cell> stress_fields(const ContactSums<D>& sums, const SpeciesList& species,
                                const MapStress& how);

/// Reads the rows of a table of grseg-stress as ContactSums of its species; z components of a table
/// in two dimensions are 0. Components whose columns the header line "not kept" names are NaN. All
/// sums that the table has are read, whatever the `rules`, except those by power:Q. Throws
/// FormatError, with the column and a remedy, if a column that `rules` need is missing; also if a
/// number is not finite, or an area or volume of grains is negative.
class ContactSumsReader {
 public:
  ContactSumsReader(const Table& table, const std::vector<PartitionRule>& rules);
  ContactSums<3> read(std::size_t row) const;
  const SpeciesList& species() const { return species_; }

 private:
  struct Place {
    NamedSum sum;
    std::vector<std::optional<std::size_t>> columns;  // column of each component, if it is kept
  };
  bool is_at_centres() const;
  void add_columns(InTables in, const std::vector<PartitionRule>& rules, const std::string& remedy);

  const Table& table_;
  SpeciesList species_;
  std::vector<TensorComponent> components_;
  bool at_centres_ = false;
  std::size_t volume_;
  std::vector<std::size_t> contents_;
  std::vector<Place> places_;
};

}  // namespace grseg
