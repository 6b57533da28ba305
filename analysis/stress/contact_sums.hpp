// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/frames/sums.hpp"
#include "formats/core/frame.hpp"
#include "formats/core/species.hpp"

#include <array>
#include <cstddef>
#include <string>
#include <tuple>
#include <vector>

namespace grseg {

/// Sums over the contacts of one species (rules: partition_rule.hpp).
enum class OwnSum {
  inside,      ///< contacts between its grains
  base,        ///< contacts with the base; branch from the grain's centre to the contact point
  whole_base,  ///< contacts with the base; whole branch
  halves,      ///< contacts between its grains, half in the layer of each grain (--assign grain)
};
constexpr std::size_t own_sums = 4;

/// Sums over the contacts between two species; the larger species has the larger nominal diameter.
enum class PairSum {
  whole,          ///< whole branch
  by_size,        ///< part of the larger grain under the rule `size`
  up_to_contact,  ///< part of the larger grain under the rule `contact-point`
  by_power,       ///< part of the larger grain under the rule power:Q
  at_larger,      ///< whole branch, in the layer of the larger grain (--assign grain)
  at_smaller,     ///< whole branch, in the layer of the smaller grain (--assign grain)
};
constexpr std::size_t pair_sums = 6;

/// Number of a pair of species a < b: (0, 1), (0, 2), (1, 2), (0, 3) ...
constexpr std::size_t pair_index(std::size_t a, std::size_t b)
{
  return b * (b - 1) / 2 + a;
}
constexpr std::size_t number_of_pairs(std::size_t species)
{
  return species * (species - 1) / 2;
}

/// Sums of force (x) branch over the contacts of one layer in one window, N m, positive in
/// compression, averaged over frames. grseg-stress writes them, and all partition rules are
/// computed from them. Divided by V they are stresses (Staron & Phillips 2015, eq. 1).
template <int D>
class ContactSums {
 public:
  explicit ContactSums(std::size_t species = 2)
      : content(species),
        own_(species, zeros<own_sums>()),
        pair_(number_of_pairs(species), zeros<pair_sums>())
  {
  }

  double volume = 0;            // volume V of the layer with its voids, m^2 or m^3
  std::vector<double> content;  // area or volume of the mobile grains, by species, m^2 or m^3
  /// True if each grain's part is in the layer of its centre (--assign grain). Parts are then by
  /// `size`, and rules with one share for all contacts use halves, at_larger and at_smaller.
  bool at_centres = false;

  std::size_t species() const { return own_.size(); }
  Tensor<D>& of(OwnSum sum, std::size_t species)
  {
    return own_[species][static_cast<std::size_t>(sum)];
  }
  const Tensor<D>& of(OwnSum sum, std::size_t species) const
  {
    return own_[species][static_cast<std::size_t>(sum)];
  }
  /// The sum of the pair `pair_index(a, b)`.
  Tensor<D>& of(PairSum sum, std::size_t pair)
  {
    return pair_[pair][static_cast<std::size_t>(sum)];
  }
  const Tensor<D>& of(PairSum sum, std::size_t pair) const
  {
    return pair_[pair][static_cast<std::size_t>(sum)];
  }

  ContactSums& operator+=(const ContactSums& others)
  {
    at_centres |= others.at_centres;
    accumulate(*this, others);
    return *this;
  }

 private:
  template <std::size_t N>
  static std::array<Tensor<D>, N> zeros()
  {
    std::array<Tensor<D>, N> all;
    all.fill(Tensor<D>::Zero());
    return all;
  }

  std::vector<std::array<Tensor<D>, own_sums>> own_;
  std::vector<std::array<Tensor<D>, pair_sums>> pair_;

