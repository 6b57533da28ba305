// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/frames/frame_loop.hpp"
#include "analysis/frames/presets.hpp"
#include "analysis/maps/fields.hpp"
#include "analysis/stress/contact_assignment.hpp"
#include "analysis/stress/merge_tables.hpp"
#include "analysis/stress/partial_stress.hpp"
#include "formats/cli/output.hpp"
#include "formats/cli/provenance.hpp"
#include "formats/cli/words.hpp"
#include "formats/core/errors.hpp"
#include "formats/core/frame.hpp"

#include <fmt/format.h>

#include <set>

using namespace grseg;

namespace {

constexpr ToolInfo info{
    "grseg-stress",
    "sums of force (x) branch by layer, window and pair of species: contact stress.",
    "grseg-stress run.h5 [options] > sums.tsv\n       grseg-stress --merge a.tsv b.tsv > sums.tsv",
    "  grseg-stress run.h5 -o sums.tsv                  layers of 4 dS, windows of 1.25 s\n"
    "  grseg-stress run.h5 --assign branch --layer 1dS  thin layers, exact momentum balance\n"
    "  grseg-stress run.h5 --assign gauss --kernel-width 1dS   coarse grained by a Gaussian\n"
    "  grseg-stress drum.h5 --bins radius --layer 2dS   annuli about the axis of a drum\n"
    "  grseg-stress drum.h5 --bins xy --layer 2dS -o map.h5           a map, for h5py or xarray\n"
    "  grseg-stress run.h5 --partition power:2 | grseg-fit - --partition power:2\n"
    "  grseg-stress --merge seed1.tsv seed2.tsv         the sums of two runs as one table\n",
    presets::stress};

struct Settings {
  FrameOptions frames;
  ContactAssignmentOptions assignment;
  std::string base = "contact-point", volume = "bulk", partition = "size";
  bool merge = false, all_windows = false;
};

po::options_description options_into(Settings& s)
{
  po::options_description options("Options");
  s.assignment.add_to(options);
  const auto base = "likewise, the part of contacts with base and walls: " + list_of(base_parts);
  const auto volume = "likewise, the volume of a stress: " + list_of(stress_volumes);
  options.add_options()("partition", word_option(&s.partition, words_of_rule()),
                        "default rule of grseg-fit for this table; power:Q adds columns Mpower_*");
  options.add_options()("base-part", word_option(&s.base, words_of(base_parts)), base.c_str());
  options.add_options()("volume", word_option(&s.volume, words_of(stress_volumes)), volume.c_str());
  options.add_options()("merge", po::bool_switch(&s.merge),
                        "of tables instead of a run: means weighted by frames, window by window");
  options.add_options()("all-windows", po::bool_switch(&s.all_windows),
                        "with --merge: of all windows together");
  s.frames.add_bins_to(options);
  s.frames.add_to(options);
  s.frames.add_parts_to(options);
  return options;
}

/// The choices of --partition, --base-part and --volume, by which maps make stress of sums. A table of
/// layers only passes them on to grseg-fit, except for the exponent of Mpower_*.
MapStress stress_of(Settings& s)
{
  const auto volume = choose(s.volume, "--volume", stress_volumes);
  const auto base = choose(s.base, "--base-part", base_parts);
  const auto rule = parse_rule(s.partition);
  s.partition = rule.name();
  return {rule, base, volume};
}

/// The exponent of Mpower_*, where the rule asks for these columns.
std::optional<double> power_of(const PartitionRule& rule)
{
  if (rule.kind != PartitionRule::Kind::power) return {};
  return rule.value;
}

void require_layers(const Settings& s, const ContactAssignment& chosen)
{
  const bool whole =
      chosen.assignment == Assignment::contact_point || chosen.assignment == Assignment::grain;
  const bool map = s.frames.map().has_value();
  if ((s.frames.annuli() || map) && !whole)
    throw UsageError(
        fmt::format("--assign {} spreads contacts over layers, not over {}; with --bins {} take "
                    "contact-point or grain",
                    s.assignment.assign, map ? "the cells of a map" : "annuli", s.frames.bins));
  if (map && chosen.area != GrainArea::centre)
    throw UsageError(fmt::format(
        "--composition {}: in a map a grain counts to the cell of its centre; take centre",
        s.assignment.composition));
}

template <class T>
std::vector<T> joined(std::vector<T> first, const std::vector<T>& second)
{
  first.insert(first.end(), second.begin(), second.end());
  return first;
}

template <int D>
std::vector<Cell> map_fields(const FrameLoop& loop, const MapStress& how,
                             const std::vector<double>& contents, ContactSums<D> sums,
                             std::size_t cell)
{
  sums.content = contents;
  sums.volume = loop.layers().volume(cell);
  return stress_fields(sums, loop.species(), how);
}

template <int D>
void tabulate(FrameLoop& loop, const Settings& s, const ContactAssignment& chosen,
              const MapStress& how, const std::string& command)
{
  const auto power = power_of(how.rule);
  const bool map = loop.layers().map().has_value();
  std::vector<std::pair<std::string, std::string>> settings{
      {"assign", s.assignment.assign},
      {"composition", s.assignment.composition},
      {"partition", s.partition},
      {"base", s.base},
      {"volume", s.volume}};
  if (power) settings.emplace_back("power", format_number(*power));
  const auto kernel =
      s.assignment.kernel(chosen, {loop.run().small_diameter(), loop.run().large_diameter()});
  if (kernel) settings.emplace_back("width", format_number(kernel->width()));
  const auto& species = loop.species();
  const Composition<D> no_grains(loop.layers(), chosen.area, kernel, species.size());
  const PartialContactStress<D> no_contacts(loop.layers(), chosen.assignment, power, kernel,
                                            species.size());
  auto columns = joined(content_columns(species, D), no_contacts.columns(species));
  if (map)
    columns =
        joined(columns, columns_of(stress_fields(ContactSums<D>(species.size()), species, how)));
  auto table = loop.make_table(command, settings, columns);
  for (const auto& window : loop.windows()) {
    const auto [composition, stress] =
        loop.sum<D>(window, {.velocity = false, .contacts = true}, no_grains, no_contacts);
    for (std::size_t layer = 0; layer < stress.layers(); ++layer) {
      const auto contents = composition.mean(layer);
      auto row = joined(contents, stress.row(layer));
      if (map)
        row = joined(row,
                     values_of(map_fields<D>(loop, how, contents, stress.mean(layer).sums, layer)));
      loop.add(table, loop.row(window, layer, row));
    }
  }
  loop.write(std::move(table), map ? "" : "grseg-fit");
}

void tabulate(Settings s, const po::variables_map& values, const std::string& command)
{
  const auto chosen =
      s.assignment.contact_assignment(values, s.frames.map() ? "centre" : "clipped");
  require_layers(s, chosen);
  const auto how = stress_of(s);
  FrameLoop loop(info, values, s.frames);
  with_dimension(loop.dimension(), [&](auto d) {
    if (d == 3 && s.frames.annuli() && chosen.area == GrainArea::clipped)
      throw UsageError(
          "--bins radius: spheres are not clipped at annuli; take --composition centre");
    tabulate<d>(loop, s, chosen, how, command);
  });
}

void merge(const Settings& s, const po::variables_map& values, const std::string& command)
{
  const std::set<std::string> about_merging{"merge", "all-windows", "input", "output", "overwrite",
                                            "quiet", "json",        "short", "digits"};
  for (const auto& [name, value] : values)
    if (!value.defaulted() && !about_merging.contains(name))
      throw UsageError(
          fmt::format("--{} does not go with --merge: tables keep what they were made with", name));
  s.frames.output.check(values);
  const auto merged = merge_tables(read_tables(values), s.all_windows, info, command);
  write_table(s.frames.output, s.frames.json ? merged.to_json() : merged.to_text());
}

}  // namespace

int main(int argc, char** argv)
{
  Settings settings;
  const auto options = options_into(settings);
  return run_tool(argc, argv, info, options, [&](const po::variables_map& values) {
    const auto command = command_line(argc, argv);
    if (settings.merge) return merge(settings, values, command);
    if (settings.all_windows) throw UsageError("--all-windows goes with --merge");
    tabulate(settings, values, command);
  });
}
