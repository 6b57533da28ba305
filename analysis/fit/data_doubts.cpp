// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/fit/data_doubts.hpp"

#include "analysis/frames/layer_key.hpp"
#include "analysis/frames/runs_of_tables.hpp"
#include "formats/cli/provenance.hpp"
#include "formats/core/text.hpp"

#include <fmt/format.h>

#include <set>
#include <utility>

namespace grseg {
namespace {

/// Warning that two tables of one run belong to different flows; "" if there are none.
std::string doubt_of_flows(const std::vector<FitTable>& tables)
{
  for (const auto& one : tables)
    for (const auto& other : tables)
      if (one.run == other.run && one.flow < other.flow)
        return fmt::format(
            "{} and {} are of different flows, but begin from one bed: intervals over several "
            "flows assume that their errors are independent",
            one.table->name, other.table->name);
  return "";
}

/// Warning that a table is the mean of several runs; "" if there is none.
std::string doubt_of_merged(const std::vector<Table>& tables)
{
  for (const auto& table : tables) {
    std::set<std::string> seeds;
    for (const auto& source : sources_of(table)) seeds.insert(source.seed());
    if (seeds.size() > 1)
      return fmt::format(
          "{} is the mean of {} runs of other seeds, which count as one run here; an interval over "
          "runs needs the table of each",
          printable(table.name), seeds.size());
  }
  return "";
}

/// Warning that layers of a table cross a flow and grains at rest; "" if there is none.
std::string doubt_of_layers(const std::vector<Table>& tables)
{
  constexpr std::pair<const char*, const char*> flows[] = {
      {"drum", "the flowing layer and the bed that turns beneath"},
      {"hopper", "the flow to the outlet and grains at rest beside it"},
      {"column", "grains that slide and grains at rest beneath"}};
  for (const auto& table : tables)
    for (const auto& [geometry, crossed] : flows)
      if (header_or(table, "scene", "").find(fmt::format("geometry = {};", geometry)) !=
              std::string::npos &&
          !plane_of(table) && !has_annuli(table))
        return fmt::format(
            "{} has horizontal layers of a {}, which cross {}: take grseg-stress --bins xy, then "
            "--component pressure here",
            printable(table.name), geometry, crossed);
  return "";
}

}  // namespace

std::vector<std::string> doubts_of_tables(const std::vector<Table>& tables,
                                          const std::vector<FitTable>& read, const FitData& data)
{
  std::vector<std::string> doubts{find_runs(tables).doubt(tables), doubt_of_flows(read),
                                  doubt_of_merged(tables), doubt_of_layers(tables)};
  std::erase(doubts, "");
  if (data.still > 0)
    doubts.push_back(fmt::format(
        "{} of {} windows equal the window before them, because no grain moves; they are not "
        "counted as observations",
        data.still, number_of_windows(data.runs) + data.still));
  return doubts;
}

}  // namespace grseg
