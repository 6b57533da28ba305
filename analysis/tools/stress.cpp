// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/composition.hpp"
#include "analysis/frame_loop.hpp"
#include "analysis/partial_contact_stress.hpp"
#include "analysis/partition.hpp"
#include "analysis/presets.hpp"

using namespace grseg;

namespace {

constexpr ToolInfo info{
    "grseg-stress",
    "sums of force (x) branch by layer, window and pair of species: contact stress.",
    "grseg-stress run.h5 [options] > sums.tsv",
    "  grseg-stress run.h5 -o sums.tsv                  layers of 4 dS, windows of 1.25 s\n"
    "  grseg-stress run.h5 --assign branch --layer 1dS  thin layers, exact momentum balance\n"
    "  grseg-stress run.h5 --partition power:2 | grseg-fit - --partition power:2\n",
    presets::stress};

struct Settings {
  FrameOptions frames;
  std::string assign = "contact-point", composition = "clipped", base = "contact-point",
              volume = "bulk", partition = "size";
};

po::options_description options_into(Settings& s)
{
  po::options_description options("Options");
  const auto word = [](std::string& place) {
    return po::value(&place)->default_value(place)->value_name("WORD");
  };
  options.add_options()("assign", word(s.assign),
                        "where a contact is booked: contact-point, branch (by the length in each "
                        "layer) or grain (each grain's part at its centre)");
  options.add_options()("composition", word(s.composition),
                        "a grain's area is clipped at the layers' edges, or whole at its centre");
  options.add_options()("partition", word(s.partition),
                        "the rule grseg-fit takes unless told otherwise; power:Q adds Mpower_*");
  options.add_options()("base", word(s.base),
                        "likewise, the part of contacts with base and walls: contact-point, half "
                        "or none");
  options.add_options()("volume", word(s.volume),
                        "likewise, the volume of a stress: bulk (V) or solid (area_S + area_L)");
  s.frames.add_to(options);
  return options;
}

std::vector<double> joined(std::vector<double> first, const std::vector<double>& second)
{
  first.insert(first.end(), second.begin(), second.end());
  return first;
}

void tabulate(const Settings& s, const po::variables_map& values, const std::string& command)
{
  const auto assignment =
      static_cast<Assignment>(choose(s.assign, "--assign", {"contact-point", "branch", "grain"}));
  const auto area =
      static_cast<GrainArea>(choose(s.composition, "--composition", {"clipped", "centre"}));
  choose(s.volume, "--volume", {"bulk", "solid"});
  parse_base(s.base);
  const auto rule = parse_rule(s.partition);
  std::optional<double> power;
  if (rule.kind == PartitionRule::Kind::power) power = rule.value;

  FrameLoop loop(info, values, s.frames);
  std::vector<std::pair<std::string, std::string>> settings{{"assign", s.assign},
                                                            {"composition", s.composition},
                                                            {"partition", rule.name()},
                                                            {"base", s.base},
                                                            {"volume", s.volume}};
  if (power) settings.emplace_back("power", format_number(*power));
  std::vector<std::string> columns{"area_S[m^2]", "area_L[m^2]"};
  const auto sums = PartialContactStress(loop.layers(), assignment, power).columns();
  columns.insert(columns.end(), sums.begin(), sums.end());
  auto table = loop.make_table(command, settings, columns);

  for (const auto& window : loop.windows()) {
    const auto [composition, stress] =
        loop.sum(window, {.velocity = false, .contacts = true}, Composition(loop.layers(), area),
                 PartialContactStress(loop.layers(), assignment, power));
    for (std::size_t layer = 0; layer < stress.layers(); ++layer) {
      const auto areas = composition.mean(layer);
      table.rows.push_back(
          loop.row(window, layer, joined({areas.small, areas.large}, stress.row(layer))));
    }
  }
  loop.write(table);
}

}  // namespace

int main(int argc, char** argv)
{
  Settings settings;
  const auto options = options_into(settings);
  return run_tool(argc, argv, info, options, [&](const po::variables_map& values) {
    tabulate(settings, values, command_line(argc, argv));
  });
}
