// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/micro/derived_table.hpp"

#include "analysis/frames/layer_table.hpp"
#include "analysis/frames/runs_of_tables.hpp"
#include "analysis/micro/derived_quantities.hpp"
#include "analysis/micro/sums_table.hpp"
#include "formats/cli/output.hpp"
#include "formats/cli/provenance.hpp"
#include "formats/cli/words.hpp"
#include "formats/core/errors.hpp"
#include "formats/core/frame.hpp"
#include "formats/core/length.hpp"

#include <fmt/format.h>

namespace grseg {
namespace {

constexpr Choice<ContactForce> force_words[] = {{"modulus", ContactForce::modulus},
                                                {"normal", ContactForce::normal}};
constexpr Choice<ForceAverage> average_words[] = {{"contacts", ForceAverage::contacts},
                                                  {"ends", ForceAverage::ends}};
constexpr Choice<Pool> pool_words[] = {
    {"none", Pool::none}, {"windows", Pool::windows}, {"composition", Pool::composition}};

/// The others need sums that are not in this table.
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
    throw UsageError(fmt::format("--partition {}: grseg-derive takes {}", rule.name(),
                                 list_of_words(known_rules())));
  return rule;
}

/// Heights: a profile has all layers, what pools them those inside the bed.
std::string heights_of(const DerivedOptions& options)
{
  if (!options.heights.empty()) return options.heights;
  return options.pool == "composition" ? inside_the_bed : "all";
}

RowFilter filter_of(const DerivedOptions& options)
{
  RowFilter filter;
  filter.begin = options.begin.value_or(filter.begin);
  filter.end = options.end.value_or(filter.end);
  filter.heights = heights_of(options);
  return filter;
}

[[noreturn]] void refuse_difference(const Table& first, const Table& other, const char* key)
{
  throw UsageError(fmt::format("{} and {} differ in '{}'; derive from each of them separately",
                               first.name, other.name, key));
}

void require_same_dimension(const Table& first, const Table& other)
{
  if (dimension_of(first) != dimension_of(other)) refuse_difference(first, other, "dimension");
}

void require_same_constants(const Table& first, const Table& other)
{
  for (const char* key : {"small_diameter", "large_diameter", "gravity_x", "gravity_y", "density",
                          "friction", "layer", "composition"})
    if (!same_setting(first.header_text(key), other.header_text(key)))
      refuse_difference(first, other, key);
  for (const char* key : {"gravity_z", "species", "mean_density"})  // not in all tables
    if (!same_setting(header_or(first, key, ""), header_or(other, key, "")))
      refuse_difference(first, other, key);
}

/// The settings of the first table, and those of what is derived.
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
void add_row(Table& table, const SumsRow<D>& row, const std::vector<Cell>& derived)
{
  if (table.columns.empty()) table.columns = with_key_columns(D, columns_of(derived));
  table.rows.push_back(with_key({row.begin, row.end, row.bottom, row.top, row.frames, row.volume},
                                values_of(derived)));
}

template <int D>
std::vector<SumsRow<D>> read_rows(const std::vector<Table>& tables)
{
  std::vector<SumsRow<D>> rows;
  for (const auto& table : tables) {
    require_same_dimension(tables[0], table);
    const auto more = read_sums_rows<D>(table);
    require_same_constants(tables[0], table);
    rows.insert(rows.end(), more.begin(), more.end());
  }
  return rows;
}

}  // namespace

void DerivedOptions::add_to(po::options_description& options)
{
  auto add = options.add_options();
  add("force", word_option(&force, words_of(force_words)),
      "the force of a contact, modulus or normal (its normal part)");
  add("average", word_option(&average, words_of(average_words)),
      "f_S and f_L are means over contacts (with at least one such grain, each counted once) or over "
      "ends (contact ends on such grains)");
  const auto rules = list_of_words(known_rules());
  add("partition", word_option(&partition, known_rules()),
      ("the large grain's share of a mixed contact in P_S and P_L: " + rules).c_str());
  add("pool", word_option(&pool, words_of(pool_words)),
      "which rows to merge: none, windows (each layer over all windows) or composition (layers by "
      "phi_L)");
  add("depth", po::value(&depth)->value_name("LENGTH"),
      "H of the pressure at H - y by which forces are divided (default: height of the bed)");
  add("heights", po::value(&heights)->value_name("y0:y1"),
      fmt::format("layers that take part: {} (default: inside of layers that are pooled by "
                  "composition, else all)",
                  heights_help)
          .c_str());
  add("begin", time_option(begin), "no window that begins before this (default: all)");
  add("end", time_option(end), "no window that ends after this (default: all)");
}

void DerivedOptions::check() const
{
  choose(pool, "--pool", pool_words);
  if (!heights.empty()) check_heights(heights);
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
    find_runs(tables);
    const auto constants = read_run_constants(tables[0]);
    const LengthUnits units{constants.small_diameter, constants.large_diameter};
    if (!options.depth.empty()) settings.depth = parse_length(options.depth, "--depth", units);
    for (const auto& row : pooled(filtered(std::move(rows), filter_of(options), units), pool))
      add_row(table, row, derived_quantities(row, constants, settings));
  });
  if (table.rows.empty())
    throw RunError("no row is left; choose another --begin, --end or --heights");
  return table;
}

}  // namespace grseg
