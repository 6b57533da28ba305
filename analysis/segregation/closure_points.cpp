// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/segregation/closure_points.hpp"

#include "analysis/fit/row_neighbours.hpp"
#include "analysis/frames/layer_key.hpp"
#include "analysis/frames/runs_of_tables.hpp"
#include "analysis/stress/partial_stress.hpp"
#include "formats/cli/provenance.hpp"
#include "formats/core/errors.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>

namespace grseg {
namespace {

/// The two tables of one run.
struct RunTables {
  const Table* segregation = nullptr;
  const Table* stress = nullptr;
};

std::string inputs_of(const Table& table)
{
  std::string all;
  for (const auto& input : header_values(table, "input")) all += (all.empty() ? "" : ", ") + input;
  return all;
}

void take(const Table*& place, const Table& table, const char* tool)
{
  if (place != nullptr)
    throw UsageError(fmt::format("{} and {} are both tables of {} of the same run ({}); omit one",
                                 place->name, table.name, tool, inputs_of(table)));
  place = &table;
}

}  // namespace

void require_one_density(const Table& table)
{
  if (!table.has_header("mean_density")) return;
  throw UsageError(fmt::format(
      "{}: the grains differ in density (small {:.6g}, large {:.6g} kg/m^{}), but the closure holds "
      "for one density: heavier grains also sink by their weight. grseg-balance has the forces of "
      "such grains",
      table.name, table.header_number("density_S"), table.header_number("density_L"),
      dimension_of(table)));
}

namespace {

/// Pairs of tables by run, in the order of the tables of grseg-segregation.
std::vector<RunTables> runs_of(const std::vector<Table>& tables)
{
  std::map<std::string, RunTables> by_input;
  for (const auto& table : tables) {
    require_one_density(table);
    auto& run = by_input[inputs_of(table)];
    if (table.has_column("q_L"))
      take(run.segregation, table, "grseg-segregation");
    else if (table.has_column("Mcp_yy"))
      take(run.stress, table, "grseg-stress");
    else
      throw FormatError(fmt::format(
          "{}: neither q_L of grseg-segregation nor Mcp_yy of grseg-stress is among its columns; "
          "grseg-closure needs such tables of each run",
          table.name));
  }
  std::vector<RunTables> runs;
  for (const auto& table : tables) {
    const auto& run = by_input[inputs_of(table)];
    if (run.segregation != nullptr && run.stress != nullptr) {
      if (run.segregation == &table) runs.push_back(run);
      continue;
    }
    const char* other = run.stress == nullptr ? "grseg-stress" : "grseg-segregation";
    throw UsageError(
        fmt::format("{}: the table of {} of the same run ({}) is not given; make it with the same "
                    "--layer and --window",
                    table.name, other, inputs_of(table)));
  }
  return runs;
}

/// Key of a layer in a window: times and heights, rounded, since archived tables have fewer digits.
/// Rounding is to a power of ten near 1/10000 of the window and of the layer, at most 1e-6 s or m.
using Place = std::tuple<long long, long long, long long, long long>;
Place place_of(const LayerKey& key)
{
  const auto rounded = [](double value, double extent) {
    const double power = std::min(-6.0, std::round(std::log10(extent)) - 4);
    return std::llround(value * std::pow(10, -power));
  };
  const double window = key.end - key.begin, thickness = key.top - key.bottom;
  return {rounded(key.begin, window), rounded(key.end, window), rounded(key.bottom, thickness),
          rounded(key.top, thickness)};
}

/// Numbers of a layer from a row of grseg-segregation; NaN if the table lacks the column.
struct LayerMotion {
  LayerKey key;
  double small = 0, large = 0;  // area or volume of the grains, m^2 or m^3
  double phi = no_number, flux = no_number, gradient = no_number, diffusivity = no_number;
  double mass_small = no_number, mass_large = no_number;  // mass, kg
  double flux_small = no_number, flux_large = no_number;  // sum m v_y^2, J
  double gain_small = no_number, gain_large = no_number;  // gain of momentum along y, N