 public:
  static constexpr auto members = std::tuple(&ContactSums::volume, &ContactSums::content,
                                             &ContactSums::own_, &ContactSums::pair_);
};

/// The tables of grseg-stress that have a column.
enum class InTables {
  all,
  at_centres,  ///< tables made with --assign grain
  power,       ///< tables made with --partition power:Q
};

/// Columns of one sum; each species or pair of species has a group of columns, one per component.
struct ContactSumColumns {
  const char *of_two, *of_others;  // name for tables of two species, and for other tables
  bool of_pairs;                   // true for a sum by pair of species, false by species
  std::size_t sum;                 // the PairSum or OwnSum, as a number
  InTables in;
};

/// List of all sums in the order of the table. All code that writes, reads or merges sums uses it.
inline constexpr std::array<ContactSumColumns, own_sums + pair_sums> contact_sum_columns{{
    {"A_{}{}", "A_{}", false, static_cast<std::size_t>(OwnSum::inside), InTables::all},
    {"M", "M_{}+{}", true, static_cast<std::size_t>(PairSum::whole), InTables::all},
    {"Msize", "Msize_{}+{}", true, static_cast<std::size_t>(PairSum::by_size), InTables::all},
    {"Mcp", "Mcp_{}+{}", true, static_cast<std::size_t>(PairSum::up_to_contact), InTables::all},
    {"A_{}b", "A_{}+b", false, static_cast<std::size_t>(OwnSum::base), InTables::all},
    {"F_{}b", "F_{}+b", false, static_cast<std::size_t>(OwnSum::whole_base), InTables::all},
    {"H{}{}", "H_{}", false, static_cast<std::size_t>(OwnSum::halves), InTables::at_centres},
    {"ML", "ML_{}+{}", true, static_cast<std::size_t>(PairSum::at_larger), InTables::at_centres},
    {"MS", "MS_{}+{}", true, static_cast<std::size_t>(PairSum::at_smaller), InTables::at_centres},
    {"Mpower", "Mpower_{}+{}", true, static_cast<std::size_t>(PairSum::by_power), InTables::power},
}};

/// Properties of a table of grseg-stress that decide on its columns.
struct TableKind {
  int dimension = 2;
  bool at_centres = false, power = false;

  bool has(InTables in) const
  {
    return in == InTables::all || (in == InTables::at_centres ? at_centres : power);
  }
};

/// Components of a tensor in the order of the columns, "_xx" first.
struct TensorComponent {
  std::string suffix;
  Eigen::Index row, column;
};
std::vector<TensorComponent> tensor_components(int dimension);

/// A sum of one species or pair with the name of its columns, without component and unit: "A_SS",
/// "Msize"; unless there are two species "A_AM", "Msize_AM+SE", "A_AM+b".
struct NamedSum {
  std::string name;
  const ContactSumColumns* columns;
  std::size_t index;  // number of the species or pair

  template <class Sums>
  auto& in(Sums& sums) const
  {
    return columns->of_pairs ? sums.of(static_cast<PairSum>(columns->sum), index)
                             : sums.of(static_cast<OwnSum>(columns->sum), index);
  }
};
/// All sums of a kind of table, in the order of columns.
std::vector<NamedSum> named_sums(const SpeciesList& species, InTables in);
std::vector<NamedSum> named_sums(const SpeciesList& species, const TableKind& kind);

/// Name of a column with its unit, "A_SS_xx[N m]".
std::string column_name(const NamedSum& sum, const TensorComponent& component);
/// Names of the columns of areas or volumes of grains: "area_S[m^2]", "volume_AM[m^3]".
std::vector<std::string> content_columns(const SpeciesList& species, int dimension);
/// Names of the columns of numbers of contacts, in the order of contact_index(): "n_SS", "n_LS".
std::vector<std::string> contact_number_columns(const SpeciesList& species);

/// Number of a kind of contact: first contacts between species a <= b, in the order SS, LS, LL,
/// then contacts of each species with the base.
constexpr std::size_t contact_index(std::size_t a, std::size_t b)
{
  return b * (b + 1) / 2 + a;
}
constexpr std::size_t base_contact_index(std::size_t species, std::size_t number_of_species)
{
  return number_of_species * (number_of_species + 1) / 2 + species;
}

/// Names with units of all columns of sums in a table, and the numbers in these columns.
std::vector<std::string> sum_column_names(const SpeciesList& species, const TableKind& kind);
template <int D>
std::vector<double> sum_cells(const ContactSums<D>& sums, const TableKind& kind);

}  // namespace grseg
