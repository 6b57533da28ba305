// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/frames/frame_loop.hpp"
#include "analysis/frames/presets.hpp"
#include "analysis/frames/velocity_in_step.hpp"
#include "analysis/maps/fields.hpp"
#include "analysis/stress/kinetic_stress.hpp"
#include "formats/cli/words.hpp"
#include "formats/core/frame.hpp"

#include <fmt/format.h>

#include <cmath>
#include <utility>

using namespace grseg;

namespace {

constexpr ToolInfo info{
    "grseg-kinetic",
    "sums of m dv (x) dv by layer, window and species: kinetic stress, and the mean flow.",
    "grseg-kinetic run.h5 [options] > kinetic.tsv",
    "  grseg-kinetic run.h5 -o kinetic.tsv              about a fine profile of mean velocity\n"
    "  grseg-kinetic run.h5 --mean profile-unbiased     about that of all other grains\n"
    "  grseg-kinetic run.h5 --mean layer                about the mean of each layer\n"
    "  grseg-kinetic run.h5 --mean instant-unbiased     about the layer's mean in each frame\n"
    "  grseg-kinetic run.h5 --velocity middle           of the middle of each step\n"
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
  const auto means = "mean velocity that fluctuations are counted from: " + list_of(mean_flows);
  options.add_options()("mean", word_option(&s.mean, words_of(mean_flows)), means.c_str());
  const auto velocities =
      "which velocity of the step that a frame is: " + list_of(velocities_in_step) +
      "; imported frames have one only";
  options.add_options()("velocity", word_option(&s.velocity, words_of(velocities_in_step)),
                        velocities.c_str());
  s.frames.add_bins_to(options);
  s.frames.add_to(options);
  s.frames.add_parts_to(options);
  return options;
}

/// About a layer's mean, the shear inside the layer counts as fluctuations; reports how much.
struct LayerBias {
  double profile = 0, measured = 0, of_shear = 0;

