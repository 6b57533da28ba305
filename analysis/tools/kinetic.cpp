// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/frames/presets.hpp"
#include "analysis/frames/table_writer.hpp"
#include "analysis/stress/kinetic_stress.hpp"
#include "analysis/tools/tool_main.hpp"
#include "formats/cli/words.hpp"
#include "formats/core/frame.hpp"

#include <fmt/format.h>

using namespace grseg;

namespace {

constexpr ToolInfo info{
    "grseg-kinetic",
    "kinetic stress (sums of m dv (x) dv) and mean flow, by layer, window and species.",
    "grseg-kinetic run.h5 [options] > kinetic.tsv",
    "  grseg-kinetic run.h5 -o kinetic.tsv              mean: a fine velocity profile\n"
    "  grseg-kinetic run.h5 --mean profile-unbiased     mean: the profile of all other grains\n"
    "  grseg-kinetic run.h5 --mean layer                mean: of each layer\n"
    "  grseg-kinetic run.h5 --mean instant-unbiased     mean: of each layer in each frame\n"
    "  grseg-kinetic run.h5 --velocity middle           velocities at the middle of time steps\n"
    "  grseg-kinetic drum.h5 --bins xy --layer 2dS -o flow.h5         a map, for xarray\n"
    "  grseg-kinetic run.h5 | grseg-fit - --quantity kinetic\n",
    presets::kinetic};

struct Settings {
  FrameOptions frames;
  std::string mean = "profile", velocity = "after";
};

po::options_description options_into(Settings& s)
{
  po::options_description options("Options");
  auto add = options.add_options();
  add("mean", word_option(&s.mean, words_of(mean_flows)),
      ("mean that is subtracted from velocities to get dv: " + list_of(mean_flows)).c_str());
  add("velocity", word_option(&s.velocity, words_of(velocities_in_step)),
      ("time of the velocity in the step of a frame: " + list_of(velocities_in_step) +
       "; imported frames have only one velocity")
          .c_str());
  s.frames.add_bins_to(options);
  s.frames.add_to(options);
  return options;
}

template <int D>
void tabulate(FrameLoop& loop, MeanFlow flow, VelocityInStep which, const Header& settings,
              const std::string& command)
{
  const auto& species = loop.species();
  const MeanVelocity<D> no_grains(loop.layers(), loop.run().small_diameter() / 2, species.size());
  const KineticStress<D> nothing(loop.layers(), flow, no_grains, species.size());
  const bool map = loop.layers().map() != nullptr;
  const auto cells = [&, contents = !have_one_density<D>(loop.grains())](
                         const KineticStress<D>& stress, std::optional<std::size_t> layer) {
    return kinetic_cells(stress, species, contents, map, layer);
  };
  TableWriter table(loop, command, settings, columns_of(cells(nothing, std::nullopt)));
  loop.expect_passes(2);
  KineticRemarks remarks;
  for (const auto& window : loop.windows()) {
    const auto stress = kinetic_stress(loop, window, flow, which, no_grains);
    for (std::size_t layer = 0; layer < stress.layers(); ++layer)
      table.add(window, layer, values_of(cells(stress, layer)));
    remarks.add(stress, species.size(), window.frames.size());
  }
  table.write("grseg-fit --quantity kinetic");
  if (loop.options().quiet) return;
  for (const auto& sentence : remarks.sentences(flow == MeanFlow::layer))
    fmt::print(stderr, "{}: {}\n", info.name, sentence);
}

void tabulate(Settings& s, const po::variables_map& values, const std::string& command)
{
  const auto flow = choose(s.mean, "--mean", mean_flows);
  const auto which = choose(s.velocity, "--velocity", velocities_in_step);
  FrameLoop loop(info, values, s.frames);
  const Header settings{
      {"mean", s.mean},
      {"velocity", velocity_line(loop.run(), s.velocity, !values["velocity"].defaulted())}};
  if (which == VelocityInStep::middle)
    loop.require_forces("from which the velocity in the middle of a step follows",
                        "leave --velocity middle out");
  with_dimension(loop.dimension(),
                 [&](auto d) { tabulate<d>(loop, flow, which, settings, command); });
}

}  // namespace

int main(int argc, char** argv)
{
  return tool_main<Settings>(argc, argv, info, options_into, tabulate);
}
