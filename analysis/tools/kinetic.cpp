// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/frames/frame_loop.hpp"
#include "analysis/frames/presets.hpp"
#include "analysis/stress/kinetic_stress.hpp"
#include "formats/cli/words.hpp"

#include <fmt/format.h>

#include <cmath>

using namespace grseg;

namespace {

constexpr ToolInfo info{
    "grseg-kinetic",
    "sums of m dv (x) dv by layer, window and species: kinetic stress, and the mean flow.",
    "grseg-kinetic run.h5 [options] > kinetic.tsv",
    "  grseg-kinetic run.h5 -o kinetic.tsv              about a fine profile of mean velocity\n"
    "  grseg-kinetic run.h5 --mean layer                about the mean of each layer\n"
    "  grseg-kinetic run.h5 --mean instant              about the layer's mean in each frame\n"
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
      "mean velocity that fluctuations are counted from: profile (over the window, in bins of at "
      "most half a dS, at the grain's own height), layer (over the window), instant (of the layer "
      "in each frame) or species (of the species in the layer, over the window)");
  s.frames.add_bins_to(options);
  s.frames.add_to(options);
  return options;
}

/// A layer's mean takes the shear inside the layer for fluctuations; says how much that is here.
struct LayerBias {
  double profile = 0, measured = 0, of_shear = 0;

  void add(const KineticStress& stress)
  {
    for (std::size_t layer = 0; layer < stress.layers(); ++layer)
      for (const auto species : {Species::small, Species::large}) {
        const auto mean = stress.mean(layer, species);
        const double of_layer = stress.shear_bias(layer, species);
        if (!std::isfinite(of_layer)) continue;
        profile += mean.about_mean.kinetic(0, 0) - mean.layer_bias.kinetic(0, 0);
        measured += mean.layer_bias.kinetic(0, 0);
        of_shear += of_layer;
      }
  }
  void report() const
  {
    const double all = profile + measured;
    fmt::print(stderr,
               "{}: {:.3g} % of K_xx about the layers' means is shear inside the layers (mass "
               "(du/dy h)^2/12: {:.3g} %); the columns layer_bias have it\n",
               info.name, 100 * measured / all, 100 * of_shear / all);
  }
};

void tabulate(const Settings& s, const po::variables_map& values, const std::string& command)
{
  const auto flow = choose<MeanFlow>(s.mean, "--mean",
                                     {{"profile", MeanFlow::profile},
                                      {"layer", MeanFlow::layer},
                                      {"instant", MeanFlow::instant},
                                      {"species", MeanFlow::species}});
  FrameLoop loop(info, values, s.frames);
  auto table = loop.make_table(command, {{"mean", s.mean}}, KineticStress::columns());

  LayerBias bias;
  for (const auto& window : loop.windows()) {
    const TrajectoryReader::Fields fields{.velocity = true, .contacts = false};
    const auto [mean] =
        loop.sum(window, fields, MeanVelocity(loop.layers(), loop.run().small_diameter() / 2));
    const auto [stress] = loop.sum(window, fields, KineticStress(loop.layers(), flow, mean));
    for (std::size_t layer = 0; layer < stress.layers(); ++layer)
      table.rows.push_back(loop.row(window, layer, stress.row(layer)));
    bias.add(stress);
  }
  loop.write(table);
  if (flow == MeanFlow::layer && !s.frames.quiet) bias.report();
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
