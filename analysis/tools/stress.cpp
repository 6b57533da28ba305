// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/coarse_graining.hpp"
#include "analysis/composition.hpp"
#include "analysis/frame_loop.hpp"
#include "analysis/merge_tables.hpp"
#include "analysis/partial_contact_stress.hpp"
#include "analysis/partition.hpp"
#include "analysis/presets.hpp"
#include "formats/errors.hpp"
#include "formats/length.hpp"

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
    "  grseg-stress run.h5 --assign gauss --width 1dS   coarse grained by a Gaussian\n"
    "  grseg-stress drum.h5 --bins radius --layer 2dS   annuli about the axis of a drum\n"
    "  grseg-stress run.h5 --partition power:2 | grseg-fit - --partition power:2\n"
    "  grseg-stress --merge seed1.tsv seed2.tsv         the sums of two runs as one table\n",
    presets::stress};

struct Settings {
  FrameOptions frames;
  std::string assign = "contact-point", width = "1dS", composition, base = "contact-point",
              volume = "bulk", partition = "size";
  bool merge = false, all_windows = false;
};

po::options_description options_into(Settings& s)
{
  po::options_description options("Options");
  const auto word = [](std::string& place) {
    return po::value(&place)->default_value(place)->value_name("WORD");
  };
  options.add_options()("assign", word(s.assign),
                        "where a contact is booked: contact-point, branch (by the length in each "
                        "layer), gauss, lucy, heaviside (spread along the branch by this kernel) "
                        "or grain (each grain's part at its centre)");
  options.add_options()("width", po::value(&s.width)->default_value(s.width)->value_name("LENGTH"),
                        "of the kernel: standard deviation of gauss, half the support of lucy and "
                        "heaviside");
  options.add_options()("composition", po::value(&s.composition)->value_name("WORD"),
                        "a grain's area is clipped at the layers' edges (default), put whole at "
                        "its centre, or spread from there by the kernel (default where there is "
                        "one): clipped, centre or kernel");
  options.add_options()("partition", word(s.partition),
                        "the rule grseg-fit takes unless told otherwise; power:Q adds Mpower_*");
  options.add_options()("base", word(s.base),
                        "likewise, the part of contacts with base and walls: contact-point, half "
                        "or none");
  options.add_options()("volume", word(s.volume),
                        "likewise, the volume of a stress: bulk (V) or solid (area_S + area_L)");
  options.add_options()("merge", po::bool_switch(&s.merge),
                        "of tables instead of a run: means weighted by frames, window by window");
  options.add_options()("all-windows", po::bool_switch(&s.all_windows),
                        "with --merge: of all windows together");
  s.frames.add_bins_to(options);
  s.frames.add_to(options);
  return options;
}

/// How a run's contacts and grains are booked, as said on the command line.
struct Rules {
  Assignment assignment;
  std::optional<KernelShape> shape;
  GrainArea area;
  std::optional<double> power;
};

Rules rules_of(Settings& s, const po::variables_map& values)
{
  constexpr std::array assignments{Assignment::contact_point, Assignment::branch,
                                   Assignment::grain,         Assignment::kernel,
                                   Assignment::kernel,        Assignment::kernel};
  constexpr std::size_t first_kernel = 3;
  const auto word = choose(
      s.assign, "--assign",
      {"contact-point", "branch", "grain", kernel_names[0], kernel_names[1], kernel_names[2]});
  Rules rules{assignments[word], {}, {}, {}};
  if (s.frames.annuli() && s.assign != "contact-point" && s.assign != "grain")
    throw UsageError(fmt::format(
        "--assign {} spreads contacts over layers, not over annuli; with --bins {} take "
        "contact-point or grain",
        s.assign, s.frames.bins));
  if (word >= first_kernel) rules.shape = static_cast<KernelShape>(word - first_kernel);
  if (s.composition.empty()) s.composition = rules.shape ? "kernel" : "clipped";
  rules.area = static_cast<GrainArea>(
      choose(s.composition, "--composition", {"clipped", "centre", "kernel"}));
  for (const auto& [given, option] :
       {std::pair{rules.area == GrainArea::kernel, "--composition kernel"},
        {!values["width"].defaulted(), "--width"}})
    if (given && !rules.shape)
      throw UsageError(fmt::format("{} needs a kernel: --assign gauss, lucy or heaviside", option));
  choose(s.volume, "--volume", {"bulk", "solid"});
  parse_base(s.base);
  const auto rule = parse_rule(s.partition);
  s.partition = rule.name();
  if (rule.kind == PartitionRule::Kind::power) rules.power = rule.value;
  return rules;
}

template <class T>
std::vector<T> joined(std::vector<T> first, const std::vector<T>& second)
{
  first.insert(first.end(), second.begin(), second.end());
  return first;
}

void tabulate(Settings s, const po::variables_map& values, const std::string& command)
{
  const auto rules = rules_of(s, values);
  FrameLoop loop(info, values, s.frames);
  std::vector<std::pair<std::string, std::string>> settings{{"assign", s.assign},
                                                            {"composition", s.composition},
                                                            {"partition", s.partition},
                                                            {"base", s.base},
                                                            {"volume", s.volume}};
  if (rules.power) settings.emplace_back("power", format_number(*rules.power));
  std::optional<Kernel> kernel;
  if (rules.shape) {
    const LengthUnits units{loop.run().small_diameter(), loop.run().large_diameter()};
    kernel.emplace(*rules.shape, parse_length(s.width, "--width", units));
    settings.emplace_back("width", format_number(kernel->width()));
  }
  const Composition no_grains(loop.layers(), rules.area, kernel);
  const PartialContactStress no_contacts(loop.layers(), rules.assignment, rules.power, kernel);
  auto table = loop.make_table(command, settings,
                               joined({"area_S[m^2]", "area_L[m^2]"}, no_contacts.columns()));

  for (const auto& window : loop.windows()) {
    const auto [composition, stress] =
        loop.sum(window, {.velocity = false, .contacts = true}, no_grains, no_contacts);
    for (std::size_t layer = 0; layer < stress.layers(); ++layer) {
      const auto areas = composition.mean(layer);
      table.rows.push_back(
          loop.row(window, layer, joined({areas.small, areas.large}, stress.row(layer))));
    }
  }
  loop.write(table);
}

void merge(const Settings& s, const po::variables_map& values, const std::string& command)
{
  const std::set<std::string> about_merging{"merge",  "all-windows", "input",
                                            "output", "quiet",       "json"};
  for (const auto& [name, value] : values)
    if (!value.defaulted() && !about_merging.contains(name))
      throw UsageError(
          fmt::format("--{} does not go with --merge: tables keep what they were made with", name));
  std::vector<Table> tables;
  if (values.count("input") > 0)
    for (const auto& path : values["input"].as<std::vector<std::string>>())
      tables.push_back(Table::read(path));
  const auto program = fmt::format("{} {}", info.name, version());
  const auto merged = merge_tables(std::move(tables), s.all_windows, program, command);
  write_whole(s.frames.output, s.frames.json ? merged.to_json() : merged.to_text());
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
