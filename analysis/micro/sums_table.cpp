// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/micro/sums_table.hpp"

#include "analysis/frames/flow_of_table.hpp"
#include "analysis/frames/layer_key.hpp"
#include "analysis/frames/runs_of_tables.hpp"
#include "analysis/frames/sums.hpp"
#include "analysis/micro/derived_quantities.hpp"
#include "formats/cli/output.hpp"
#include "formats/cli/words.hpp"
#include "formats/core/errors.hpp"
#include "formats/core/frame.hpp"
#include "formats/core/length.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

namespace grseg {
namespace {

double number_or_unknown(const Table& table, const std::string& key)
{
  return table.header_text(key) == "unknown" ? no_number : table.header_number(key);
}

/// Sets `bed_height` of all rows. Windows are recognized by their begin.
template <int D>
void set_bed_heights(std::vector<SumsRow<D>>& rows)
{
  std::map<double, double> height_at;
  for (const auto& row : rows)
    if (row.is_bed()) height_at[row.begin] = row.heights.bed;
  for (auto& row : rows) {
    const auto found = height_at.find(row.begin);
    row.bed_height = found == height_at.end() ? no_number : found->second;
  }
}

enum class SumKind { any, not_negative, may_be_nan };

struct SumColumn {
  std::optional<std::size_t> column;  // number of the column; nothing if it was not kept
  SumKind kind;
};

SumKind kind_of(const std::string& name)
{
  const auto begins = [&](const char* word) { return name.starts_with(word); };
  if (begins("n_slide")) return SumKind::may_be_nan;  // if friction is unknown
  if (begins("area_") || begins("volume_") || begins("grains_") || begins("ends_") || begins("n_"))
    return SumKind::not_negative;
  return SumKind::any;
}

double value_of(const Table& table, std::size_t row, const SumColumn& sum)
{
  if (!sum.column) return no_number;
  if (sum.kind == SumKind::may_be_nan) return table.rows[row][*sum.column];
  constexpr double round_off = 1e-15;  // tolerated negative area or volume, m^2 or m^3
  return sum.kind == SumKind::any ? finite_cell(table, row, *sum.column)
                                  : non_negative_cell(table, row, *sum.column, round_off);
}

}  // namespace

RunConstants read_run_constants(const Table& table)
{
  const auto species = species_of(table);
  if (species.size() != 2)
    throw FormatError(fmt::format("{}: grseg-derive compares two species, but the table has {}",
                                  table.name, species.size()));
  const bool densities_differ = table.has_header("mean_density");
  return {.small_diameter = species[0].diameter,
          .large_diameter = species[1].diameter,
          .gravity_x = table.header_number("gravity_x"),
          .gravity_y = table.header_number("gravity_y"),
          .density = number_or_unknown(table, densities_differ ? "density_S" : "density"),
          .friction = number_or_unknown(table, "friction"),
          .gravity_z = dimension_of(table) == 3 ? table.header_number("gravity_z") : 0,
          .mean_density = number_or_unknown(table, densities_differ ? "mean_density" : "density")};
}

template <int D>
std::vector<SumsRow<D>> read_sums_rows(const Table& table)
{
  const char* remedy = "grseg-derive needs a table of grseg-micro";
  std::vector<SumColumn> sums;
  for (const auto& name : columns_of(StructureSums<D>{}.cells()))
    sums.push_back({find_kept_column(table, name, remedy), kind_of(name)});
  const auto keys = read_layer_keys(table, remedy);
  std::vector<std::size_t> of_heights;
  for (const auto& name : columns_of(cells(BedHeights{})))
    of_heights.push_back(find_column(table, name, remedy));

  std::vector<SumsRow<D>> rows;
  rows.reserve(table.rows.size());
  for (std::size_t r = 0; r < table.rows.size(); ++r) {
    const auto& numbers = table.rows[r];
    const auto values = listed(sums, [&](const SumColumn& sum) { return value_of(table, r, sum); });
    rows.push_back({keys[r],
                    StructureSums<D>::from_values(values),
                    {numbers[of_heights[0]], numbers[of_heights[1]], numbers[of_heights[2]]},
                    no_number});
  }
  set_bed_heights(rows);
  return rows;
}

template std::vector<SumsRow<2>> read_sums_rows(const Table&);
template std::vector<SumsRow<3>> read_sums_rows(const Table&);

namespace {

/// True if two rows have the same layer up to round-off; 1.4 times 5 mm is not exactly 7 mm.
template <int D>
bool same_layer(const SumsRow<D>& a, const SumsRow<D>& b)
{
  const double round_off = 1e-9 * (a.top - a.bottom);
  return std::abs(a.bottom - b.bottom) <= round_off && std::abs(a.top - b.top) <= round_off;
}

/// Mean of rows, weighted by frames.
template <int D>
SumsRow<D> merged(const std::vector<SumsRow<D>>& rows)
{
  const auto& first = rows.front();
  SumsRow<D> mean{{first.begin, first.end, first.bottom, first.top}, {}, {0, 0, 0}, 0};
  for (const auto& row : rows) {
    mean.frames += row.frames;
    mean.volume += row.frames * row.volume;
    mean.sums += row.sums * row.frames;
    mean.heights += row.heights * row.frames;
    mean.bed_height += row.frames * row.bed_height;
    mean.begin = std::min(mean.begin, row.begin);
    mean.end = std::max(mean.end, row.end);
    if (!same_layer(row, first)) mean.bottom = mean.top = no_number;
  }
  mean.volume /= mean.frames;
  mean.sums = mean.sums / mean.frames;
  mean.heights = mean.heights / mean.frames;
  mean.bed_height /= mean.frames;
  return mean;
}

/// Key of a row; rows with equal keys are merged. The whole bed has the largest key and comes last.
template <int D>
double pool_key(const SumsRow<D>& row, Pool pool)
{
  if (pool == Pool::composition) return std::min(std::floor(10 * row.sums.phi_large()), 9.0);
  // The number of the layer, rounded, so that round-off does not change it.
  return row.is_bed() ? std::numeric_limits<double>::infinity()
                      : std::round(row.bottom / (row.top - row.bottom));
}

}  // namespace

template <int D>
std::vector<SumsRow<D>> filtered(std::vector<SumsRow<D>> rows, const RowFilter& filter,
                                 LengthUnits units)
{
  std::vector<LayerSolid> layers;
  for (const auto& row : rows)
    if (!row.is_bed()) layers.push_back({row, row.sums.content() / row.volume});
  const auto range = filter.range(units, layers);
  std::erase_if(rows, [&](const SumsRow<D>& row) {
    return !range.holds_window(row) || !range.holds_layer(row);
  });
  return rows;
}

template <int D>
std::vector<SumsRow<D>> pooled(const std::vector<SumsRow<D>>& rows, Pool pool)
{
  if (pool == Pool::none) return rows;
  std::map<double, std::vector<SumsRow<D>>> pools;
  for (const auto& row : rows) {
    if (pool == Pool::composition && (row.is_bed() || std::isnan(row.sums.phi_large()))) continue;
    pools[pool_key(row, pool)].push_back(row);
  }
  return listed(pools, [](const auto& of_key) { return merged(of_key.second); });
}

template std::vector<SumsRow<2>> filtered(std::vector<SumsRow<2>>, const RowFilter&, LengthUnits);
template std::vector<SumsRow<3>> filtered(std::vector<SumsRow<3>>, const RowFilter&, LengthUnits);
template std::vector<SumsRow<2>> pooled(const std::vector<SumsRow<2>>&, Pool);
template std::vector<SumsRow<3>> pooled(const std::vector<SumsRow<3>>&, Pool);

namespace {

constexpr Choice<ContactForce> force_words[] = {{"modulus", ContactForce::modulus},
                                                {"normal", ContactForce::normal}};
constexpr Choice<ForceAverage> average_words[] = {{"contacts", ForceAverage::contacts},
                                                  {"ends", ForceAverage::ends}};
constexpr Choice<Pool> pool_words[] = {
    {"none", Pool::none}, {"windows", Pool::windows}, {"composition", Pool::composition}};

/// True if grseg-derive offers the rule; other rules need sums that its tables do not have.
bool is_known(const RuleDefinition& rule)
{
  return !rule.sum || rule.sum == PairSum::by_size;
}

std::vector<std::string> known_rules()
{
  return words_of_rule(is_known);
}

PartitionRule rule_of(const DerivedOptions& options)
{
  const auto rule = parse_rule(options.partition);
  if (!is_known(rule.definition()))
    throw UsageError(fmt::format("--partition {}: grseg-derive offers {}", rule.name(),
                                 list_of_words(known_rules())));
  return rule;
}

/// Value of --heights; by default only layers inside the bed are pooled, but a profile has all.
std::string heights_of(const DerivedOptions& options)
{
  if (!options.rows.heights.empty()) return options.rows.heights;
  return options.pool == "composition" ? inside_the_bed : "all";
}

[[noreturn]] void refuse_difference(const Table& first, const Table& other, const char* key)
{
  throw UsageError(fmt::format("{} and {} differ in '{}'; derive from each of them separately",
                               first.name, other.name, key));
}

void require_same_constants(const Table& first, const Table& other)
{
  for (const char* key : {"small_diameter", "large_diameter", "gravity_x", "gravity_y", "density",
                          "friction", "layer", "composition"})
    if (!same_setting(first.header_text(key), other.header_text(key)))
      refuse_difference(first, other, key);
  for (const char* key : {"gravity_z", "species", "mean_density"})  // some tables lack them
    if (!same_setting(header_or(first, key, ""), header_or(other, key, "")))
      refuse_difference(first, other, key);
}

/// Adds the settings of the first table and the options of grseg-derive.
void add_settings(Header& header, const Table& first, const DerivedOptions& options)
{
  for (const auto& line : settings_of(first))
    if (line.first != "preset") header.push_back(line);
  const std::string depth = options.depth.empty() ? "height of the bed" : options.depth;
  header.insert(header.end(), {{"force", options.force},
                               {"average", options.average},
                               {"partition", options.partition},
                               {"depth", depth},
                               {"heights", heights_in_words(heights_of(options))},
                               {"pool", options.pool}});
}

template <int D>
std::vector<SumsRow<D>> read_rows(const std::vector<Table>& tables)
{
  std::vector<SumsRow<D>> rows;
  for (const auto& table : tables) {
    if (dimension_of(table) != D) refuse_difference(tables[0], table, "dimension");
    add_all(rows, read_sums_rows<D>(table));
    require_same_constants(tables[0], table);
  }
  return rows;
}

}  // namespace

void DerivedOptions::add_to(po::options_description& options)
{
  auto add = options.add_options();
  add("force", word_option(&force, words_of(force_words)),
      "force of a contact: modulus (of the force vector) or normal (its normal component)");
  add("average", word_option(&average, words_of(average_words)),
      "mean forces f_S and f_L are over contacts (with at least one grain of the species, each "
      "counted once) or over ends (contact ends on grains of the species)");
  const auto rules = list_of_words(known_rules());
  add("partition", word_option(&partition, known_rules()),
      ("large grain's share of a mixed contact in the pressures P_S and P_L: " + rules).c_str());
  add("pool", word_option(&pool, words_of(pool_words)),
      "rows to merge: none, windows (each layer over all windows) or composition (layers of "
      "similar phi_L)");
  add("depth", po::value(&depth)->value_name("LENGTH"),
      "height H: forces are divided by the pressure at depth H - y (default: height of the bed)");
  add("heights", po::value(&rows.heights)->value_name("y0:y1"),
      fmt::format("layers to use: {} (default: inside with --pool composition, otherwise "
                  "all)",
                  heights_help)
          .c_str());
  rows.add_times_to(options);
}

void DerivedOptions::check() const
{
  choose(pool, "--pool", pool_words);
  RowFilter{rows.begin, rows.end, heights_of(*this)}.check();
  choose(force, "--force", force_words);
  choose(average, "--average", average_words);
  rule_of(*this);
}

Table derived_table(const std::vector<Table>& tables, const DerivedOptions& options,
                    const Header& provenance)
{
  const auto pool = choose(options.pool, "--pool", pool_words);
  DerivedSettings settings{{choose(options.force, "--force", force_words),
                            choose(options.average, "--average", average_words)},
                           rule_of(options),
                           0};
  Table table;
  table.header = provenance;
  add_settings(table.header, tables[0], options);
  with_dimension(dimension_of(tables[0]), [&](auto d) {
    auto rows = read_rows<d>(tables);
    require_one_flow(tables, find_runs(tables).run,
                     pool == Pool::composition ? FlowsApart::by_settings : FlowsApart::by_any);
    const auto constants = read_run_constants(tables[0]);
    const LengthUnits units{constants.small_diameter, constants.large_diameter};
    if (!options.depth.empty()) settings.depth = parse_length(options.depth, "--depth", units);
    const RowFilter filter{options.rows.begin, options.rows.end, heights_of(options)};
    for (const auto& row : pooled(filtered(std::move(rows), filter, units), pool)) {
      const auto derived = derived_quantities(row, constants, settings);
      if (table.columns.empty()) table.columns = with_key_columns(d, columns_of(derived));
      table.rows.push_back(with_key(row, values_of(derived)));
    }
  });
  if (table.rows.empty())
    throw RunError("no row remains; choose another --begin, --end or --heights");
  return table;
}

}  // namespace grseg