  template <int D>
  void add(const KineticStress<D>& stress, std::size_t number_of_species)
  {
    for (std::size_t layer = 0; layer < stress.layers(); ++layer)
      for (std::size_t k = 0; k < number_of_species; ++k) {
        const auto species = static_cast<Species>(k);
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

/// Grains that are too few in their layer and frame for the mean that was asked for; reports them.
struct LeftOut {
  double grains = 0, of = 0;  // number, over all frames

  template <int D>
  void add(const KineticStress<D>& stress, std::size_t number_of_species, std::size_t frames)
  {
    for (std::size_t layer = 0; layer < stress.layers(); ++layer)
      for (std::size_t k = 0; k < number_of_species; ++k) {
        const auto mean = stress.mean(layer, static_cast<Species>(k));
        grains += mean.left_out * static_cast<double>(frames);
        of += (mean.left_out + mean.grains) * static_cast<double>(frames);
      }
  }
  void report() const
  {
    fmt::print(stderr,
               "{}: {:.0f} of {:.0f} grains (summed over frames) have fewer than two others in "
               "their layer or cell and do not count; the columns left_out have their number\n",
               info.name, grains, of);
  }
};

/// How much of its own motion a grain finds in the mean profile; reports it where it is not little.
struct OwnPart {
  double largest = 0;      // of a species in a window
  std::size_t frames = 0;  // of that window

  template <int D>
  void add(const KineticStress<D>& stress, std::size_t number_of_species, std::size_t of_frames)
  {
    for (std::size_t k = 0; k < number_of_species; ++k) {
      typename KineticStress<D>::Mean all;
      for (std::size_t layer = 0; layer < stress.layers(); ++layer)
        all += stress.mean(layer, static_cast<Species>(k));
      const double part = all.own_part / all.mass;
      if (part > largest) largest = part, frames = of_frames;
    }
  }
  void report() const
  {
    constexpr double little = 0.01;
    if (largest <= little) return;
    fmt::print(
        stderr,
        "{}: with {} {} in a window the mean velocity at a grain is made of the grain itself by up to "
        "{:.2g} %, and its fluctuations are too small by as much; --mean profile-unbiased leaves "
        "the grain out\n",
        info.name, frames, frames == 1 ? "frame" : "frames", 100 * largest);
  }
};

/// Sums over frames whose velocities are those that --velocity names.
template <int D, class Sums>
struct OfVelocity {
  Sums sums;
  VelocityInStep which;
  double step;  // s
  bool turning;

  void add(const Grains& grains, const Frame<D>& frame)
  {
    if (which == VelocityInStep::after) return sums.add(grains, frame);
    Frame<D> middle = frame;
    to_middle_of_step(grains, step_of_force(frame, step), turning, middle);
    sums.add(grains, middle);
  }
  void merge(const OfVelocity& others) { sums.merge(others.sums); }
};

/// The sums of a window about its mean.
template <int D>
KineticStress<D> sum(FrameLoop& loop, const Window& window, MeanFlow flow, VelocityInStep which,
                     const MeanVelocity<D>& no_grains)
{
  const bool middle = which == VelocityInStep::middle;
  const TrajectoryReader::Fields fields{.velocity = true, .contacts = middle, .force = middle};
  const auto& run = loop.run();
  const bool turning = run.parameters().find_number("rotation") != 0.0;
  const auto add_up = [&](const auto& nothing) {
    const OfVelocity<D, std::decay_t<decltype(nothing)>> none{nothing, which, run.step(), turning};
    return std::get<0>(loop.sum<D>(window, fields, none)).sums;
  };
  const auto mean = add_up(no_grains);
  return add_up(KineticStress<D>(loop.layers(), flow, mean, loop.species().size()));
}

/// What the header says of --velocity. UsageError where one was chosen of a run that leaves no choice.
std::string velocity_line(const TrajectoryReader& run, const Settings& s, bool chosen)
{
  if (run.parameters().text("import_format").empty()) return s.velocity;
  if (chosen)
    throw UsageError(fmt::format(
        "--velocity {}: {} was imported, so that a frame is an instant, not a step, and has one "
        "velocity; leave --velocity out",
        s.velocity, run.path()));
  return "instant";
}

/// FormatError where the run lacks what the middle of a step follows from.
void require_forces(const TrajectoryReader& run)
{
  if (!run.has_force())
    throw FormatError(
        fmt::format("{}: /particles/grains/force, from which the velocity in the middle of a step "
                    "follows, is missing; leave --velocity middle out",
                    run.path()));
}

/// Areas or volumes, which masses do not tell where densities differ.
template <int D>
void add_contents(std::vector<Cell>& cells, const SpeciesList& species,
                  const KineticStress<D>& stress, std::optional<std::size_t> layer)
{
  const auto columns = content_columns(species, D);
  for (std::size_t k = 0; k < columns.size(); ++k)
    cells.push_back({columns[k], layer ? stress.mean(*layer, static_cast<Species>(k)).content : 0});
}

/// Of a layer or cell, or their names without one.
template <int D>
std::vector<Cell> cells(const FrameLoop& loop, const KineticStress<D>& stress, bool with_contents,
                        std::optional<std::size_t> layer)
{
  auto cells = stress.cells(loop.species(), layer);
  if (with_contents) add_contents(cells, loop.species(), stress, layer);
  if (!loop.layers().map()) return cells;
  typename KineticStress<D>::Mean all;
  Vector<D> velocity = Vector<D>::Zero();
  if (layer) {
    velocity = stress.velocity(*layer);
    for (std::size_t k = 0; k < loop.species().size(); ++k)
      all += stress.mean(*layer, static_cast<Species>(k));
  }
  for (auto& field : flow_fields<D>(velocity, all)) cells.push_back(std::move(field));
  return cells;
}

template <int D>
void tabulate(FrameLoop& loop, const Settings& s, MeanFlow flow, VelocityInStep which,
              const Header& settings, const std::string& command)
{
  const auto& species = loop.species();
  const MeanVelocity<D> no_grains(loop.layers(), loop.run().small_diameter() / 2, species.size());
  const KineticStress<D> nothing(loop.layers(), flow, no_grains, species.size());
  const bool with_contents = !have_one_density<D>(loop.grains());
  auto table = loop.make_table(command, settings,
                               columns_of(cells(loop, nothing, with_contents, std::nullopt)));

  loop.expect_passes(2);
  LayerBias bias;
  LeftOut left_out;
  OwnPart own;
  for (const auto& window : loop.windows()) {
    const auto stress = sum(loop, window, flow, which, no_grains);
    for (std::size_t layer = 0; layer < stress.layers(); ++layer)
      loop.add(table,
               loop.row(window, layer, values_of(cells(loop, stress, with_contents, layer))));
    bias.add(stress, species.size());
    left_out.add(stress, species.size(), window.frames.size());
    own.add(stress, species.size(), window.frames.size());
  }
  loop.write(std::move(table), loop.layers().map() ? "" : "grseg-fit --quantity kinetic");
  if (flow == MeanFlow::layer && !loop.layers().map() && !s.frames.quiet) bias.report();
  if (left_out.grains > 0 && !s.frames.quiet) left_out.report();
  if (!s.frames.quiet) own.report();
}

/// Maps have no profile: unless it was asked for, the mean is that of the cell.
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

void tabulate(Settings s, const po::variables_map& values, const std::string& command)
{
  choose_mean_of_map(s, values);
  const auto flow = choose(s.mean, "--mean", mean_flows);
  const auto which = choose(s.velocity, "--velocity", velocities_in_step);
  FrameLoop loop(info, values, s.frames);
  const Header settings{
      {"mean", s.mean},
      {"velocity", velocity_line(loop.run(), s, !values["velocity"].defaulted())}};
  if (which == VelocityInStep::middle) require_forces(loop.run());
  with_dimension(loop.dimension(),
                 [&](auto d) { tabulate<d>(loop, s, flow, which, settings, command); });
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
