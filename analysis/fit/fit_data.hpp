// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/fit/row_neighbours.hpp"
#include "analysis/frames/layer_key.hpp"
#include "analysis/statistics/correlated_windows.hpp"
#include "analysis/stress/contact_sums.hpp"
#include "analysis/stress/partial_stress.hpp"
#include "analysis/stress/partition_rule.hpp"
#include "formats/cli/table.hpp"
#include "formats/cli/words.hpp"
#include "formats/core/species.hpp"

#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace grseg {

/// The statistical population that a 95 % interval refers to, and with it the number that is
/// estimated. Runs that differ only in their seed belong to one flow.
enum class Population {
  automatic,  ///< `windows` for one run, `runs` for several of one flow, `flows` for several
  windows,    ///< these very runs, if they had lasted longer
  runs,       ///< all runs that one flow could have
  flows,      ///< all runs that these flows could have, each flow with its weight in the data
};
inline constexpr Choice<Population> populations[] = {
    {"windows", Population::windows, "these runs, if they had lasted longer"},
    {"runs", Population::runs, "all runs that this flow could have"},
    {"flows", Population::flows, "all runs of these flows, each flow with its weight in the data"}};

/// Replaces Population::automatic by the population for these numbers of runs and flows; returns
/// any other population unchanged.
Population resolved(Population over, std::size_t runs, std::size_t flows);

/// Sentence, without full stop, that names the estimated number and the population; `flows` is the
/// number of flows.
std::string estimand_words(Population over, std::size_t flows);

enum class Quantity { contact, kinetic };
inline constexpr Choice<Quantity> quantities[] = {
    {"contact", Quantity::contact, "tables of grseg-stress"},
    {"kinetic", Quantity::kinetic, "tables of grseg-kinetic"}};
/// Component of the stress tensor that is fitted. pressure: P = (lambda_1 + lambda_2)/2 (Staron &
/// Phillips 2015, below eq. 1), half the trace; in three dimensions a third of the trace.
enum class Component { yy, pressure };
inline constexpr Choice<Component> components[] = {
    {"yy", Component::yy, "normal to the base"},
    {"pressure", Component::pressure, "half the trace, of spheres a third"}};

/// Conditions that a row of a table meets to be a point of the fit.
struct FitFilters : RowFilter {
  double ratio_low = 0.01, ratio_high = 100;  // least and largest phi_S/phi_L
  double min_shear = 0;                       // least rate of shear, 1/s
};

/// Numbers of two species of the tables.
struct SpeciesPair {
  std::size_t smaller = 0, larger = 1;

  bool operator==(const SpeciesPair&) const = default;
};
/// All pairs of this number of species: (0, 1), (0, 2), (1, 2), (0, 3) ...
std::vector<SpeciesPair> all_pairs(std::size_t species);

/// One layer, or one cell of a map, in one window, and two of its species.
struct LayerSample {
  std::size_t window = 0;  // index of the window in the series of all windows, run after run
  double phi_large = 0;    // area or volume of the larger species over the sum of the two species
  double weight = 0;       // frames x grains of the rarer species, up to a constant factor
  double frames = 1;       // number of frames in the window
  double size_ratio = 0;   // nominal diameters, larger over smaller species
  std::size_t table = 0;   // index in FitData::tables
  std::size_t row = 0;     // index in FitData::rows
  std::vector<RowsBeside> beside = {};  // rows beside it, by direction, as indices in FitData::rows
  SpeciesPair pair = {};
  LayerKey key = {};

  double weight_in_b() const { return frames * phi_large * (1 - phi_large); }
};

/// Number of rows that were read, used, and left out for each reason.
struct FilterCount {
  std::size_t rows = 0, outside_times = 0, without_grains = 0, without_small = 0, without_large = 0,
              outside_ratio = 0, below_solid = 0, below_shear = 0, outside_heights = 0, used = 0;

  /// "320 rows, 20 without grains, 5 outside --heights, ...".
  std::string sentence() const;
};

struct FitData {
  Quantity quantity = Quantity::contact;
  int dimension = 2;
  RunLengths runs = {};                 // number of windows with samples in each run
  std::vector<std::size_t> flows = {};  // flow of each run (flows.hpp); empty: one flow
  std::size_t still = 0;                // number of windows left out because no grain moved
  std::vector<std::string> tables;      // names of the tables
  SpeciesList species;                  // species of the first table; all tables use its names
  double window = 0;                    // length of the first window, s
  // Sums of all rows. Kinetic sums have no mixed part, so they are the same under every rule.
  std::vector<ContactSums<3>> rows = {};
  std::vector<LayerSample> samples = {};
  FilterCount count;

