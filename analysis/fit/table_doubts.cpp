// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/fit/table_doubts.hpp"

#include "analysis/frames/runs_of_tables.hpp"

#include <fmt/format.h>

#include <utility>

namespace grseg {
namespace {

/// Where tables of one run are of several flows.
std::string doubt_of_flows(const std::vector<FitTable>& tables)
{
  for (const auto& one : tables)
    for (const auto& other : tables)
      if (one.run == other.run && one.flow < other.flow)
        return fmt::format(
            "{} and {} are of different flows, but begin from one bed: what is over several "
            "flows takes their errors for independent",
            one.table->name, other.table->name);
  return "";
}

std::string doubt_of_stillness(const FitData& data)
{
  if (data.still == 0) return "";
  return fmt::format(
      "{} of {} windows hold the same as the one before them, since nothing moves, and are no "
      "observations of their own",
      data.still, number_of_windows(data.runs) + data.still);
}

}  // namespace

std::vector<std::string> doubts_of_tables(const std::vector<Table>& tables,
                                          const std::vector<FitTable>& read, const FitData& data)
{
  std::vector<std::string> doubts;
  for (auto&& doubt :
       {find_runs(tables).doubt(tables), doubt_of_flows(read), doubt_of_stillness(data)})
    if (!doubt.empty()) doubts.push_back(doubt);
  return doubts;
}

}  // namespace grseg
