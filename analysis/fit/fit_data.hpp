// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/statistics/dependence.hpp"
#include "analysis/stress/contact_sums.hpp"
#include "analysis/stress/partition_rule.hpp"
#include "formats/cli/table.hpp"
#include "formats/cli/words.hpp"

#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace grseg {

enum class Quantity { contact, kinetic };
inline constexpr Choice<Quantity> quantities[] = {{"contact", Quantity::contact},
                                                  {"kinetic", Quantity::kinetic}};
/// pressure: P = (lambda_1 + lambda_2)/2 (Staron & Phillips 2015, below eq. 1), half the trace.
enum class Component { yy, pressure };
inline constexpr Choice<Component> components[] = {
    {"yy", Component::yy}, {"pressure", Component::pressure, "half the trace"}};

/// Which rows of the tables are points of the fit.
struct FitFilters {
  double ratio_low = 0.01, ratio_high = 100;                // of phi_S/phi_L
  double min_solid = 0.5;                                   // of the run's median solid fraction
  double begin = -std::numeric_limits<double>::infinity();  // s, windows lie in [begin, end]
  double end = std::numeric_limits<double>::infinity();
  std::string heights{};  // between which layers lie, as on the command line: "4dS:56dS"; "": all

  bool all_times() const { return std::isinf(begin) && std::isinf(end); }
};

/// One layer in one window.
struct LayerSample {
  std::size_t window = 0;  // in the series of all windows, run after run
  double phi_large = 0;    // local composition: phi_L + phi_S = 1
  double weight = 0;       // frames x grains of the rarer species, up to a constant factor
  double size_ratio = 0;   // nominal d_L/d_S of its run
  std::size_t table = 0;   // among FitData::tables
  ContactSums sums;        // kinetic: species alone, nothing mixed, so every rule gives the same
};

/// How many rows were used, and why the others were not.
struct FilterCount {
  std::size_t rows = 0, outside_times = 0, without_grains = 0, without_small = 0, without_large = 0,
              outside_ratio = 0, below_solid = 0, outside_heights = 0, used = 0;

  /// "320 rows, of which 20 hold no grains, ...": names the options that removed them.
  std::string sentence() const;
};

struct FitData {
  Quantity quantity = Quantity::contact;
  RunLengths runs;                  // windows with samples, per table
  std::vector<std::string> tables;  // their names
  std::vector<LayerSample> samples;
  FilterCount count;
};

/// The layers and windows of all tables that pass the filters; each table is one run. phi is made
/// of areas (contact, table of grseg-stress) or masses (kinetic, table of grseg-kinetic; both
/// species have one density). RunError, saying what removed them, where nothing is left;
/// FormatError where a table lacks what is asked of it; UsageError where two tables hold the same
/// windows of the same run.
FitData read_fit_data(const std::vector<Table>& tables, Quantity quantity,
                      const FitFilters& filters, const std::vector<PartitionRule>& rules);

}  // namespace grseg