  std::size_t flow_of(std::size_t run) const { return flows.empty() ? 0 : flows[run]; }
  std::size_t number_of_flows() const;  // number of flows that have runs, at least 1
  std::vector<std::size_t> flows_of_windows() const;
};

/// Sums of one row of a table, with the window and layer of the row.
struct FitRow {
  LayerKey key;
  ContactSums<3> sums;
  // NaN in empty layers, and where the table has no such column:
  double shear = no_number;   // rate of shear of the mean flow, 1/s: in layers |du/dy|, in a map
                              // MapFlow::shear_rate()
  double u = no_number;       // mean velocity along the layer, m/s
  double square = no_number;  // mean square of the velocity, m^2/s^2

  double content() const;                                   // area, volume or mass of the grains
  double solid() const { return content() / sums.volume; }  // solid fraction of the layer
};

/// The rows of one table and its species.
struct FitTable {
  const Table* table;
  SpeciesList species;
  std::vector<FitRow> rows;
  std::size_t flow = 0;
  std::size_t run = 0;  // number of the run; tables of one run have the same number
};

/// Reads tables of grseg-stress (contact) or grseg-kinetic: by layer, by annulus, or maps. Throws
/// FormatError if a table lacks a column that `rules` need, or has other species or bins than the
/// first table. Throws UsageError if two tables include the same windows of the same run.
std::vector<FitTable> read_fit_tables(const std::vector<Table>& tables, Quantity quantity,
                                      const std::vector<PartitionRule>& rules);

/// Names of the tables of each run that has several. Tables of one bed that flows in two ways, such
/// as down two slopes, are of two runs.
std::vector<std::vector<std::string>> tables_of_shared_runs(const std::vector<FitTable>& tables);

/// Selects the layers and windows of all tables that pass the filters, as samples of `pairs`.
/// Windows of one run and flow are put in order of time, even if they come from several tables
/// (runs_of_tables.hpp). phi is computed from areas or volumes; from masses if a kinetic table has
/// neither, since all species have one density then. Throws UsageError if --heights or --min-shear
/// does not apply to a table, and RunError, with the count of rows per filter, if no row passes.
FitData select_fit_data(const std::vector<FitTable>& tables, Quantity quantity,
                        const FitFilters& filters, const std::vector<SpeciesPair>& pairs);

/// A point of the fit under one partition rule: one layer in one window.
struct FitPoint {
  std::size_t window = 0;
  double phi_large = 0;
  double weight = 0;
  double frames = 1;
  double size_ratio = 0;                   // nominal d_L/d_S
  double small = 0, large = 0, total = 0;  // chosen stress component, N/m (3D: Pa)
  double within = 0;                       // part of psi_L - phi_L by gradients inside the layer

  double ratio() const { return (1 - phi_large) / phi_large; }  // x
  bool has_logarithm() const { return small > 0 && large > 0; }
  /// psi_L - phi_L, whose slope over product() is B (Staron & Phillips 2015, eq. 3).
  double excess() const { return large / total - within - phi_large; }
  double product() const { return phi_large * (1 - phi_large); }  // phi_L phi_S
};

/// Treatment of the part of B that the thickness of layers adds. Where phi_L and the stress sigma
/// both vary in a layer, its means give
///
///   psi_L - phi_L  =  (mean of phi_L sigma)/(mean of sigma) - (mean of phi_L)  =  phi_L' sigma' m/sigma
///
/// even if large grains bear the share phi_L of the stress at every height (B = 0). m is the second
/// moment of the weight with which the mean is taken: h^2/12 for a layer of thickness h, w^2 for a
/// Gaussian of width w, less near an axis (row_neighbours.hpp). The equation is exact for linear
/// profiles. The cells of a map have such a term for each of their two directions.
enum class Thickness { removed, kept };
inline constexpr Choice<Thickness> thicknesses[] = {
    {"removed", Thickness::removed,
     "take out what gradients inside a layer add, from differences to the next layers"},
    {"kept", Thickness::kept, "B of the layers' means"}};

struct FitSettings {
  Component component = Component::yy;
  BasePart base = BasePart::contact_point;
  Population over = Population::automatic;  // population of the intervals
  Thickness thickness = Thickness::removed;
};

/// Points of the fit, in the order of data.samples. Throws FormatError, which names the table, if a
/// stress is not finite because the table left out a sum.
std::vector<FitPoint> fit_points(const FitData& data, const PartitionRule& rule,
                                 const FitSettings& settings);

}  // namespace grseg
