// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/fit/fit_data.hpp"
#include "analysis/frames/flow_of_table.hpp"

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace grseg {

/// A flow: tables of runs that agree in all recorded settings except the seed.
struct Flow {
  std::string name;                 // settings that differ: "Phi_L = 0.06, slope = 21 degrees"
  std::vector<double> composition;  // each species' share of all grains' area, volume or mass
  std::vector<std::size_t> tables;  // indices in the list of tables
  // Names and values of settings in which flows differ, except composition: "slope[degree]" and
  // "21", "initial" and "mixed".
  std::vector<std::pair<std::string, std::string>> settings = {};

  double phi_large() const { return composition.back(); }
};

/// Sentence for the header of the fit on how tables are grouped into flows, with the settings that
/// the tables record.
std::string grouping_words(const std::string& grouping, const std::vector<Table>& tables);

/// Finds the flows of all tables, in order of Phi_L, and stores in each table the index of its
/// flow.
///
/// grouping "auto": two tables are of one flow if three things agree. First, header lines about the
/// flow (diameters, density, friction, restitution, gravity, step, length of the cell, species):
/// numbers to 1e-6, diameters to diameter_tolerance; a line that only one table has is a
/// difference. Second, overall compositions, to composition_tolerance. Third, keys of the scenes
/// ("initial", "base", "spread" ...; not seed, times, storage) that both tables state.
///
/// grouping "4,4,2": the first four tables are of one flow, and so on. Throws UsageError if these
/// numbers do not add up to the number of tables.
std::vector<Flow> find_flows(std::vector<FitTable>& tables, const std::string& grouping);

/// The samples and rows of the windows to keep, without runs that have none of them.
FitData of_windows(const FitData& data, const std::vector<bool>& keep);
/// The samples and rows of one flow in `data`.
FitData of_flow(const FitData& data, std::size_t flow);

/// Share of each flow in the weight of all samples in B; the shares add up to 1.
std::vector<double> weight_shares(const FitData& data, std::size_t flows);

}  // namespace grseg
