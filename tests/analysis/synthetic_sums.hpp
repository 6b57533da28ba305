// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/frames/layer_key.hpp"
#include "analysis/stress/contact_sums.hpp"
#include "formats/cli/table.hpp"

#include <limits>
#include <map>
#include <string>
#include <utility>
#include <vector>

/// Sums of force (x) branch that are made by algebra instead of by a simulation.
namespace grseg::synthetic {

/// A stress without symmetry, all components of which differ, so that exchanged components are noticed.
inline Tensor2 any_tensor()
{
  Tensor2 tensor;
  tensor << 0.8, -0.41, -0.39, 1.1;
  return tensor;
}

/// Sums of the neutral contact model: the share x_L = phi_L/(phi_L + r phi_S) of the contact ends
/// belongs to large grains (perimeter), ends pair at random, and forces do not depend on type. A
/// contact then carries stress in proportion to its branch: 2 r, 1 + r and 2 for LL, LS and SS.
inline ContactSums<2> neutral_sums(double phi_large, double r, double solid = 0.8,
                                   double volume = 2)
{
  const double large = phi_large / (phi_large + r * (1 - phi_large)), small = 1 - large;
  ContactSums<2> sums;
  sums.volume = volume;
  sums.content[1] = phi_large * solid * volume;
  sums.content[0] = (1 - phi_large) * solid * volume;
  sums.of(OwnSum::inside, 1) = large * large * 2 * r * any_tensor();
  sums.of(OwnSum::inside, 0) = small * small * 2 * any_tensor();
  sums.of(PairSum::whole, 0) = 2 * large * small * (1 + r) * any_tensor();
  sums.of(PairSum::by_size, 0) = r / (1 + r) * sums.of(PairSum::whole, 0);
  sums.of(PairSum::up_to_contact, 0) = sums.of(PairSum::by_size, 0);
  return sums;
}

/// Sums of two species with the given stresses and without mixed contacts.
inline ContactSums<2> separate_sums(double phi_large, const Tensor2& small, const Tensor2& large)
{
  ContactSums<2> sums;
  sums.volume = 1;
  sums.content[1] = 0.8 * phi_large;
  sums.content[0] = 0.8 * (1 - phi_large);
  sums.of(OwnSum::inside, 0) = small;
  sums.of(OwnSum::inside, 1) = large;
  return sums;
}

/// The sums plus a stress along x that depends on the window's number and that no fit of yy reads.
/// Without it, equal windows would look like a bed that has not moved.
inline ContactSums<2> moved(ContactSums<2> sums, int window)
{
  sums.of(OwnSum::inside, 0)(0, 0) += 0.01 * window;
  return sums;
}

struct TableRow {
  double begin, end, frames;
  ContactSums<2> sums;
  // Bottom and top, m; NaN: 0.02 m, above the last layer of its window and a gap.
  double bottom = std::numeric_limits<double>::quiet_NaN(), top = bottom;
};

/// Table as grseg-stress --partition power:2 writes it.
inline Table stress_table(const std::vector<TableRow>& rows, double small_diameter = 0.005,
                          double large_diameter = 0.01)
{
  Table table;
  table.name = "sums.tsv";
  table.header = {{"program", "grseg-stress"},
                  {"small_diameter", format_number(small_diameter)},
                  {"large_diameter", format_number(large_diameter)},
                  {"power", "2"}};
  const TableKind kind{.dimension = 2, .at_centres = false, .power = true};
  std::vector<std::string> names{"area_S[m^2]", "area_L[m^2]"};
  for (const auto& name : sum_column_names(two_sizes(1, 2), kind)) names.push_back(name);
  table.columns = with_key_columns(2, names);
  std::map<double, int> layers;  // number of layers of each window so far
  for (const auto& row : rows) {
    const auto& sums = row.sums;
    const double next = 0.0202 * layers[row.begin]++;  // so that no layer has a neighbour
    const bool given = row.bottom == row.bottom;
    std::vector<double> cells{sums.content[0], sums.content[1]};
    for (const double cell : sum_cells(sums, kind)) cells.push_back(cell);
    table.rows.push_back(with_key({row.begin, row.end, given ? row.bottom : next,
                                   given ? row.top : next + 0.02, row.frames, sums.volume},
                                  cells));
  }
  return table;
}

}  // namespace grseg::synthetic
