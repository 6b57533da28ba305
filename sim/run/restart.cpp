// SPDX-License-Identifier: GPL-3.0-or-later
#include "sim/run/restart.hpp"

#include "formats/core/errors.hpp"
#include "sim/scene/deposition.hpp"

#include <fmt/format.h>
#include <gsl/gsl_randist.h>
#include <gsl/gsl_rng.h>

#include <algorithm>
#include <cmath>
#include <memory>

namespace grseg {
namespace {

namespace po = boost::program_options;

constexpr double whole_number_tolerance = 1e-6;  // of a step

po::variables_map no_words()
{
  po::variables_map values;
  po::store(po::command_line_parser(std::vector<std::string>{}).options(scene_options()).run(),
            values);
  return values;
}

/// Puts the clock and the impulses, which are those of one step, on steps of another length.
void change_step(Simulation::State& state, const Scene& then, const Scene& now)
{
  if (then.step == now.step) return;
  const double time = static_cast<double>(state.steps_done) * then.step;
  const double steps = time / now.step;
  if (std::abs(steps - std::round(steps)) > whole_number_tolerance) {
    const double frames = std::floor(time / then.frame_interval + whole_number_tolerance);
    throw UsageError(fmt::format(
        "the checkpoint's time, {:.9g} s, is no whole number of steps of {:.9g} s; choose a step "
        "that divides it, or go on with the old step first, to the next frame: --duration {:.9g}",
        time, now.step, (frames + 1) * then.frame_interval));
  }
  state.steps_done = std::llround(steps);
  const double longer = now.step / then.step;
  for (auto& impulse : state.pairs.impulse_n) impulse *= longer;
  for (auto& impulse : state.pairs.impulse_t) impulse *= longer;
}

/// Displaces every mobile grain by a vector that is uniform in a disc of radius `most` (m).
void displace(std::vector<Vec2>& position, const Grains& grains, double most, std::uint64_t seed)
{
  const std::unique_ptr<gsl_rng, decltype(&gsl_rng_free)> random(gsl_rng_alloc(gsl_rng_mt19937),
                                                                 gsl_rng_free);
  gsl_rng_set(random.get(), seed);
  for (std::size_t g = 0; g < position.size(); ++g) {
    if (grains.fixed[g]) continue;
    const double distance = most * std::sqrt(gsl_rng_uniform(random.get()));
    Vec2 direction;
    gsl_ran_dir_2d(random.get(), &direction.x(), &direction.y());
    position[g] += distance * direction;
  }
}

}  // namespace

Scene scene_of(const Checkpoint& checkpoint, const std::string& name)
{
  return scene_of(checkpoint, name, no_words());
}

Scene scene_of(const Checkpoint& checkpoint, const std::string& name,
               const po::variables_map& given)
{
  std::vector<std::string> renewed;
  if (!given["accuracy"].defaulted()) renewed = {"step", "tolerance", "min-sweeps", "max-sweeps"};
  auto values = given;
  read_scene_text(checkpoint.scene, name, renewed, values);
  return resolve_scene(values);
}

void require_same_bed(const Scene& then, const Scene& now)
{
  const auto require = [](const char* key, bool same) {
    if (!same)
      throw UsageError(
          fmt::format("{} differs from the checkpoint's: it belongs to the bed, which a restart "
                      "keeps; leave it out, or begin a new run without --restart",
                      key));
  };
  require("small-diameter", then.small_diameter == now.small_diameter);
  require("size-ratio", then.size_ratio == now.size_ratio);
  require("spread", then.spread == now.spread);
  require("density", then.density == now.density);
  require("phi-large", then.phi_large == now.phi_large);
  require("large-grains", then.large_grains == now.large_grains);
  require("geometry", then.geometry == now.geometry);
  require("drum-diameter", then.drum_diameter == now.drum_diameter);
  require("fill", then.fill == now.fill);
  require("column-width", then.column_width == now.column_width);
  require("outlet", then.outlet == now.outlet);
  require("depth", then.depth == now.depth);
  require("length", then.length == now.length);
  require("seed", then.seed == now.seed);
  require("rotation", then.rotation == now.rotation);
  require("base", then.base == now.base);
  require("lateral", then.lateral == now.lateral);
  require("origin", then.origin == now.origin);
  require("keep-deposition", then.keep_deposition == now.keep_deposition);
}

bool moves_alike(const Scene& then, const Scene& now)
{
  auto same = then;
  same.duration = now.duration;
  same.compression = now.compression;
  same.float32 = now.float32;
  return to_text(same) == to_text(now);
}

Simulation go_on(const Checkpoint& checkpoint, const Scene& then, const Scene& now,
                 const Perturbation& perturbation)
{
  World world;
  world.grains = checkpoint.grains;
  world.walls = checkpoint.walls;
  world.box = checkpoint.box;
  set_conditions(world, now);
  auto state = checkpoint.state;
  change_step(state, then, now);
  if (now.friction == 0)  // the solver then leaves tangential impulses as they are
    std::fill(state.pairs.impulse_t.begin(), state.pairs.impulse_t.end(), 0.0);
  if (perturbation.size > 0)
    displace(state.position, world.grains, perturbation.size * now.small_diameter,
             perturbation.seed);
  return {world, state};
}

}  // namespace grseg
