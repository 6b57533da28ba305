// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/frame_loop.hpp"
#include "analysis/kinetic_stress.hpp"
#include "analysis/presets.hpp"

using namespace grseg;

namespace {

constexpr ToolInfo info{
    "grseg-kinetic",
    "sums of m dv (x) dv by layer, window and species: kinetic stress, and the mean flow.",
    "grseg-kinetic run.h5 [options] > kinetic.tsv",
    "  grseg-kinetic run.h5 -o kinetic.tsv              about a fine profile of mean velocity\n"
    "  grseg-kinetic run.h5 --mean layer                about the mean of each layer\n"
    "  grseg-kinetic run.h5 | grseg-fit - --quantity kinetic\n",
    presets::kinetic};

struct Settings {
  FrameOptions frames;
  std::string mean = "profile";
};

po::options_description options_into(Settings& s)
{
  po::options_description options("Options");
  options.add_options()(
      "mean", po::value(&s.mean)->default_value(s.mean)->value_name("WORD"),
      "mean velocity over the window that fluctuations are counted from: profile (bins of at most "
      "half a dS, at the grain's own height), layer, or species (in the layer)");
  s.frames.add_to(options);
  return options;
}

void tabulate(const Settings& s, const po::variables_map& values, const std::string& command)
{
  const auto flow =
      static_cast<MeanFlow>(choose(s.mean, "--mean", {"profile", "layer", "species"}));
  FrameLoop loop(info, values, s.frames);
  auto table = loop.make_table(command, {{"mean", s.mean}}, KineticStress::columns());

  for (const auto& window : loop.windows()) {
    const TrajectoryReader::Fields fields{.velocity = true, .contacts = false};
    const auto [mean] = loop.sum(
        window, fields, MeanVelocity(flow, loop.layers(), loop.run().small_diameter() / 2));
    const auto [stress] = loop.sum(window, fields, KineticStress(loop.layers(), mean));
    for (std::size_t layer = 0; layer < stress.layers(); ++layer)
      table.rows.push_back(loop.row(window, layer, stress.row(layer)));
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
