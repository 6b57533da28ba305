// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/fit/fit_data.hpp"

#include "analysis/fit/cells_inside.hpp"
#include "analysis/frames/composition.hpp"
#include "analysis/frames/grouping.hpp"
#include "analysis/frames/layer_key.hpp"
#include "analysis/frames/runs_of_tables.hpp"
#include "analysis/stress/kinetic_stress.hpp"
#include "analysis/stress/partial_stress.hpp"
#include "formats/core/errors.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <functional>
#include <map>
#include <numeric>
#include <set>
#include <utility>

namespace grseg {
namespace {

using SumsOfRow = std::function<ContactSums<3>(std::size_t)>;

/// Returns a function that reads the kinetic sums of a row as contact sums without mixed contacts.
/// If all grains have one density, the table has no areas or volumes; masses, which have the same
/// ratios, replace them.
SumsOfRow kinetic_sums(const Table& table, const SpeciesList& species)
{
  const auto column = [&table](const std::string& name) {
    return find_column(table, name, "--quantity kinetic needs a table of grseg-kinetic");
  };
  const auto words = column_words(species);
  const int dimension = dimension_of(table);
  std::vector<std::size_t> content, diagonal;  // columns by species; by species and axis
  for (const auto& word : words) {
    const auto name = fmt::format("{}_{}", dimension == 3 ? "volume" : "area", word);
    content.push_back(table.has_column(name) ? table.column(name)
                                             : column(fmt::format("mass_{}[kg]", word)));
    for (const auto& [suffix, row, col] : tensor_components(dimension))
      if (row == col) diagonal.push_back(column(fmt::format("K_{}{}[J]", word, suffix)));
  }
  return [&table, dimension, content, diagonal](std::size_t row) {
    ContactSums<3> sums(content.size());
    auto next = diagonal.begin();
    for (std::size_t k = 0; k < content.size(); ++k) {
      sums.content[k] = non_negative_cell(table, row, content[k]);
      for (int axis = 0; axis < dimension; ++axis)
        sums.of(OwnSum::inside, k)(axis, axis) = finite_cell(table, row, *next++);
    }
    return sums;
  };
}

/// The column with the rate of shear, if the table has one: neither tables of grseg-stress nor
/// annuli have it (LayerFlow::du_dy).
std::optional<std::size_t> shear_column(const Table& table)
{
  const bool map = plane_of(table).has_value();
  if (!map && !header_or(table, "bins", "").empty()) return {};
  const char* const name = map ? "shear_rate" : "du_dy";
  return table.has_column(name) ? std::optional(table.column(name)) : std::nullopt;
}

/// Returns a function that stores the motion of a layer in its row, as far as the table has it: from
/// sums of grseg-stress, or from means and kinetic energies of grseg-kinetic.
std::function<void(FitRow&, std::size_t)> motion_reader(const Table& table,
                                                        const SpeciesList& species)
{
  const auto at = [&table](const std::string& name) {
    return find_column(table, name, "grseg-stress and grseg-kinetic write it");
  };
  const auto sums = motion_columns(dimension_of(table));
  if (table.has_column(without_unit(sums[0])))
    return [&table, u = at(sums[0]), square = at(sums[1])](FitRow& row, std::size_t number) {
      row.u = finite_cell(table, number, u) / row.content();
      row.square = finite_cell(table, number, square) / row.content();
    };
  if (!table.has_column("u") || !table.has_column("v")) return [](FitRow&, std::size_t) {};
  std::vector<std::size_t> masses;
  for (const auto& word : column_words(species))
    masses.push_back(at(fmt::format("mass_{}[kg]", word)));
  return [&table, u = at("u[m/s]"), v = at("v[m/s]"), masses](FitRow& row, std::size_t number) {
    const auto& cells = table.rows[number];
    double mass = 0, energy = 0;
    for (std::size_t k = 0; k < masses.size(); ++k) {
      mass += cells[masses[k]];
      energy += row.sums.of(OwnSum::inside, k).trace();
    }
    row.u = cells[u];
    row.square = cells[u] * cells[u] + cells[v] * cells[v] + energy / mass;
  };
}

std::vector<FitRow> read_rows(const Table& table, const SpeciesList& species, Quantity quantity,
                              const std::vector<PartitionRule>& rules)
{
  SumsOfRow sums;
  if (quantity == Quantity::kinetic)
    sums = kinetic_sums(table, species);
  else
    sums = [reader = ContactSumsReader(table, rules)](std::size_t row) { return reader.read(row); };

  const auto keys = read_keys(table, "a table of grseg-stress or grseg-kinetic has it");
  const bool map = plane_of(table).has_value();
  const auto bottom = map ? 0 : table.column("y0");
  const auto shear = shear_column(table);
  const auto read_motion = motion_reader(table, species);
  std::vector<FitRow> rows;
  rows.reserve(table.rows.size());
  for (std::size_t row = 0; row < table.rows.size(); ++row) {
    if (!map) finite_cell(table, row, bottom);  // these tables have no row for the whole bed
    rows.emplace_back(FitRow{keys[row], sums(row)}).sums.volume = keys[row].volume;
    if (shear) rows.back().shear = std::abs(table.rows[row][*shear]);
    read_motion(rows.back(), row);
  }
  return rows;
}

std::vector<LayerSolid> layers_of(const std::vector<FitRow>& rows)
{
  return listed(rows, [](const FitRow& row) { return LayerSolid{row.key, row.solid()}; });
}

/// The member of FilterCount that counts this row: `used`, or the reason why it is left out.
std::size_t FilterCount::*place_of(const FitRow& row, const SpeciesPair& pair,
                                   const FitFilters& filters, const RowRange& range, bool inside)
{
  using Count = FilterCount;
  const double small = row.sums.content[pair.smaller], large = row.sums.content[pair.larger];
  const double ratio = small / large;
  if (!range.holds_window(row.key)) return &Count::outside_times;
  if (!(small + large > 0) || !(row.key.frames > 0)) return &Count::without_grains;
  if (!(small > 0)) return &Count::without_small;
  if (!(large > 0)) return &Count::without_large;
  if (!inside || !range.holds_layer(row.key)) return &Count::outside_heights;
  if (ratio < filters.ratio_low || ratio > filters.ratio_high) return &Count::outside_ratio;
  if (row.solid() < range.least_solid) return &Count::below_solid;
  if (filters.min_shear > 0 && !(row.shear >= filters.min_shear)) return &Count::below_shear;
  return &Count::used;
}

/// phi_L of a pair of species in a row.
double phi_large(const ContactSums<3>& sums, const SpeciesPair& pair)
{
  const double small = sums.content[pair.smaller], large = sums.content[pair.larger];
  return large / (small + large);
}

/// The sample of one row of a table and one pair of its species.
LayerSample sample_of(const FitRow& row, const SpeciesPair& pair, const SpeciesList& species,
                      int dimension)
{
  const double small = row.sums.content[pair.smaller], large = row.sums.content[pair.larger];
  const double d_small = species[pair.smaller].diameter, d_large = species[pair.larger].diameter;
  const auto size = [dimension](double d) { return dimension == 3 ? d * d * d : d * d; };
  const double rarer = std::min(small / size(d_small), large / size(d_large));
  return {.phi_large = phi_large(row.sums, pair),
          .weight = row.key.frames * rarer,
          .frames = row.key.frames,
          .size_ratio = d_large / d_small,
          .pair = pair,
          .key = row.key};
}

/// Rows of a table that are points, each with its pair of species.
struct UsedRows {
  std::vector<std::pair<const FitRow*, SpeciesPair>> points;
  double least_solid;  // least solid fraction of a row
};

/// True for each row of a table that --heights selects, as far as a range of heights does not tell:
/// cells of a map that are `inside`. Rows outside the times of the filter count as not selected.
std::vector<bool> rows_inside(const FitTable& run, const FitFilters& filters, double small_diameter)
{
  const auto plane = plane_of(*run.table);
  if (!plane || filters.heights != inside_the_bed) return std::vector<bool>(run.rows.size(), true);
  const std::string axes = word_of(*plane, map_planes);
  const auto periodic = header_or(*run.table, "periodic", "");
  const auto goes_on = [&](char axis) { return periodic.find(axis) != std::string::npos; };
  const auto cells = cells_inside(filters.in_times(layers_of(run.rows)),
                                  {{goes_on(axes[0]), goes_on(axes[1])}, plane == MapPlane::rz},
                                  margin_inside * small_diameter);
  auto next = cells.begin();
  return listed(run.rows,
                [&](const FitRow& row) { return filters.holds_window(row.key) && *next++; });
}

/// The rows of a table that a filter selects; maps and annuli have their own meaning of `inside`.
RowRange range_of(const FitTable& run, const FitFilters& filters, const LengthUnits& units)
{
  auto own = filters;
  const auto plane = plane_of(*run.table);
  const bool inside = filters.heights == inside_the_bed, annuli = has_annuli(*run.table);
  if (inside && (plane || annuli)) own.heights = "all";
  if (plane && plane != MapPlane::xy && own.heights != "all")
    throw UsageError(
        fmt::format("--heights {}: {} is a map {}, whose cells have no height; use "
                    "inside or all",
                    own.heights, run.table->name, word_of(*plane, map_planes)));
  const auto layers = layers_of(run.rows);
  auto range = own.range(units, layers);
  if (inside && annuli)
    range.heights = annuli_inside(own.in_times(layers), margin_inside * units.small_diameter);
  return range;
}

UsedRows used_rows(const FitTable& run, const FitFilters& filters,
                   const std::vector<SpeciesPair>& pairs, FilterCount& count)
{
  const auto& table = *run.table;
  const LengthUnits units{table.header_positive("small_diameter"),
                          table.header_positive("large_diameter")};
  if (filters.min_shear > 0 && !shear_column(table))
    throw UsageError(
        fmt::format("--min-shear: {} has no rates of shear; use a table of grseg-kinetic "
                    "by layer, or a map",
                    table.name));
  const auto range = range_of(run, filters, units);
  const auto inside = rows_inside(run, filters, units.small_diameter);
  UsedRows used{{}, range.least_solid};
  for (std::size_t k = 0; k < run.rows.size(); ++k)
    for (const auto& pair : pairs) {
      const auto place = place_of(run.rows[k], pair, filters, range, inside[k]);
      ++count.rows;
      ++(count.*place);
      if (place == &FilterCount::used) used.points.emplace_back(&run.rows[k], pair);
    }
  return used;
}

/// Index, in the series of all runs, of the observation for each window of a table.
using Observations = std::map<std::pair<const Table*, Span>, std::size_t>;

Observations observations_of(const std::vector<FitTable>& tables, const std::vector<UsedRows>& used,
                             FitData& data)
{
  using Run = std::pair<std::size_t, std::size_t>;  // numbers of run and flow
  std::vector<Run> order;
  std::map<Run, std::vector<TableWindow>> windows_of_run;
  for (std::size_t k = 0; k < tables.size(); ++k) {
    const Run run(tables[k].run, tables[k].flow);
    if (!windows_of_run.contains(run)) order.push_back(run);
    auto& windows = windows_of_run[run];
    std::set<Span> spans;
    for (const auto& [row, pair] : used[k].points) spans.insert({row->key.begin, row->key.end});
    for (const auto& span : spans) windows.push_back({tables[k].table, span});
  }
  Observations numbers;
  std::size_t first = 0;
  for (const auto& run : order) {
    const auto& windows = windows_of_run[run];
    if (windows.empty()) continue;
    const auto line = put_in_line(windows);
    for (std::size_t k = 0; k < windows.size(); ++k)
      numbers[{windows[k].table, windows[k].span}] = first + line.number[k];
    first += line.count;
    data.still += line.still;
    data.runs.push_back(line.count);
    data.flows.push_back(run.second);
  }
  return numbers;
}

void add_samples(const FitTable& run, const UsedRows& used, const Observations& observations,
                 FitData& data)
{
  data.tables.push_back(run.table->name);
  const auto first = data.rows.size();
  for (const auto& row : run.rows) data.rows.push_back(row.sums);
  const RowNeighbours neighbours(*run.table, listed(run.rows, &FitRow::key));
  for (const auto& [row, pair] : used.points) {
    if (data.samples.empty()) data.window = row->key.end - row->key.begin;
    auto& sample = data.samples.emplace_back(sample_of(*row, pair, run.species, data.dimension));
    sample.window = observations.at({run.table, {row->key.begin, row->key.end}});
    sample.table = data.tables.size() - 1;
    const auto k = static_cast<std::size_t>(row - run.rows.data());
    sample.row = first + k;
    sample.beside = neighbours.beside(k, [&, &pair = pair](std::size_t other) {
      const auto& content = run.rows[other].sums.content;
      return content[pair.smaller] + content[pair.larger] > 0 &&
             run.rows[other].solid() >= used.least_solid;
    });
    for (auto& rows : sample.beside)
      rows.renumber([first](std::size_t number) { return first + number; });
  }
}

std::string bins_in_words(const Table& table)
{
  const auto plane = plane_of(table);
  return plane ? fmt::format("the cells of a map ({})", word_of(*plane, map_planes)) : "layers";
}

void require_alike(const FitTable& a, const FitTable& b)
{
  const auto names_a = names_of(a.species), names_b = names_of(b.species);
  if (names_a != names_b && names_a.size() + names_b.size() > 4)
    throw FormatError(fmt::format("{} and {} have different species ({}; {}); fit them separately",
                                  a.table->name, b.table->name, fmt::join(names_a, ", "),
                                  fmt::join(names_b, ", ")));
  if (dimension_of(*a.table) != dimension_of(*b.table))
    throw FormatError(
        fmt::format("{} is of a run in {} dimensions and {} of a run in {}; fit them "
                    "separately",
                    a.table->name, dimension_of(*a.table), b.table->name, dimension_of(*b.table)));
  if (plane_of(*a.table) != plane_of(*b.table))
    throw FormatError(fmt::format("{} has {} and {} has {}; fit them separately", a.table->name,
                                  bins_in_words(*a.table), b.table->name, bins_in_words(*b.table)));
}

}  // namespace

std::vector<SpeciesPair> all_pairs(std::size_t species)
{
  std::vector<SpeciesPair> pairs;
  for (std::size_t b = 1; b < species; ++b)
    for (std::size_t a = 0; a < b; ++a) pairs.push_back({a, b});
  return pairs;
}

double FitRow::content() const
{
  return std::accumulate(sums.content.begin(), sums.content.end(), 0.0);
}

std::size_t FitData::number_of_flows() const
{
  return std::max<std::size_t>(1, std::set(flows.begin(), flows.end()).size());
}

std::vector<std::size_t> FitData::flows_of_windows() const
{
  std::vector<std::size_t> all;
  for (std::size_t run = 0; run < runs.size(); ++run)
    all.insert(all.end(), runs[run], flow_of(run));
  return all;
}

std::string FilterCount::sentence() const
{
  std::string text = fmt::format("{} rows", rows);
  for (const auto& [number, why] : {std::pair{outside_times, "outside --begin and --end"},
                                    {without_grains, "without grains"},
                                    {without_small, "without small grains"},
                                    {without_large, "without large grains"},
                                    {outside_heights, "outside --heights"},
                                    {outside_ratio, "outside --ratio-range"},
                                    {below_solid, "below --min-solid"},
                                    {below_shear, "below --min-shear"}})
    if (number > 0) text += fmt::format(", {} {}", number, why);
  return text;
}

std::vector<FitTable> read_fit_tables(const std::vector<Table>& tables, Quantity quantity,
                                      const std::vector<PartitionRule>& rules)
{
  std::vector<FitTable> all;
  for (const auto& table : tables) {
    const auto species = species_of(table);
    all.push_back({&table, species, read_rows(table, species, quantity, rules)});
    require_alike(all.front(), all.back());
  }
  const auto runs = find_runs(tables);
  for (std::size_t k = 0; k < all.size(); ++k) all[k].run = runs.run[k];
  return all;
}

std::vector<std::vector<std::string>> tables_of_shared_runs(const std::vector<FitTable>& tables)
{
  std::map<std::pair<std::size_t, std::size_t>, std::vector<std::string>> names;
  for (const auto& one : tables) names[{one.run, one.flow}].push_back(one.table->name);
  std::erase_if(names, [](const auto& of_run) { return of_run.second.size() < 2; });
  return listed(names, [](const auto& of_run) { return of_run.second; });
}

FitData select_fit_data(const std::vector<FitTable>& tables, Quantity quantity,
                        const FitFilters& filters, const std::vector<SpeciesPair>& pairs)
{
  FitData data;
  data.quantity = quantity;
  data.dimension = dimension_of(*tables.front().table);
  data.species = tables.front().species;
  const auto used = listed(
      tables, [&](const FitTable& table) { return used_rows(table, filters, pairs, data.count); });
  const auto observations = observations_of(tables, used, data);
  for (std::size_t k = 0; k < tables.size(); ++k)
    add_samples(tables[k], used[k], observations, data);
  if (data.samples.empty()) {
    const auto& count = data.count;
    const bool one_species =
        count.without_small + count.without_large > 0 &&
        count.outside_heights + count.outside_ratio + count.below_solid + count.below_shear == 0;
    const bool shallow = filters.heights == inside_the_bed && count.outside_heights > 0 &&
                         count.outside_ratio + count.below_solid + count.below_shear == 0;
    throw RunError(fmt::format(
        "no usable points: {}{}", count.sentence(),
        one_species ? "; B needs layers that contain both species"
        : shallow
            ? "; the bed is too shallow to leave out 4 d_S at its base and under its surface: use "
              "--heights all, or make the table with a smaller --layer"
            : ""));
  }
  return data;
}

namespace {

/// The chosen component of the stresses of two species, N/m (3D: Pa).
struct PairStress {
  double small, large, total;
};

}  // namespace

std::vector<FitPoint> fit_points(const FitData& data, const PartitionRule& rule,
                                 const FitSettings& settings)
{
  const auto stresses = listed(data.rows, [&](const ContactSums<3>& sums) {
    return partial_stress(sums, rule, settings.base);
  });
  const auto stress_of = [&](std::size_t row, const SpeciesPair& pair) {
    const auto of = [&](const Tensor3& stress) {
      return settings.component == Component::yy ? stress(1, 1) : stress.trace() / data.dimension;
    };
    const auto& stress = stresses[row];
    const double small = of(stress.of_species[pair.smaller]),
                 large = of(stress.of_species[pair.larger]);
    return PairStress{small, large,
                      stress.of_species.size() == 2 ? of(stress.total) : small + large};
  };
  std::vector<FitPoint> points;
  points.reserve(data.samples.size());
  for (const auto& sample : data.samples) {
    const auto [small, large, total] = stress_of(sample.row, sample.pair);
    if (!std::isfinite(small + large + total))
      throw FormatError(fmt::format(
          "{}: the stress ({}) by {} is not finite: the table left out a sum that it needs "
          "(see the line '# not kept: ...'), or a sum is too large; make the table again",
          data.tables[sample.table], word_of(settings.component, components), rule.name()));
    points.push_back({sample.window, sample.phi_large, sample.weight, sample.frames,
                      sample.size_ratio, small, large, total});
    if (settings.thickness == Thickness::removed)
      points.back().within = part_within(
          sample.row, sample.beside,
          [&](std::size_t row) { return phi_large(data.rows[row], sample.pair); },
          [&](std::size_t row) { return stress_of(row, sample.pair).total; });
  }
  return points;
}

Population resolved(Population over, std::size_t runs, std::size_t flows)
{
  if (over != Population::automatic) return over;
  if (flows > 1) return Population::flows;
  return runs > 1 ? Population::runs : Population::windows;
}

std::string estimand_words(Population over, std::size_t flows)
{
  switch (over) {
    case Population::automatic:
      break;
    case Population::windows:
      return "B of these runs, if they had lasted longer; from the scatter of windows inside runs, so "
             "it does not include how other runs would differ";
    case Population::runs:
      return "B of one flow, over all its runs; from the scatter of runs";
    case Population::flows:
      return fmt::format(
          "B of these {} flows, weighted as they are (by frames x phi_L phi_S), over all their runs; "
          "from the scatter of runs within flows",
          flows);
  }
  return {};
}

}  // namespace grseg
