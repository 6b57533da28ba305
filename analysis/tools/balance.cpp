// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/balance/balance_summary.hpp"
#include "analysis/balance/balance_table.hpp"
#include "analysis/frames/frame_loop.hpp"
#include "analysis/frames/presets.hpp"
#include "formats/cli/output.hpp"
#include "formats/cli/words.hpp"
#include "formats/core/frame.hpp"
#include "formats/core/length.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <algorithm>

using namespace grseg;

namespace {

constexpr ToolInfo info{
    "grseg-balance",
    "momentum balance of each species by layer and window, and the forces that drive segregation.",
    "grseg-balance run.h5 [options] > balance.tsv",
    "  grseg-balance run.h5 -o balance.tsv              layers of 4 dS, Gaussian of 1 dS\n"
    "  grseg-balance run.h5 --layer 1dS --kernel-width 0.5dS   finer profiles\n"
    "  grseg-balance run.h5 --kernel lucy --kernel-width 3dS   a kernel of compact support\n"
    "  grseg-balance run.h5 --begin 20 -o /dev/null     only the sentence of the summary\n"
    "  grseg-balance run.h5 --partition stock           push, interaction and drag under each rule\n"
    "                                                   beside N, which no rule changes\n",
    presets::balance};

struct Settings {
  FrameOptions frames;
  std::string kernel = "gauss", width = "1dS";
  std::vector<std::string> partition;
};

po::options_description options_into(Settings& s)
{
  po::options_description options("Options");
  options.add_options()("kernel", word_option(&s.kernel, words_of(kernel_shapes)),
                        "coarse-graining function over height: gauss, lucy or heaviside");
  options.add_options()("kernel-width",
                        po::value(&s.width)->default_value(s.width)->value_name("LENGTH"),
                        "width of the kernel: standard deviation of gauss, half the support of the "
                        "others");
  const auto partition =
      "adds columns of these rules, which cut mixed contacts elsewhere than at the contact point: " +
      list_of_rules() + ", several by comma; or stock, the rules of published codes";
  options.add_options()("partition", words_option(s.partition, words_of_rules()),
                        partition.c_str());
  s.frames.add_to(options);
  return options;
}

/// Each rule once, in the order given.
std::vector<PartitionRule> rules_of(const Settings& s)
{
  std::vector<PartitionRule> rules;
  for (const auto& rule : parse_rules(s.partition))
    if (std::find(rules.begin(), rules.end(), rule) == rules.end()) rules.push_back(rule);
  return rules;
}

Header settings_of(const Settings& s, const Kernel& kernel, const std::vector<PartitionRule>& rules)
{
  Header settings{{"kernel", s.kernel}, {"width", format_number(kernel.width())}};
  if (rules.empty()) return settings;
  std::vector<std::string> names;
  names.reserve(rules.size());
  for (const auto& rule : rules) names.push_back(rule.name());
  settings.emplace_back("partition", fmt::format("{}", fmt::join(names, ",")));
  return settings;
}

/// With --json and --partition the table, and what it comes to by rule under "summary".
void write_json(const Settings& s, const Table& table, const std::string& summary)
{
  using Json = nlohmann::ordered_json;
  auto all = Json::parse(table.to_json());
  all["summary"] = Json::parse(summary);
  write_whole(s.frames.output, all.dump(2) + '\n');
}

/// The sums of a window, with those by rule where rules are asked for.
template <int D>
struct WindowBalance {
  MomentumBalance<D> balance;
  PartitionedBalance<D> contacts;
};
template <int D>
WindowBalance<D> sum(FrameLoop& loop, const Window& window, const WindowBalance<D>& empty)
{
  const TrajectoryReader::Fields fields{.velocity = true, .contacts = true, .force = true};
  if (empty.contacts.rules().empty())
    return {std::get<0>(loop.sum<D>(window, fields, empty.balance)), empty.contacts};
  auto [balance, contacts] = loop.sum<D>(window, fields, empty.balance, empty.contacts);
  return {std::move(balance), std::move(contacts)};
}

template <int D>
void tabulate(FrameLoop& loop, const Settings& s, KernelShape shape, const std::string& command)
{
  const auto& run = loop.run();
  const auto& species = loop.species();
  const LengthUnits units{run.small_diameter(), run.large_diameter()};
  const Kernel kernel(shape, parse_length(s.width, "--kernel-width", units));
  const auto rules = rules_of(s);
  auto columns = balance_columns<D>(species);
  if (!rules.empty())
    for (auto& column : partition_columns<D>(species, rules)) columns.push_back(std::move(column));
  auto table = loop.make_table(command, settings_of(s, kernel, rules), columns);

  BalanceSummary<D> summary(loop.layers(), run.large_diameter());
  PartitionSummary<D> by_rule(loop.layers(), run.large_diameter(), rules);
  const WindowBalance<D> empty{
      {loop.layers(), kernel, run.gravity<D>(), run.step(), species.size()},
      {loop.layers(), kernel, rules, species.size()}};
  for (const auto& window : loop.windows()) {
    const auto [balance, contacts] = sum(loop, window, empty);
    for (std::size_t layer = 0; layer < balance.layers(); ++layer) {
      auto row = balance_row(balance, layer);
      if (!rules.empty())
        for (const double value : partition_row(balance, contacts, layer)) row.push_back(value);
      loop.add(table, loop.row(window, layer, row));
    }
    summary.add(balance);
    if (!rules.empty()) by_rule.add(balance, contacts);
  }
  if (s.frames.json && !rules.empty())
    write_json(s, table, by_rule.to_json());
  else
    loop.write(std::move(table));
  if (s.frames.quiet) return;
  fmt::print(stderr, "{}: {}\n", info.name, summary.sentence());
  if (!rules.empty()) fmt::print(stderr, "{}: {}\n", info.name, by_rule.text());
}

void tabulate(const Settings& s, const po::variables_map& values, const std::string& command)
{
  const auto shape = choose(s.kernel, "--kernel", kernel_shapes);
  parse_rules(s.partition);
  FrameLoop loop(info, values, s.frames);
  const auto& run = loop.run();
  if (!run.has_force())
    throw FormatError(
        fmt::format("{}: /particles/grains/force, the rate at which momentum changes, is missing; "
                    "take a run of grseg-sim, or import one with the forces on its grains",
                    run.path()));
  with_dimension(loop.dimension(), [&](auto d) { tabulate<d>(loop, s, shape, command); });
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
