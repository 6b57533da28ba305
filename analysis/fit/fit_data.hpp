// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/frames/layer_key.hpp"
#include "analysis/statistics/confidence.hpp"
#include "analysis/stress/contact_sums.hpp"
#include "analysis/stress/partial_stress.hpp"
#include "analysis/stress/partition_rule.hpp"
#include "formats/cli/table.hpp"
#include "formats/cli/words.hpp"
#include "formats/core/species.hpp"

#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

namespace grseg {

/// The population that an interval is over: where runs are taken to come from, and which number is
/// estimated. Runs that differ in their seed alone are of one flow.
enum class Population {
  automatic,     ///< windows of one run, runs of one flow, these flows of several
  windows,       ///< these very runs, had they lasted longer
  runs,          ///< one flow, over all its runs
  flows,         ///< these flows, weighted as they are, over all their runs
  equal_flows,   ///< these flows, each counting the same, over all their runs
  random_flows,  ///< the mean over all flows of which these are a random sample
  compositions,  ///< runs about one function of composition that is common to all flows
};
inline constexpr Choice<Population> populations[] = {
    {"windows", Population::windows, "these runs, had they lasted longer"},
    {"runs", Population::runs, "this flow, over all runs that it could have"},
    {"flows", Population::flows, "these flows, each with its weight"},
    {"equal-flows", Population::equal_flows, "these flows, each counting the same"},
    {"random-flows", Population::random_flows, "all flows, these being a random sample"},
    {"compositions", Population::compositions,
     "these compositions, if B depends on composition alone"}};

/// The automatic one of so many runs and flows; the others stand for themselves.
Population resolved(Population over, std::size_t runs, std::size_t flows);

/// The population and what is estimated, as a sentence without its full stop; of so many flows.
std::string estimand_words(Population over, std::size_t flows);

enum class Quantity { contact, kinetic };
inline constexpr Choice<Quantity> quantities[] = {
    {"contact", Quantity::contact, "tables of grseg-stress"},
    {"kinetic", Quantity::kinetic, "tables of grseg-kinetic"}};
/// pressure: P = (lambda_1 + lambda_2)/2 (Staron & Phillips 2015, below eq. 1), half the trace; in
/// three dimensions a third of it.
enum class Component { yy, pressure };
inline constexpr Choice<Component> components[] = {
    {"yy", Component::yy, "normal to the base"},
    {"pressure", Component::pressure, "half the trace"}};

/// Which rows of the tables are points of the fit.
struct FitFilters : RowFilter {
  double ratio_low = 0.01, ratio_high = 100;  // of phi_S/phi_L
};

/// Two of the species of the tables, the smaller first.
struct SpeciesPair {
  std::size_t smaller = 0, larger = 1;

  bool operator==(const SpeciesPair&) const = default;
};
/// All of them: (0, 1), (0, 2), (1, 2), (0, 3) ...
std::vector<SpeciesPair> all_pairs(std::size_t species);

/// One layer in one window, and two of its species.
struct LayerSample {
  std::size_t window = 0;  // in the series of all windows, run after run
  double phi_large = 0;    // the larger species' part of the two: phi_L + phi_S = 1
  double weight = 0;       // frames x grains of the rarer species, up to a constant factor
  double frames = 1;       // of its window
  double size_ratio = 0;   // of the nominal diameters in its run
  std::size_t table = 0;   // among FitData::tables
  std::size_t row = 0;     // among FitData::rows
  SpeciesPair pair = {};
  LayerKey key = {};

  double weight_in_b() const { return frames * phi_large * (1 - phi_large); }
};

/// How many rows were used, and why the others were not.
struct FilterCount {
  std::size_t rows = 0, outside_times = 0, without_grains = 0, without_small = 0, without_large = 0,
              outside_ratio = 0, below_solid = 0, outside_heights = 0, used = 0;

  /// "320 rows, 20 without grains, ...": names the options that removed them.
  std::string sentence() const;
};

struct FitData {
  Quantity quantity = Quantity::contact;
  int dimension = 2;
  RunLengths runs = {};                 // observations of each run: windows with samples, in line
  std::vector<std::size_t> flows = {};  // of each run (flows.hpp); empty: all are of one
  std::size_t still = 0;                // windows that add no observation, since nothing moved
  std::vector<std::string> tables;      // their names
  SpeciesList species;                  // of the first table; names agree in all
  double window = 0;                    // s, the first one's length
  // Kinetic: species alone, nothing mixed, so every rule gives the same.
  std::vector<ContactSums<3>> rows = {};
  std::vector<LayerSample> samples = {};
  FilterCount count;

  std::size_t flow_of(std::size_t run) const { return flows.empty() ? 0 : flows[run]; }
  std::size_t number_of_flows() const;  // that have runs
  std::vector<std::size_t> flows_of_windows() const;
};

/// A row of a table and the window and layer it belongs to.
struct FitRow {
  LayerKey key;
  ContactSums<3> sums;

  double solid() const;  // solid fraction
};

/// The rows of one table and its species.
struct FitTable {
  const Table* table;
  SpeciesList species;
  std::vector<FitRow> rows;
  std::size_t flow = 0;
  std::size_t run = 0;  // the same of tables of one run
};

/// Reads tables of grseg-stress (contact) or grseg-kinetic.
/// FormatError where a table lacks what is asked of it or has other species than the first;
/// UsageError where two tables hold the same windows of the same run.
std::vector<FitTable> read_fit_tables(const std::vector<Table>& tables, Quantity quantity,
                                      const std::vector<PartitionRule>& rules);

/// The layers and windows of all tables that pass the filters, with the samples of `pairs`; the
/// windows of tables of one run and flow stand in line (runs_of_tables.hpp). phi is made of areas
/// or volumes, or of masses (kinetic, where all species have one density). RunError, saying what
/// removed them, where nothing is left.
FitData select_fit_data(const std::vector<FitTable>& tables, Quantity quantity,
                        const FitFilters& filters, const std::vector<SpeciesPair>& pairs);

/// A point of the fit under one partition rule; stresses in N/m, in three dimensions Pa, the
/// chosen component.
struct FitPoint {
  std::size_t window = 0;
  double phi_large = 0;
  double weight = 0;
  double frames = 1;
  double size_ratio = 0;  // nominal d_L/d_S
  double small = 0, large = 0, total = 0;

  double ratio() const { return (1 - phi_large) / phi_large; }  // x
  bool has_logarithm() const { return small > 0 && large > 0; }
  /// psi_L - phi_L, whose slope over product() is B (Staron & Phillips 2015, eq. 3).
  double excess() const { return large / total - phi_large; }
  double product() const { return phi_large * (1 - phi_large); }  // phi_L phi_S
};

struct FitSettings {
  Component component = Component::yy;
  BasePart base = BasePart::contact_point;
  Population over = Population::automatic;  // what intervals are over
};

/// FormatError, naming the table, where a stress is not finite because a sum was not kept.
std::vector<FitPoint> fit_points(const FitData& data, const PartitionRule& rule,
                                 const FitSettings& settings);

}  // namespace grseg
