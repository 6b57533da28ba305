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

/// The part of a contact with the base or a wall that its mobile grain's species gets.
enum class BasePart {
  contact_point,  ///< the branch from the grain's centre to the contact point
  half,           ///< half the whole branch (LAMMPS and LIGGGHTS)
  none,
};
inline constexpr Choice<BasePart> base_parts[] = {
    {"contact-point", BasePart::contact_point}, {"half", BasePart::half}, {"none", BasePart::none}};

enum class StressVolume {
  bulk,   ///< volume of the layer, with voids
  solid,  ///< volume of the mobile grains in it
};
inline constexpr Choice<StressVolume> stress_volumes[] = {
    {"bulk", StressVolume::bulk, "V"}, {"solid", StressVolume::solid, "area_S + area_L"}};

/// N/m. small + large = total for every rule but `drop`.
template <int D>
struct PartialStress {
  std::vector<Tensor<D>> of_species;
  Tensor<D> total;

  // Where there are two.
  const Tensor<D>& small() const { return of_species.front(); }
  const Tensor<D>& large() const { return of_species.back(); }
};

/// Staron & Phillips (2015), eq. 1, parted between the species:
///   sigma^L = (A_LL + share + base_L)/V,  sigma^S = (A_SS + M - share + base_S)/V,
/// `share` being the rule's part of the mixed contacts' sum M; by `size` that is the prefactor
/// d_L/(d_L + d_S) in the text below eq. 1. Of more species each has such shares of its contacts
/// with every other one. Of parts counted at the grains' centres half and uniform:P take P ML and
/// (1 - P) MS, and of equal grains half at either; half is then compute stress/atom, summed by
/// species and layer.
template <int D>
PartialStress<D> partial_stress(const ContactSums<D>& sums, const PartitionRule& rule,
                                BasePart base = BasePart::contact_point,
                                StressVolume volume = StressVolume::bulk);

/// How the stress of a map is made of its sums.
struct MapStress {
  PartitionRule rule;
  BasePart base = BasePart::contact_point;
  StressVolume volume = StressVolume::bulk;
};

/// Fields in the cell of a map, for looking at: nu, the solid fraction; phi_L, or phi_NAME of each
/// species where they are not two; pressure, the mean of the normal components; sigma_yy;
/// stress_ratio = -sigma_xy/sigma_yy, the friction of a flow along x. Where a cell is empty sums
/// and densities are 0, and quotients by them are NaN.
template <int D>
std::vector<Cell> stress_fields(const ContactSums<D>& sums, const SpeciesList& species,
                                const MapStress& how);

/// Reads the rows of a table of grseg-stress as ContactSums of its species, with zeros in z if the
/// table is of two dimensions. FormatError, naming the column and how to get it, where one is
/// missing that `rules` need, where a number is not finite, or where an area or volume of grains is
/// negative. Components whose columns the table's line "not kept" names are NaN.
class ContactSumsReader {
 public:
  ContactSumsReader(const Table& table, const std::vector<PartitionRule>& rules);
  ContactSums<3> read(std::size_t row) const;
  const SpeciesList& species() const { return species_; }

 private:
  struct Place {
    NamedSum sum;
    std::vector<std::optional<std::size_t>> columns;  // by component; nothing: not kept
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