  double solid() const { return (small + large) / key.volume; }
  double density() const { return (mass_small + mass_large) / key.volume; }
  double k_large() const { return flux_large / key.volume; }
  double k_total() const { return (flux_small + flux_large) / key.volume; }
};

struct MotionColumn {
  const char* name;
  double LayerMotion::*value;
};
constexpr MotionColumn motion_columns[] = {{"phi_L", &LayerMotion::phi},
                                           {"q_L[m/s]", &LayerMotion::flux},
                                           {"dphi_dy[1/m]", &LayerMotion::gradient},
                                           {"D[m^2/s]", &LayerMotion::diffusivity}};
constexpr MotionColumn kinetic_columns[] = {
    {"mass_S[kg]", &LayerMotion::mass_small},  {"mass_L[kg]", &LayerMotion::mass_large},
    {"mvv_S_yy[J]", &LayerMotion::flux_small}, {"mvv_L_yy[J]", &LayerMotion::flux_large},
    {"gain_S_y[N]", &LayerMotion::gain_small}, {"gain_L_y[N]", &LayerMotion::gain_large}};

/// Layers of a table in the order of its rows, without the rows of the whole bed. Sets
/// `has_kinetic` to false if the table lacks a column of kinetic_columns.
std::vector<LayerMotion> motions_of(const Table& table, bool& has_kinetic)
{
  const char* remedy = "a table of grseg-segregation has it";
  const auto keys = read_layer_keys(table, remedy);
  const auto contents = content_columns(species_of(table), dimension_of(table));
  const auto column = [&](const std::string& name) { return find_column(table, name, remedy); };
  const std::size_t small = column(contents[0]), large = column(contents[1]);
  const bool kinetic = std::ranges::all_of(kinetic_columns, [&](const MotionColumn& own) {
    return table.has_column(without_unit(own.name));
  });
  has_kinetic = has_kinetic && kinetic;
  std::vector<std::pair<double LayerMotion::*, std::size_t>> places;
  for (const auto& [name, value] : motion_columns) places.emplace_back(value, column(name));
  for (const auto& [name, value] : kinetic_columns)
    if (kinetic) places.emplace_back(value, column(name));

  std::vector<LayerMotion> motions;
  for (std::size_t row = 0; row < table.rows.size(); ++row) {
    if (std::isnan(keys[row].bottom)) continue;
    auto& motion = motions.emplace_back();
    motion.key = keys[row];
    motion.small = non_negative_cell(table, row, small);
    motion.large = non_negative_cell(table, row, large);
    for (const auto& [value, place] : places) motion.*value = table.rows[row][place];
  }
  return motions;
}

/// Derivative of of(row) along y, from the neighbours of a layer; NaN if one is null.
template <class Row, class Of>
double slope(const Row* below, const Row* above, const Of& of)
{
  if (below == nullptr || above == nullptr) return no_number;
  const auto height = [](const Row& row) { return (row.key.bottom + row.key.top) / 2; };
  return (of(*above) - of(*below)) / (height(*above) - height(*below));
}

/// Row of the layer below (step -1) or above (step 1) in the same window; null if there is none.
template <class Row>
const Row* neighbour(const std::map<Place, Row>& rows, const LayerKey& key, int step)
{
  LayerKey other = key;
  const double thickness = key.top - key.bottom;
  other.bottom += step * thickness;
  other.top += step * thickness;
  const auto found = rows.find(place_of(other));
  return found == rows.end() ? nullptr : &found->second;
}

/// Sets the forces per mass of a layer, m/s^2, from its neighbours. Returns -sigma'/rho, m/s^2.
double add_forces(ClosurePoint& point, const LayerMotion& here, const LayerMotion* below,
                  const LayerMotion* above, double gravity)
{
  point.driving = here.phi * (1 - here.phi) * -gravity;
  const double k = here.k_total(), density = here.density();
  const double k_slope = slope(below, above, [](const LayerMotion& m) { return m.k_total(); });
  const double k_large_slope =
      slope(below, above, [](const LayerMotion& m) { return m.k_large(); });
  const double rate = (here.gain_small + here.gain_large) / here.key.volume;
  if (std::isnan(k_slope + rate)) return -gravity;
  const double share = k > 0 ? here.k_large() / k : here.phi;
  const double fall = -gravity + (k_slope + rate) / density;
  point.driving = here.phi * (1 - here.phi) * fall;
  point.kinetic_push = -(share - here.phi) * k_slope / density;
  point.kinetic_spread = -(k_large_slope - share * k_slope) / density;
  point.inertia = (here.gain_large / here.key.volume - here.phi * rate) / density;
  return fall;
}

/// Sets driving and gradient of the window before, if it ends at the begin of this one.
void add_window_before(ClosurePoint& point, const LayerMotion& here,
                       const std::map<Place, LayerMotion>& motions, double gravity)
{
  LayerKey before = here.key;
  before.end = here.key.begin;
  before.begin -= here.key.end - here.key.begin;
  const auto found = motions.find(place_of(before));
  if (found == motions.end()) return;
  ClosurePoint earlier;
  add_forces(earlier, found->second, neighbour(motions, before, -1), neighbour(motions, before, 1),
             gravity);
  point.driving_before = earlier.driving;
  point.gradient_before = found->second.gradient;
}

/// Contact stress of a layer from a row of grseg-stress.
struct Stress {
  LayerKey key;
  ContactSums<3> sums;
  double total = 0;   // yy component, N/m or Pa
  double within = 0;  // FitPoint::within

