// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/explore/stress_tables.hpp"

#include "analysis/explore/partition_data.hpp"
#include "analysis/frames/composition.hpp"
#include "analysis/frames/table_writer.hpp"
#include "analysis/stress/partial_contact_stress.hpp"
#include "formats/cli/provenance.hpp"
#include "formats/core/errors.hpp"
#include "formats/core/frame.hpp"
#include "formats/core/text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <utility>

namespace grseg {
namespace {

/// Sums with and without an exponent of power:Q, for several exponents, in one pass over the frames.
template <int D>
struct StressOfPowers {
  std::vector<PartialContactStress<D>> of;  // the first without exponent, then by exponent

  void add(const Grains& grains, const Frame<D>& frame)
  {
    for (auto& stress : of) stress.add(grains, frame);
  }
  void merge(const StressOfPowers& others)
  {
    for (std::size_t k = 0; k < of.size(); ++k) of[k].merge(others.of[k]);
  }
};

template <class T>
std::vector<T> joined(std::vector<T> first, const std::vector<T>& second)
{
  first.insert(first.end(), second.begin(), second.end());
  return first;
}

/// Table with its header and no rows. `power` is the exponent Q of power:Q, if any.
Table table_of(const FrameLoop& loop, std::optional<double> power, const std::string& command,
               const std::vector<std::string>& columns)
{
  Header settings{{"assign", "contact-point"},
                  {"composition", "clipped"},
                  {"partition", "size"},
                  {"base", "contact-point"},
                  {"volume", "bulk"}};
  if (power) settings.emplace_back("power", format_number(*power));
  auto table = empty_table(loop, command, settings, columns);
  table.name = loop.run().path();
  return table;
}

template <int D>
StressTables make_tables(FrameLoop& loop, const std::string& command)
{
  const auto& species = loop.species();
  std::vector<std::optional<double>> powers{std::nullopt};
  if (species.size() == 2)
    for (const double node : power_nodes()) powers.emplace_back(node);
  std::vector<Table> tables;
  StressOfPowers<D> none;
  for (const auto power : powers) {
    none.of.emplace_back(loop.layers(), Assignment::contact_point, power, std::nullopt,
                         species.size());
    tables.push_back(table_of(loop, power, command,
                              joined(joined(content_columns(species, D), motion_columns(D)),
                                     none.of.back().columns(species))));
  }
  const Composition<D> no_grains(loop.layers(), GrainArea::clipped, std::nullopt, species.size());
  for (const auto& window : loop.windows()) {
    const auto [composition, stress] =
        loop.sum<D>(window, {.velocity = true, .contacts = true}, no_grains, none);
    for (std::size_t layer = 0; layer < stress.of.front().layers(); ++layer)
      for (std::size_t k = 0; k < tables.size(); ++k)
        tables[k].rows.push_back(table_row(
            loop, window, layer, joined(composition.row(layer), stress.of[k].row(layer))));
  }
  StressTables all{{std::move(tables.front())}, {}};
  for (std::size_t k = 1; k < tables.size(); ++k) all.of_powers.push_back({std::move(tables[k])});
  return all;
}

/// Number of the run from which a table was made: the run with the digest in the table's header, else a run
/// with the same bed, i.e. another file of the same flow.
std::size_t run_of(const Table& table, const std::vector<RunIdentity>& runs)
{
  const auto name = printable(table.name);
  const auto inputs = header_values(table, "input");
  if (inputs.size() != 1)
    throw FormatError(
        fmt::format("{}: is made of {} runs; give tables of one run each", name, inputs.size()));
  const auto bed = header_or(table, "bed", "");
  const bool known_flow = bed.find(", flow ") != std::string::npos;
  auto found = std::find_if(runs.begin(), runs.end(),
                            [&](const RunIdentity& run) { return run.digest == inputs.front(); });
  if (found == runs.end() && known_flow)
    found = std::find_if(runs.begin(), runs.end(),
                         [&](const RunIdentity& run) { return run.bed == bed; });
  if (found == runs.end())
    throw FormatError(fmt::format(
        "{}: is of the run with the digest {}, and no run given has this digest or the same bed; add that "
        "run, make the table again, or leave the table out: its sums are then made from the run",
        name, printable(inputs.front())));
  return static_cast<std::size_t>(found - runs.begin());
}

}  // namespace

StressTables make_stress_tables(FrameLoop& loop, const std::string& command)
{
  return with_dimension(loop.dimension(), [&](auto d) { return make_tables<d>(loop, command); });
}

std::vector<const Table*> tables_of_runs(const std::vector<Table>& tables,
                                         const std::vector<RunIdentity>& runs)
{
  std::vector<const Table*> of_runs(runs.size(), nullptr);
  for (const auto& table : tables) {
    const auto run = run_of(table, runs);
    if (of_runs[run] != nullptr)
      throw UsageError(fmt::format("{} and {} are of the same run; give one of them",
                                   printable(of_runs[run]->name), printable(table.name)));
    of_runs[run] = &table;
  }
  return of_runs;
}

void require_same_species(const Table& table, const SpeciesList& species)
{
  const std::string of_run = names_species(species) ? species_text(species) : "",
                    of_table = header_or(table, "species", "");
  if (of_table == of_run) return;
  const auto words = [](const std::string& text) { return text.empty() ? "small, large" : text; };
  throw UsageError(fmt::format(
      "{}: has the species {}, but its run has {}; give both the same --group, --classes or --edges, or "
      "leave the table out",
      printable(table.name), printable(words(of_table)), words(of_run)));
}

}  // namespace grseg
