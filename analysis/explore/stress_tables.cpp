// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/explore/stress_tables.hpp"

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

namespace grseg {
namespace {

/// The same sums for several exponents, in one pass over the frames.
template <int D>
struct StressOfPowers {
  std::vector<PartialContactStress<D>> of;  // by exponent

  void add(const Grains& grains, const Frame<D>& frame)
  {
    for (auto& stress : of) stress.add(grains, frame);
  }
  void merge(const StressOfPowers& others)
  {
    for (std::size_t k = 0; k < of.size(); ++k) of[k].merge(others.of[k]);
  }
};

template <int D>
PartialContactStress<D> no_contacts(const FrameLoop& loop, std::optional<double> power)
{
  return {loop.layers(), Assignment::contact_point, power, std::nullopt, loop.species().size()};
}

template <class T>
std::vector<T> joined(std::vector<T> first, const std::vector<T>& second)
{
  first.insert(first.end(), second.begin(), second.end());
  return first;
}

/// Without rows.
template <int D>
Table table_of(const FrameLoop& loop, std::optional<double> power, const std::string& command)
{
  Header settings{{"assign", "contact-point"},
                  {"composition", "clipped"},
                  {"partition", "size"},
                  {"base", "contact-point"},
                  {"volume", "bulk"}};
  if (power) settings.emplace_back("power", format_number(*power));
  const auto& species = loop.species();
  auto table = empty_table(
      loop, command, settings,
      joined(content_columns(species, D), no_contacts<D>(loop, power).columns(species)));
  table.name = loop.run().path();
  return table;
}

template <int D>
StressTables make_tables(FrameLoop& loop, std::span<const double> powers,
                         const std::string& command)
{
  StressTables tables{table_of<D>(loop, std::nullopt, command), {}};
  StressOfPowers<D> none;
  for (const double power : powers) {
    tables.of_powers.push_back(table_of<D>(loop, power, command));
    none.of.push_back(no_contacts<D>(loop, power));
  }
  const Composition<D> no_grains(loop.layers(), GrainArea::clipped, std::nullopt,
                                 loop.species().size());
  for (const auto& window : loop.windows()) {
    const auto [composition, stress, of_powers] =
        loop.sum<D>(window, {.velocity = false, .contacts = true}, no_grains,
                    no_contacts<D>(loop, std::nullopt), none);
    for (std::size_t layer = 0; layer < stress.layers(); ++layer) {
      const auto content = composition.mean(layer);
      const auto row = [&](const PartialContactStress<D>& sums) {
        return table_row(loop, window, layer, joined(content, sums.row(layer)));
      };
      tables.sums.rows.push_back(row(stress));
      for (std::size_t k = 0; k < powers.size(); ++k)
        tables.of_powers[k].rows.push_back(row(of_powers.of[k]));
    }
  }
  return tables;
}

/// The number of the one run that a table was made of: by its digest, or of another file of the same
/// flow by its bed.
std::size_t run_of(const Table& table, const std::vector<RunIdentity>& runs)
{
  const auto program = header_or(table, "program", "");
  const auto name = printable(table.name);
  if (!program.starts_with("grseg-stress ") && !program.starts_with("grseg-merge "))
    throw FormatError(fmt::format(
        "{}: is {}; beside runs only tables of grseg-stress are used", name,
        program.empty() ? "not a table made by grseg" : "a table of " + printable(program)));
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
        "{}: is of the run with the digest {}, and neither that nor its bed is that of a run given; name "
        "that run, make the table anew, or leave it out: sums are then made of the run",
        name, printable(inputs.front())));
  return static_cast<std::size_t>(found - runs.begin());
}

}  // namespace

StressTables make_stress_tables(FrameLoop& loop, std::span<const double> powers,
                                const std::string& command)
{
  StressTables tables;
  with_dimension(loop.dimension(), [&](auto d) { tables = make_tables<d>(loop, powers, command); });
  return tables;
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
      "{}: has the species {}, and the run beside it {}; give both the same --group, --classes or "
      "--edges, or leave the table out",
      printable(table.name), printable(words(of_table)), words(of_run)));
}

}  // namespace grseg