  double solid() const { return (sums.content[0] + sums.content[1]) / key.volume; }
  double phi() const { return sums.content[1] / (sums.content[0] + sums.content[1]); }
};

/// `least_solid`: least solid fraction of layers whose differences give gradients.
std::map<Place, Stress> stresses_of(const Table& table, const std::vector<PartitionRule>& rules,
                                    double least_solid)
{
  const ContactSumsReader reader(table, rules);
  const auto keys = read_layer_keys(table, "a table of grseg-stress has it");
  std::vector<Stress> rows;
  for (std::size_t row = 0; row < table.rows.size(); ++row) {
    auto& stress = rows.emplace_back(Stress{keys[row], reader.read(row)});
    stress.sums.volume = keys[row].volume;
    stress.total = partial_stress(stress.sums, PartitionRule{}).total(1, 1);
  }
  const RowNeighbours neighbours(table, keys);
  std::map<Place, Stress> all;
  for (std::size_t row = 0; row < rows.size(); ++row) {
    auto stress = rows[row];
    const auto beside = neighbours.beside(row, [&](std::size_t other) {
      return rows[other].solid() > 0 && rows[other].solid() >= least_solid;
    });
    stress.within = part_within(
        row, beside, [&](std::size_t other) { return rows[other].phi(); },
        [&](std::size_t other) { return rows[other].total; });
    all.emplace(place_of(keys[row]), std::move(stress));
  }
  return all;
}

void add_stress(ClosurePoint& point, const Stress& stress, const std::vector<PartitionRule>& rules)
{
  const double phi = stress.phi();
  point.phi_large = phi;
  point.product = phi * (1 - phi);
  std::vector<double> totals;
  for (const auto& rule : rules) {
    const auto parts = partial_stress(stress.sums, rule);
    const double total = parts.total(1, 1);
    const bool has_share = rule.adds_up() && total > 0;
    point.excess.push_back(has_share ? parts.large()(1, 1) / total - phi - stress.within
                                     : no_number);
    totals.push_back(total);
  }
  point.total_ratio = totals.back() / totals[totals.size() - 2];
}

/// Gravity along y, m/s^2, of the run. Throws UsageError if layers or windows of the two tables
/// differ, and FormatError if gravity is not negative.
double gravity_of(const RunTables& tables)
{
  const auto &segregation = *tables.segregation, &stress = *tables.stress;
  for (const char* key : {"layer", "window"})
    if (!same_setting(header_or(segregation, key, ""), header_or(stress, key, "")))
      throw UsageError(fmt::format(
          "{} and {} differ in '{}'; make both tables of the run with the same --layer and "
          "--window",
          segregation.name, stress.name, key));
  const double gravity = segregation.header_number("gravity_y");
  if (!(gravity < 0))
    throw FormatError(fmt::format(
        "{}: '# gravity_y: {}' must be negative, because the driving force comes from the weight",
        segregation.name, segregation.header_text("gravity_y")));
  return gravity;
}

/// The rows of both tables of a run.
struct RunRows {
  std::map<Place, LayerMotion> motions;
  std::map<Place, Stress> stresses;
  std::map<Span, double> shear_rates;  // empty: not in the table
  LengthUnits units;
  double gravity;
};

ClosurePoint point_of(const LayerMotion& motion, const Stress& stress, const RunRows& rows,
                      const std::vector<PartitionRule>& rules)
{
  const auto& key = motion.key;
  const auto& [motions, stresses, shear_rates, units, gravity] = rows;
  ClosurePoint point;
  point.frames = key.frames;
  point.weight = key.frames * (motion.small + motion.large);
  point.flux = motion.flux;
  point.gradient = motion.gradient;
  point.diffusivity = motion.diffusivity;
  point.diameter = (1 - motion.phi) * units.small_diameter + motion.phi * units.large_diameter;
  if (const auto found = shear_rates.find({key.begin, key.end}); found != shear_rates.end())
    point.shear_rate = found->second;
  const double fall =
      add_forces(point, motion, neighbour(motions, key, -1), neighbour(motions, key, 1), gravity);
  add_window_before(point, motion, motions, gravity);
  add_stress(point, stress, rules);
  const double lost = -slope(neighbour(stresses, key, -1), neighbour(stresses, key, 1),
                             [](const Stress& s) { return s.total; });
  point.weight_above = lost / (motion.density() * fall);
  return point;
}

bool is_usable(const ClosurePoint& point, const LayerMotion& motion, Instruments instruments)
{
  const bool lacks_neighbour = !std::isnan(motion.density()) && std::isnan(point.kinetic_push);
  const bool lacks_before = instruments == Instruments::previous &&
                            std::isnan(point.driving_before + point.gradient_before);
  return !lacks_neighbour && !lacks_before && point.weight > 0 &&
         std::isfinite(point.flux + point.driving + point.gradient) && point.product > 0 &&
         std::isfinite(point.excess.back());
}

/// Adds the points of a run to `data`, and the window of each point to `windows`.
void read_run(const RunTables& tables, const std::vector<PartitionRule>& rules,
              const ClosureFilter& filter, std::vector<TableWindow>& windows, ClosureData& data)
{
  const auto& segregation = *tables.segregation;
  const LengthUnits units{segregation.header_positive("small_diameter"),
                          segregation.header_positive("large_diameter")};
  RunRows rows{{}, {}, {}, units, gravity_of(tables)};
  if (segregation.has_column("shear_rate")) rows.shear_rates = shear_rates_of(segregation);
  const auto list = motions_of(segregation, data.has_kinetic);
  const auto layers = listed(list, [](const LayerMotion& motion) {
    return LayerSolid{motion.key, motion.solid()};
  });
  const auto range = filter.range(units, layers);
  for (const auto& motion : list) rows.motions.emplace(place_of(motion.key), motion);
  rows.stresses = stresses_of(*tables.stress, rules, range.least_solid);

  data.rows += list.size();
  for (const auto& motion : list) {
    const auto& key = motion.key;
    if (!range.holds_window(key) || !range.holds_layer(key) ||
        !(motion.solid() >= range.least_solid))
      continue;
    const auto stress = rows.stresses.find(place_of(key));
    if (stress == rows.stresses.end())
      throw UsageError(fmt::format(
          "{}: there is no row for the layer from {:g} to {:g} m from {:g} to {:g} s, which "
          "{} has; make both tables of the run with the same --begin and --end",
          tables.stress->name, key.bottom, key.top, key.begin, key.end, segregation.name));
    auto point = point_of(motion, stress->second, rows, rules);
    if (!is_usable(point, motion, filter.instruments)) continue;
    windows.push_back({tables.segregation, {key.begin, key.end}});
    data.points.push_back(std::move(point));
  }
}

/// Numbers the windows of all points, run after run. Windows of all tables of one run are numbered
/// in order of time.
void number_windows(const std::vector<TableWindow>& window_of_point,
                    const std::map<const Table*, std::size_t>& run_of, ClosureData& data)
{
  std::map<std::size_t, std::vector<TableWindow>> of_run;
  std::map<std::pair<const Table*, Span>, std::size_t> numbers;
  for (const auto& window : window_of_point)
    if (numbers.emplace(std::pair(window.table, window.span), 0).second)
      of_run[run_of.at(window.table)].push_back(window);
  std::size_t first = 0;
  for (const auto& [run, windows] : of_run) {
    const auto line = put_in_line(windows);
    for (std::size_t k = 0; k < windows.size(); ++k)
      numbers[{windows[k].table, windows[k].span}] = first + line.number[k];
    first += line.count;
    data.runs.push_back(line.count);
  }
  for (std::size_t k = 0; k < data.points.size(); ++k)
    data.points[k].window = numbers[{window_of_point[k].table, window_of_point[k].span}];
}

}  // namespace

// sigma_L and sigma are linear in the share, so psi_L is the mean of its values at 0 and 1 with the
// weights (1 - p) sigma(0) and p sigma(1).
double ClosurePoint::excess_at(double share) const
{
  const double of_all = share * total_ratio;
  return ((1 - share) * excess.end()[-2] + of_all * excess.back()) / (1 - share + of_all);
}

double ClosurePoint::slope_of_excess(double share) const
{
  const double total = 1 - share + share * total_ratio;
  return total_ratio * (excess.back() - excess.end()[-2]) / (total * total);
}

ClosureData read_closure(const std::vector<Table>& tables, const std::vector<PartitionRule>& rules,
                         const ClosureFilter& filter)
{
  const auto runs = runs_of(tables);
  const auto segregation = listed(runs, [](const RunTables& run) { return *run.segregation; });
  const auto distinct = find_runs(segregation);
  std::map<const Table*, std::size_t> run_of;
  for (std::size_t k = 0; k < runs.size(); ++k) run_of[runs[k].segregation] = distinct.run[k];
  auto read = rules;
  for (const double share : {0.0, 1.0}) read.push_back({PartitionRule::Kind::uniform, share});
  ClosureData data;
  data.instruments = filter.instruments;
  data.doubt = distinct.doubt(segregation);
  std::vector<TableWindow> windows;
  for (const auto& run : runs) read_run(run, read, filter, windows, data);
  number_windows(windows, run_of, data);
  if (data.points.empty())
    throw RunError(
        fmt::format("none of {} rows is left; the closure needs layers that contain both species "
                    "and have neighbours; choose other --begin, --end, --heights or --min-solid",
                    data.rows));
  return data;
}

std::map<Span, double> shear_rates_of(const Table& table)
{
  const char* remedy = "a table of grseg-segregation has it";
  const auto keys = read_layer_keys(table, remedy);
  const auto column = find_column(table, "shear_rate[1/s]", remedy);
  std::map<Span, double> rates;
  for (std::size_t row = 0; row < table.rows.size(); ++row)
    if (std::isnan(keys[row].bottom))
      rates[{keys[row].begin, keys[row].end}] = std::abs(table.rows[row][column]);
  return rates;
}

}  // namespace grseg
