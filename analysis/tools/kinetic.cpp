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
    "sums of m dv (x) dv by layer, window and species: kinetic stress, and the mean flow.",
    "grseg-kinetic run.h5 [options] > kinetic.tsv",
    "  grseg-kinetic run.h5 -o kinetic.tsv              about a fine profile of mean velocity\n"
    "  grseg-kinetic run.h5 --mean profile-unbiased     about the profile of all other grains\n"
    "  grseg-kinetic run.h5 --mean layer                about the mean of each layer\n"
    "  grseg-kinetic run.h5 --mean instant-unbiased     about the layer's mean in each frame\n"
    "  grseg-kinetic run.h5 --velocity middle           velocities in the middle of steps\n"
    "  grseg-kinetic drum.h5 --bins xy --layer 2dS -o flow.pvd        a map, for ParaView\n"
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
      ("mean velocity that fluctuations are counted from: " + list_of(mean_flows)).c_str());
  add("velocity", word_option(&s.velocity, words_of(velocities_in_step)),
      ("velocity within the step of a frame: " + list_of(velocities_in_step) +
       "; imported frames have only one")
          .c_str());
  s.frames.add_bins_to(options);
  s.frames.add_to(options);
  s.frames.add_parts_to(options);
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
  table.write(map ? "" : "grseg-fit --quantity kinetic");
  if (loop.options().quiet) return;
  for (const auto& sentence : remarks.sentences(flow == MeanFlow::layer && !map))
    fmt::print(stderr, "{}: {}\n", info.name, sentence);
}

/// Takes the mean of the cell for a map, which has no profile. UsageError where a profile was asked
/// for.
void choose_mean_of_map(Settings& s, const po::variables_map& values)
{
  if (!s.frames.map() || (s.mean != "profile" && s.mean != "profile-unbiased")) return;
  if (!values["mean"].defaulted())
    throw UsageError(fmt::format(
        "--mean {} is a profile over height, which a map does not have; take layer, instant or "
        "instant-unbiased, the mean of the cell",
        s.mean));
  s.mean = word_of(MeanFlow::layer, mean_flows);
}

void tabulate(Settings& s, const po::variables_map& values, const std::string& command)
{
  choose_mean_of_map(s, values);
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
