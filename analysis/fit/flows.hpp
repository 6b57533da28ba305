// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/fit/fit_data.hpp"

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace grseg {

/// A flow: tables whose runs differ in nothing that is recorded but their seed.
struct Flow {
  std::string name;                 // "Phi_L = 0.06, slope = 21 degrees": what tells it from others
  std::vector<double> composition;  // each species' part of the grains' area, volume or mass
  std::vector<std::size_t> tables;  // numbers in the list of tables
  // Settings in which flows differ, besides composition: "slope[degree]" and "21", "initial" and
  // "mixed".
  std::vector<std::pair<std::string, std::string>> settings = {};

  double phi_large() const { return composition.back(); }
};

/// How far the overall compositions of runs of one flow may lie apart. Seeds change them by some
/// 0.001, because radii are drawn, and in cells of few hundred grains by a large one more or less.
inline constexpr double composition_tolerance = 0.02;

/// How far, relative to the larger one, their nominal diameters may lie apart. Of imported runs
/// these are measured on the grains at hand, half-way between the smallest and the largest of a
/// species: of n grains spread evenly over +-10 % that scatters by 0.14/n.
inline constexpr double diameter_tolerance = 0.01;

/// How these tables are told apart, for the header of the fit; names what they record.
std::string grouping_words(const std::string& grouping, const std::vector<Table>& tables);

/// Finds the flows of all tables, in order of Phi_L, and sets in each table the number of its flow.
///
/// grouping "auto": tables are of one flow where the lines of their headers agree that are about
/// the flow (diameters, density, friction, restitution, gravity, step, length of the cell, species;
/// numbers to 1e-6, diameters to diameter_tolerance) and so do their overall compositions, to
/// composition_tolerance, and the keys of their scenes, where both state one (all but seed, times
/// and storage: "initial", "base", "spread" ...). Another line that one table has and another lacks
/// tells them apart. "4,4,2": the first four tables are of one flow, and so on; UsageError where
/// these numbers do not add up to the number of tables.
std::vector<Flow> find_flows(std::vector<FitTable>& tables, const std::string& grouping);

/// The part of `data` that is of one flow, as if it had been selected alone.
FitData of_flow(const FitData& data, std::size_t flow);

/// Each flow's part of the weight of all samples in B.
std::vector<double> weight_shares(const FitData& data, std::size_t flows);

}  // namespace grseg
