// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/core/frame.hpp"

#include <array>
#include <cstddef>
#include <string>
#include <vector>

namespace grseg {

/// Sums of force (x) branch over the contacts of one layer in one window, N m, compression
/// positive, means per frame: what grseg-stress writes and every partition rule is made of. Divided
/// by V they are stresses (Staron & Phillips 2015, eq. 1).
struct ContactSums {
  double volume = 0;                        // m^2, voids included
  double area_small = 0, area_large = 0;    // m^2
  Tensor2 ss = Tensor2::Zero();             // between small grains
  Tensor2 ll = Tensor2::Zero();             // between large grains
  Tensor2 mixed = Tensor2::Zero();          // between a large and a small grain, whole branch
  Tensor2 mixed_size = Tensor2::Zero();     // of these, the large grain's part by size
  Tensor2 mixed_contact = Tensor2::Zero();  // the large grain's part up to the contact point
  Tensor2 mixed_power = Tensor2::Zero();    // the large grain's part by power:Q
  // Small and large grains with the base: up to the contact point, and the whole branch.
  Tensor2 base_small = Tensor2::Zero(), base_large = Tensor2::Zero();
  Tensor2 whole_small = Tensor2::Zero(), whole_large = Tensor2::Zero();

  /// Each grain's part is counted at that grain's centre (--assign grain). The sums above then hold
  /// parts cut by size, and those below what a share is taken of that is the same for all contacts.
  bool at_centres = false;
  Tensor2 halves_ss = Tensor2::Zero(), halves_ll = Tensor2::Zero();  // half at either grain
  // The whole branch at the large grain, and once more at the small one.
  Tensor2 mixed_at_large = Tensor2::Zero(), mixed_at_small = Tensor2::Zero();

  ContactSums& operator+=(const ContactSums& others);
  ContactSums operator/(double number) const;
};

/// Which tables of grseg-stress have a column.
enum class InTables {
  all,
  at_centres,  ///< those made with --assign grain
  power,       ///< those made with --partition power:Q
};

/// Columns NAME_xx NAME_xy NAME_yx NAME_yy, N m, and where their numbers are.
struct ContactSumColumns {
  const char* name;
  Tensor2 ContactSums::*sum;
  InTables in;
};

/// The one list of all sums, in the order of the table. Whatever adds, writes, reads or merges them
/// goes through it.
inline constexpr std::array<ContactSumColumns, 14> contact_sum_columns{{
    {"A_SS", &ContactSums::ss, InTables::all},
    {"A_LL", &ContactSums::ll, InTables::all},
    {"M", &ContactSums::mixed, InTables::all},
    {"Msize", &ContactSums::mixed_size, InTables::all},
    {"Mcp", &ContactSums::mixed_contact, InTables::all},
    {"A_Sb", &ContactSums::base_small, InTables::all},
    {"A_Lb", &ContactSums::base_large, InTables::all},
    {"F_Sb", &ContactSums::whole_small, InTables::all},
    {"F_Lb", &ContactSums::whole_large, InTables::all},
    {"HSS", &ContactSums::halves_ss, InTables::at_centres},
    {"HLL", &ContactSums::halves_ll, InTables::at_centres},
    {"ML", &ContactSums::mixed_at_large, InTables::at_centres},
    {"MS", &ContactSums::mixed_at_small, InTables::at_centres},
    {"Mpower", &ContactSums::mixed_power, InTables::power},
}};

/// Columns of areas, with their unit.
struct AreaColumn {
  const char* name;
  double ContactSums::*area;
};
inline constexpr std::array<AreaColumn, 2> area_columns{
    {{"area_S[m^2]", &ContactSums::area_small}, {"area_L[m^2]", &ContactSums::area_large}}};

/// Components of a tensor in the order of the columns.
struct Component2 {
  const char* suffix;
  Eigen::Index row, column;
};
inline constexpr std::array<Component2, 4> tensor_components{
    {{"_xx", 0, 0}, {"_xy", 0, 1}, {"_yx", 1, 0}, {"_yy", 1, 1}}};

/// What a table of grseg-stress was made with, as far as it adds columns.
struct TableKind {
  bool at_centres = false, power = false;

  bool has(InTables in) const
  {
    return in == InTables::all || (in == InTables::at_centres ? at_centres : power);
  }
};

/// "A_SS_xx[N m]".
std::string column_name(const ContactSumColumns& sum, const Component2& component);
/// Names with units of all sums that a table has, and the numbers under them.
std::vector<std::string> sum_column_names(const TableKind& kind);
std::vector<double> sum_cells(const ContactSums& sums, const TableKind& kind);

}  // namespace grseg
