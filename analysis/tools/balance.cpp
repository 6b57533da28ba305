// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/balance/balance_table.hpp"
#include "analysis/frames/presets.hpp"
#include "analysis/frames/table_writer.hpp"
#include "analysis/tools/tool_main.hpp"
#include "formats/cli/output.hpp"
#include "formats/cli/words.hpp"
#include "formats/core/frame.hpp"
#include "formats/core/length.hpp"

#include <fmt/format.h>

using namespace grseg;

namespace {

constexpr ToolInfo info{
    "grseg-balance",
    "momentum balance of each species by layer and window, and the forces that drive segregation.",
    "grseg-balance run.h5 [options] > balance.tsv",
    "  grseg-balance run.h5 -o balance.tsv              layers of 4 dS, Gaussian of 1 dS\n"
    "  grseg-balance run.h5 --layer 1dS --kernel-width 0.5dS   finer profiles\n"
    "  grseg-balance run.h5 --begin 20 -o /dev/null     only the summary, one sentence\n"
    "  grseg-balance run.h5 --partition stock           also push, interaction and drag by rule,\n"
    "                                                   and N, which no rule changes\n",
    presets::balance};

struct Settings {
  FrameOptions frames;
  std::string width = "1dS";
  std::vector<std::string> partition;
};

po::options_description options_into(Settings& s)
{
  po::options_description options("Options");
  options.add_options()("kernel-width",
                        po::value(&s.width)->default_value(s.width)->value_name("LENGTH"),
                        "standard deviation of the Gaussian by which quantities are spread over "
                        "height (coarse graining)");
  const auto partition =
      "add columns for these partition rules, which divide the stress of mixed contacts: " +
      list_of_rules() + ", separated by commas; or stock, the rules of published programs";
  options.add_options()("partition", words_option(s.partition, words_of_rules()),
                        partition.c_str());
  s.frames.add_to(options);
  return options;
}

Header settings_of(const Kernel& kernel, const std::vector<PartitionRule>& rules)
{
  Header settings{{"kernel", "gauss"}, {"width", format_number(kernel.width())}};
  if (!rules.empty()) settings.emplace_back("partition", names_of(rules));
  return settings;
}

template <int D>
void tabulate(FrameLoop& loop, const Settings& s, const std::string& command)
{
  const auto& run = loop.run();
  const auto& species = loop.species();
  const LengthUnits units{run.small_diameter(), run.large_diameter()};
  const Kernel kernel(parse_length(s.width, "--kernel-width", units));
  const auto rules = without_repeats(parse_rules(s.partition));
  BalanceSummary<D> summary(loop.layers(), run.large_diameter(), rules);
  const MomentumBalance<D> no_grains(loop.layers(), kernel, run.gravity<D>(), run.step(),
                                     species.size());
  const PartitionedBalance<D> no_contacts(loop.layers(), kernel, rules, species.size());
  const auto cells_of = [&](const MomentumBalance<D>& balance,
                            const PartitionedBalance<D>& contacts,
                            std::optional<std::size_t> layer) {
    auto cells = balance_cells(balance, species, layer);
    if (!rules.empty()) add_all(cells, partition_cells(balance, contacts, species, layer));
    return cells;
  };
  TableWriter table(loop, command, settings_of(kernel, rules),
                    columns_of(cells_of(no_grains, no_contacts, std::nullopt)));
  for (const auto& window : loop.windows()) {
    const auto [balance, contacts] = loop.sum<D>(
        window, {.velocity = true, .contacts = true, .force = true}, no_grains, no_contacts);
    for (std::size_t layer = 0; layer < balance.layers(); ++layer)
      table.add(window, layer, values_of(cells_of(balance, contacts, layer)));
    summary.add(balance, rules.empty() ? nullptr : &contacts);
  }
  if (s.frames.json && !rules.empty())
    write_whole(loop.options().output, summary.to_json(table.table()));
  else
    table.write();
  if (s.frames.quiet) return;
  fmt::print(stderr, "{}: {}\n", info.name, summary.sentence());
  if (!rules.empty()) fmt::print(stderr, "{}: {}\n", info.name, summary.text());
}

void tabulate(Settings& s, const po::variables_map& values, const std::string& command)
{
  parse_rules(s.partition);
  FrameLoop loop(info, values, s.frames);
  loop.require_forces("the rate at which momentum changes",
                      "use a run of grseg-sim, or import one with the forces on its grains");
  with_dimension(loop.dimension(), [&](auto d) { tabulate<d>(loop, s, command); });
}

}  // namespace

int main(int argc, char** argv)
{
  return tool_main<Settings>(argc, argv, info, options_into, tabulate);
}
