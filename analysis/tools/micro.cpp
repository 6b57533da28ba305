// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/frame_loop.hpp"
#include "analysis/micro_structure.hpp"
#include "analysis/presets.hpp"

using namespace grseg;

namespace {

constexpr ToolInfo info{
    "grseg-micro",
    "coordination, contact forces, share of mixed contacts and heights, by layer and of the bed.",
    "grseg-micro run.h5 [options] > micro.tsv",
    "  grseg-micro run.h5 -o micro.tsv\n"
    "  grseg-micro run.h5 | grep -v '^#' | awk -F'\\t' '$3 == \"nan\"'   the whole bed over "
    "time\n",
    presets::micro};

struct Settings {
  FrameOptions frames;
  std::string composition = "clipped";
};

po::options_description options_into(Settings& s)
{
  po::options_description options("Options");
  options.add_options()("composition",
                        po::value(&s.composition)->default_value(s.composition)->value_name("WORD"),
                        "a grain's area is clipped at the layers' edges, or whole at its centre");
  s.frames.add_to(options);
  return options;
}

void tabulate(const Settings& s, const po::variables_map& values, const std::string& command)
{
  const auto area =
      static_cast<GrainArea>(choose(s.composition, "--composition", {"clipped", "centre"}));
  FrameLoop loop(info, values, s.frames);
  auto table =
      loop.make_table(command, {{"composition", s.composition}}, MicroStructure::columns());

  for (const auto& window : loop.windows()) {
    const auto [micro] = loop.sum(window, {.velocity = false, .contacts = true},
                                  MicroStructure(loop.layers(), area, loop.run().small_diameter(),
                                                 loop.run().large_diameter()));
    for (std::size_t layer = 0; layer < micro.layers(); ++layer)
      table.rows.push_back(loop.row(window, layer, micro.row(layer)));
    table.rows.push_back(loop.bed_row(window, micro.heights().bed, micro.bed_row()));
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
