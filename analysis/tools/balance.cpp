// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/balance/summary.hpp"
#include "analysis/balance/table.hpp"
#include "analysis/frames/frame_loop.hpp"
#include "analysis/frames/presets.hpp"
#include "formats/cli/words.hpp"
#include "formats/core/dimension.hpp"
#include "formats/core/length.hpp"

#include <fmt/format.h>

using namespace grseg;

namespace {

constexpr ToolInfo info{
    "grseg-balance",
    "momentum balance of each species by layer and window, and the forces that drive segregation.",
    "grseg-balance run.h5 [options] > balance.tsv",
    "  grseg-balance run.h5 -o balance.tsv              layers of 4 dS, Gaussian of 1 dS\n"
    "  grseg-balance run.h5 --layer 1dS --width 0.5dS   finer profiles\n"
    "  grseg-balance run.h5 --kernel lucy --width 3dS   a kernel of compact support\n"
    "  grseg-balance run.h5 --begin 20 -o /dev/null     only the sentence of the summary\n",
    presets::balance};

struct Settings {
  FrameOptions frames;
  std::string kernel = "gauss", width = "1dS";
};

po::options_description options_into(Settings& s)
{
  po::options_description options("Options");
  options.add_options()("kernel", po::value(&s.kernel)->default_value(s.kernel)->value_name("WORD"),
                        "coarse-graining function over height: gauss, lucy or heaviside");
  options.add_options()("width", po::value(&s.width)->default_value(s.width)->value_name("LENGTH"),
                        "width of the kernel: standard deviation of gauss, half the support of the "
                        "others");
  s.frames.add_to(options);
  return options;
}

template <int D>
void tabulate(FrameLoop& loop, const Settings& s, KernelShape shape, const std::string& command)
{
  const auto& run = loop.run();
  const auto& species = loop.species();
  const LengthUnits units{run.small_diameter(), run.large_diameter()};
  const Kernel kernel(shape, parse_length(s.width, "--width", units));
  auto table =
      loop.make_table(command, {{"kernel", s.kernel}, {"width", format_number(kernel.width())}},
                      balance_columns<D>(species));

  BalanceSummary<D> summary(loop.layers(), run.large_diameter());
  const MomentumBalance<D> empty(loop.layers(), kernel, run.gravity<D>(), run.step(),
                                 species.size());
  for (const auto& window : loop.windows()) {
    const auto [balance] =
        loop.sum<D>(window, {.velocity = true, .contacts = true, .force = true}, empty);
    for (std::size_t layer = 0; layer < balance.layers(); ++layer)
      table.rows.push_back(loop.row(window, layer, balance_row(balance, layer)));
    summary.add(balance);
  }
  loop.write(table);
  if (!s.frames.quiet) fmt::print(stderr, "{}: {}\n", info.name, summary.sentence());
}

void tabulate(const Settings& s, const po::variables_map& values, const std::string& command)
{
  const auto shape = choose(s.kernel, "--kernel", kernel_shapes);
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
