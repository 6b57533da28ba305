// SPDX-License-Identifier: GPL-3.0-or-later
#include "sim/run/restart.hpp"

#include "formats/core/errors.hpp"
#include "sim/scene/deposition.hpp"
#include "sim/scene/keys/keys.hpp"
#include "sim/scene/random_numbers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace grseg {
namespace {

namespace po = boost::program_options;

constexpr double whole_number_tolerance = 1e-6;  // accepted deviation, in steps

/// Options of an empty command line: all at their defaults.
po::variables_map empty_command_line()
{
  po::variables_map values;
  po::store(po::command_line_parser(std::vector<std::string>{}).options(scene_options()).run(),
            values);
  return values;
}

UsageError differs_from_checkpoint(const std::string& key)
{
  return UsageError(
      fmt::format("{} differs from the checkpoint's: it belongs to the bed, which a restart cannot "
                  "change; leave it out, or begin a new run without --restart",
                  key));
}

/// Converts the clock and the impulses, which are sums over a step, to a step of another length.
template <int D>
void change_step(typename Simulation<D>::State& state, const Scene& before, const Scene& now)
{
  if (before.step == now.step) return;
  const double time = static_cast<double>(state.steps_done) * before.step;
  const double steps = time / now.step;
  if (std::abs(steps - std::round(steps)) > whole_number_tolerance) {
    const double frames = std::floor(time / before.frame_interval + whole_number_tolerance);
    throw UsageError(fmt::format(
        "the checkpoint's time, {:.9g} s, is not a whole number of steps of {:.9g} s; choose a "
        "step that divides it, or first continue with the old step to the next frame: --duration "
        "{:.9g}",
        time, now.step, (frames + 1) * before.frame_interval));
  }
  state.steps_done = std::llround(steps);
  const double longer = now.step / before.step;
  for (auto& impulse : state.pairs.impulse_n) impulse *= longer;
  for (auto& impulse : state.pairs.impulse_t)
    for (auto& component : impulse) component *= longer;
}

/// Displaces every mobile grain by a vector that is uniform in a disc or ball of radius `largest`,
/// m.
template <int D>
void displace(std::vector<Vector<D>>& position, const Grains& grains, double largest,
              std::uint64_t seed)
{
  RandomNumbers random(seed);
  for (std::size_t g = 0; g < position.size(); ++g) {
    if (grains.fixed[g]) continue;
    const double uniform = random.uniform();
    const double distance = largest * (D == 2 ? std::sqrt(uniform) : std::cbrt(uniform));
    position[g] += distance * random.direction<D>();
  }
}

}  // namespace

Scene scene_of(const std::string& text, const std::string& name)
{
  return scene_of(text, name, empty_command_line());
}

Scene scene_of(const std::string& text, const std::string& name, const po::variables_map& given)
{
  std::vector<std::string> set_again;
  if (!given["dimension"].defaulted() &&
      given["dimension"].as<std::string>() != std::to_string(scene_of(text, name).dimension))
    throw differs_from_checkpoint("dimension");
  if (!given["accuracy"].defaulted())
    set_again.assign(keys_of_accuracy.begin(), keys_of_accuracy.end());
  if (!given["restitution"].defaulted()) {
    const auto before = scene_of(text, name);
    if (before.law == usual_law(before.restitution)) set_again.emplace_back("contact-law");
  }
  auto values = given;
  read_scene_text(text, name, set_again, values);
  return resolve_scene(values, given);
}

void require_same_bed(const Scene& before, const Scene& now)
{
  const auto key = differing_key(before, now, KeyRole::bed);
  if (!key.empty()) throw differs_from_checkpoint(key);
}

bool same_steps(const Scene& before, const Scene& now)
{
  return differing_key(before, now, KeyRole::bed).empty() &&
         differing_key(before, now, KeyRole::flow).empty();
}

template <int D>
Simulation<D> restored_simulation(const Checkpoint<D>& checkpoint, const Scene& before,
                                  const Scene& now, const Perturbation& perturbation)
{
  World<D> world;
  world.grains = checkpoint.grains;
  world.walls = checkpoint.walls;
  world.box = checkpoint.box;
  set_conditions(world, now);
  auto state = checkpoint.state;
  change_step<D>(state, before, now);
  if (now.friction == 0)  // without friction the solver does not change tangential impulses
    for (auto& impulse : state.pairs.impulse_t) impulse = {};
  if (perturbation.size > 0)
    displace<D>(state.position, world.grains, perturbation.size * now.small_diameter,
                perturbation.seed);
  return {world, state};
}

template Simulation<2> restored_simulation(const Checkpoint<2>&, const Scene&, const Scene&,
                                           const Perturbation&);
template Simulation<3> restored_simulation(const Checkpoint<3>&, const Scene&, const Scene&,
                                           const Perturbation&);

}  // namespace grseg
