// SPDX-License-Identifier: GPL-3.0-or-later
#include "sim/scene/deposition.hpp"

#include "formats/core/errors.hpp"
#include "sim/scene/geometry.hpp"
#include "sim/scene/packing.hpp"
#include "sim/scene/random_numbers.hpp"
#include "sim/step/energies.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <optional>
#include <span>
#include <utility>

namespace grseg {
namespace {

// An attempt is slow if it needs more than `slow_step` sweeps a step. Heavy grains above light ones do;
// an ordinary bed needs 7 to 10. Once slow attempts have cost `most_sweeps`, half a minute for a hundred
// grains, the tolerance is wider.
constexpr double slow_step = 1000, most_sweeps = 3e6, tolerance_if_slow = 0.1;
// Solid fraction of a deposit of discs, and of spheres, for the first attempt.
constexpr double usual_solid_fraction = 0.81, usual_of_spheres = 0.61;
// Number of attempts at a bed of the right depth. The height of a bed of a few grains is random, but
// attempts cost little: they go on until so many grains have been deposited.
constexpr int most_attempts = 20;
constexpr std::size_t most_deposited = 10000;
// Number of beds that are too high though all their grains are the --large-grains asked for. No
// further attempt has fewer grains.
constexpr int most_too_high = 5;
constexpr double most_growth = 2;  // of the volume, from one attempt to the next

/// Grain at its place above the base, before it falls.
struct Falling {
  Species species;
  double radius;  // m
  Vec3 at;        // m, position of its centre
};

/// How tightly grains are placed before they fall.
struct Tightness {
  double spacing;  // of the lattice, in largest diameters
  /// Mixed grains are in layers of one species, each with a lattice of its own. Otherwise every cell
  /// of the lattice is wide enough for a large grain.
  bool in_layers;
};
// Each is for grains that need too much room with the one before, as in a well filled drum.
constexpr double touching = 1 + 1e-9;
constexpr Tightness tightnesses[] = {{1.12, false}, {touching, false}, {touching, true}};

/// All grains before they fall, on a lattice.
struct Shower {
  std::vector<Falling> grains;
  double top;  // m, height above which there are none
  Tightness tightness;
};

/// Square or cube of the lattice on which grains are placed before they fall. It contains one grain
/// of the lattice's largest species, or smaller ones, up to `per_side` along each side.
struct Cell {
  Species species;
  long per_side, grains;
};

double nominal_diameter(const Scene& scene, Species species)
{
  return species == Species::large ? scene.large_diameter : scene.small_diameter;
}

/// Layer of cells: left edge and bottom, m; size of a cell along x, z and y, m; number of cells
/// along x.
struct Layer {
  double left, bottom, along_x, along_z, height;
  long per_row;
};

/// Adds the grains of the cell at `place` of `layer`, with random displacements.
void fill_cell(Shower& shower, const Scene& scene, const Layer& layer, long place, const Cell& cell,
               RandomNumbers& random)
{
  const double nominal = nominal_diameter(scene, cell.species);
  const double largest = nominal * (1 + scene.spread / 2);
  const auto per_side = static_cast<double>(cell.per_side);
  const auto jitter = [&](double side) {
    return (side / per_side - largest) * (random.uniform() - 0.5);
  };
  const auto within = [&](long index) { return (static_cast<double>(index) + 0.5) / per_side; };
  const long squared = cell.per_side * cell.per_side;
  for (long k = 0; k < cell.grains; ++k) {
    const bool cube = scene.dimension == 3;
    const long above = cube ? k / squared : k / cell.per_side;  // whole rows or layers of grains
    const double diameter = nominal * (1 + scene.spread * (random.uniform() - 0.5));
    const double x =
        layer.left +
        (static_cast<double>(place % layer.per_row) + within(k % cell.per_side)) * layer.along_x +
        jitter(layer.along_x);
    const double y = layer.bottom + within(above) * layer.height + jitter(layer.height);
    const long row = place / layer.per_row;
    double z = 0;
    if (cube)
      z = (static_cast<double>(row) + within(k % squared / cell.per_side)) * layer.along_z +
          jitter(layer.along_z);
    shower.grains.push_back({cell.species, diameter / 2, {x, y, z}});
  }
}

/// Adds the next layer. It takes as many `cells` as fit, which are as wide as grains of the species
/// `lattice` need, from their front.
void add_layer(Shower& shower, const Scene& scene, std::span<const Cell>& cells, Species lattice,
               RandomNumbers& random)
{
  const double side =
      shower.tightness.spacing * (nominal_diameter(scene, lattice) * (1 + scene.spread / 2));
  const long rows = scene.dimension == 3 ? static_cast<long>(scene.width / side) : 1;
  const double along_z = scene.width / static_cast<double>(rows);
  const double y = shower.top;
  shower.top += side;
  const auto below = room_at(scene, y), above = room_at(scene, shower.top);
  const double left = std::max(below.left, above.left);
  const double width = std::min(below.right, above.right) - left;
  const long per_row = static_cast<long>(width / side);
  if (per_row < 1 && above.right - above.left <= below.right - below.left)
    throw UsageError(
        fmt::format("the grains do not fit before they fall: the {} is too narrow for another one "
                    "at a height of {:.4g} m; choose a smaller {}{}, or a wider {}",
                    scene.geometry->name, y, scene.geometry->checks_height ? "depth" : "fill",
                    scene.initial == Scene::Initial::mixed ? ", or initial = large-below" : "",
                    scene.geometry->name));
  if (per_row < 1) return;
  const double along_x = width / static_cast<double>(per_row);
  const Layer layer{left, y, along_x, along_z, side, per_row};
  const long taken = std::min(per_row * rows, std::ssize(cells));
  for (long place = 0; place < taken; ++place)
    fill_cell(shower, scene, layer, place, cells[static_cast<std::size_t>(place)], random);
  cells = cells.subspan(static_cast<std::size_t>(taken));
}

void add_layers(Shower& shower, const Scene& scene, std::span<const Cell> cells, Species lattice,
                RandomNumbers& random)
{
  while (!cells.empty()) add_layer(shower, scene, cells, lattice, random);
}

/// Adds layers of the one and the other species in random order, each as likely as its share of the
/// grains' volume that is left.
void add_layers_of_either(Shower& shower, const Scene& scene, std::span<const Cell> large,
                          std::span<const Cell> small, RandomNumbers& random)
{
  while (!large.empty() || !small.empty()) {
    const double of_large = static_cast<double>(large.size()) *
                            nominal_volume(scene, scene.large_diameter),
                 of_small = static_cast<double>(small.size()) *
                            nominal_volume(scene, scene.small_diameter);
    if (random.uniform() * (of_large + of_small) < of_large)
      add_layer(shower, scene, large, Species::large, random);
    else
      add_layer(shower, scene, small, Species::small, random);
  }
}

std::vector<Cell> cells_of_one(Species species, long count)
{
  return std::vector<Cell>(static_cast<std::size_t>(count), Cell{species, 1, 1});
}

/// Cells of grains of both species, sized for large grains, in random order.
std::vector<Cell> mixed_cells(const Scene& scene, long large, long small, RandomNumbers& random)
{
  constexpr double round_off = 1e-9;
  const double ratio = scene.large_diameter / scene.small_diameter;
  const long per_side = std::lround(std::floor(ratio + round_off));
  auto cells = cells_of_one(Species::large, large);
  const long in_cell = scene.dimension == 3 ? per_side * per_side * per_side : per_side * per_side;
  for (long left = small; left > 0; left -= in_cell)
    cells.push_back({Species::small, per_side, std::min(left, in_cell)});
  random.shuffle(cells);
  return cells;
}

/// Numbers of mobile grains.
struct Numbers {
  long large, small;
};

/// Grains above `bottom`, m, in the arrangement Scene::initial; large grains first in the list.
Shower shower_of(const Scene& scene, Numbers count, double bottom, const Tightness& tightness,
                 RandomNumbers& random)
{
  const auto [large, small] = count;
  Shower shower{{}, bottom, tightness};
  const auto add = [&](Species lattice, const std::vector<Cell>& cells) {
    add_layers(shower, scene, cells, lattice, random);
  };
  const auto all_large = cells_of_one(Species::large, large);
  const auto all_small = cells_of_one(Species::small, small);
  switch (scene.initial) {
    case Scene::Initial::large_below:
      add(Species::large, all_large), add(Species::small, all_small);
      break;
    case Scene::Initial::mixed:
      if (tightness.in_layers)
        add_layers_of_either(shower, scene, all_large, all_small, random);
      else
        add(Species::large, mixed_cells(scene, large, small, random));
      break;
    case Scene::Initial::large_above:
      add(Species::small, all_small), add(Species::large, all_large);
      break;
  }
  std::stable_partition(shower.grains.begin(), shower.grains.end(),
                        [](const Falling& grain) { return grain.species == Species::large; });
  return shower;
}

/// Grains as loose as `tightnesses` allow; throws the last one's UsageError if none fits.
Shower first_that_fits(const Scene& scene, Numbers count, double bottom, RandomNumbers& random)
{
  const bool may_be_layered = scene.initial == Scene::Initial::mixed;
  const auto* last = std::end(tightnesses) - (may_be_layered ? 1 : 2);
  for (const auto* tightness = std::begin(tightnesses);; ++tightness) try {
      return shower_of(scene, count, bottom, *tightness, random);
    } catch (const UsageError&) {
      if (tightness == last) throw;
    }
}

/// Numbers of mobile grains that fill `volume`, m^2 or m^3.
Numbers numbers_of(const Scene& scene, double volume)
{
  const double of_large = nominal_volume(scene, scene.large_diameter);
  const long large = scene.large_grains.value_or(std::lround(scene.phi_large * volume / of_large));
  const double left = scene.large_grains
                          ? std::max(0.0, volume - static_cast<double>(large) * of_large)
                          : (1 - scene.phi_large) * volume;
  return {large, std::lround(left / nominal_volume(scene, scene.small_diameter))};
}

/// Area or volume of the mobile grains in the first attempt, m^2 or m^3.
double usual_volume(const Scene& scene)
{
  return (scene.dimension == 3 ? usual_of_spheres : usual_solid_fraction) * bed_area(scene);
}

/// Base and falling grains of a bed whose mobile grains fill `volume`, m^2 or m^3. Calls `layered` if
/// they are mixed, but in layers of one species.
Packing loose_packing(const Scene& scene, double volume, const std::function<void()>& layered,
                      RandomNumbers& random)
{
  Packing packing;
  const auto count = numbers_of(scene, volume);
  if (count.large + count.small == 0)
    throw UsageError("the bed has no grain; choose a larger depth or length, or smaller grains");
  const auto boundaries = scene.geometry->boundaries(scene);
  const auto shower = first_that_fits(scene, count, boundaries.top, random);
  if (layered && shower.tightness.in_layers) layered();
  packing.walls = boundaries.walls;
  packing.box = {scene.length, 1.5 * shower.top, scene.lateral == Scene::Lateral::periodic};
  if (scene.dimension == 3) {
    packing.box.dimension = 3;
    packing.box.length_z = scene.width;
    packing.box.periodic_z = scene.sides == Scene::Lateral::periodic;
  }
  const double of_large_grains = scene.density * scene.density_ratio;
  for (const auto& grain : shower.grains)
    add_grain(packing, grain.species, grain.radius,
              grain.species == Species::large ? of_large_grains : scene.density, grain.at);
  for (std::size_t k = 0; k < boundaries.position.size(); ++k)
    add_grain(packing, Species::boundary, boundaries.radius[k], scene.density,
              boundaries.position[k]);
  return packing;
}

/// Gives the grains of a falling bed random velocities, so that it does not land as a lattice.
void set_falling(Packing& packing, const Scene& scene, RandomNumbers& random)
{
  const double speed = 0.5 * std::sqrt(scene.gravity * scene.small_diameter);
  for (auto& velocity : packing.velocity)
    for (int k = 0; k < scene.dimension; ++k) velocity[k] = random.gaussian(speed);
}

/// Times at which a deposition checks whether the bed rests.
struct Looks {
  std::int64_t every;  // steps from check to check
  double first;        // s, time of the first check, so that the free fall is not taken for rest
  double impatient;    // s, time from which on grains are slowed down
  double patience;  // s, time that slowed grains have to come to rest, after the highest has landed
};

Looks looks_of(const Scene& scene)
{
  const double fall = std::sqrt(2 * scene.depth / scene.gravity);
  const double between = 2 * std::sqrt(scene.small_diameter / scene.gravity);
  return {static_cast<std::int64_t>(std::ceil(between / scene.step)),
          std::sqrt(2 * 0.2 * scene.depth / scene.gravity), 10 * fall, 10 * fall};
}

template <int D>
void set_restitution(double restitution, Simulation<D>& simulation)
{
  auto world = simulation.world();
  if (world.material.restitution == restitution) return;
  world.material.restitution = restitution;
  simulation = Simulation<D>(world, simulation.state());
}

/// If a check is due after `steps` steps and later than Looks::impatient, sets restitution to 0,
/// halves the velocities of mobile grains and returns true. What falls goes on falling, so that
/// grains that were thrown up land in time.
template <int D>
bool slow_down(Simulation<D>& simulation, std::int64_t steps, const Scene& scene,
               const Looks& looks)
{
  if (steps % looks.every != 0 || static_cast<double>(steps) * scene.step < looks.impatient)
    return false;
  set_restitution(0, simulation);
  const auto& grains = simulation.world().grains;
  for (std::size_t g = 0; g < grains.size(); ++g) {
    if (grains.fixed[g]) continue;
    Vector<D> velocity = simulation.velocity(g) / 2;
    if (velocity.y() < 0) velocity.y() *= 2;
    simulation.set_velocity(g, velocity, simulation.angular_velocity(g) / 2);
  }
  return true;
}

/// Time in which the highest grain would fall to y = 0, s.
template <int D>
double fall_of_highest(const Simulation<D>& simulation, const Scene& scene)
{
  double highest = 0;
  for (std::size_t g = 0; g < simulation.world().grains.size(); ++g)
    highest = std::max(highest, simulation.position(g).y());
  return std::sqrt(2 * highest / scene.gravity);
}

/// Number of steps in which a bed has come to rest, and of their sweeps.
struct Settled {
  std::int64_t steps = 0;
  double sweeps = 0;

  bool is_slow() const { return sweeps > slow_step * static_cast<double>(steps); }
};

/// Lets the bed fall until it rests. Throws RunError if it still moves after its grains were slowed
/// down.
template <int D>
Settled settle(Simulation<D>& simulation, const Scene& scene, const DepositionHooks<D>& hooks)
{
  const double at_rest =
      2e-3 * mobile_mass(simulation.world().grains) * scene.gravity * scene.small_diameter;
  const auto looks = looks_of(scene);
  double energy = 0, sweeps = 0, last = looks.impatient + looks.patience;
  bool is_slowed = false;
  while (simulation.time() < last) {
    for (std::int64_t k = 0; k < looks.every; ++k) {
      sweeps += simulation.advance().solver.sweeps;
      if (hooks.each_step) hooks.each_step(simulation.time());
    }
    energy = translational_energy(simulation) + rotational_energy(simulation);
    if (simulation.time() > looks.first && energy < at_rest) {
      set_restitution(scene.restitution, simulation);
      return {simulation.steps_done(), sweeps};
    }
    if (!slow_down(simulation, simulation.steps_done(), scene, looks)) continue;
    if (!is_slowed) last = simulation.time() + fall_of_highest(simulation, scene) + looks.patience;
    is_slowed = true;
    if (hooks.slowed) hooks.slowed(simulation.time());
  }
  throw RunError(fmt::format(
      "the bed has not come to rest {:.3g} s after its release, although its grains were slowed "
      "down: its kinetic energy is {:.2g} times the limit for rest; choose a larger min-sweeps, "
      "now {}, or a smaller step",
      simulation.time(), energy / at_rest, scene.solver.min_sweeps));
}

/// Repeats a deposition of `steps` steps, which end at time 0, and calls hooks.record.
template <int D>
void replay(Simulation<D>& simulation, std::int64_t steps, const Scene& scene,
            const DepositionHooks<D>& hooks)
{
  Frame<D> frame;
  const auto looks = looks_of(scene);
  simulation.set_clock(-steps);
  while (simulation.steps_done() < 0) {
    const bool due = simulation.steps_done() % scene.steps_per_frame() == 0;
    const auto report = due ? simulation.advance(frame) : simulation.advance();
    hooks.record(report, simulation, due ? &frame : nullptr);
    if (hooks.each_step) hooks.each_step(simulation.time());
    if (simulation.steps_done() < 0)
      slow_down(simulation, steps + simulation.steps_done(), scene, looks);
  }
  set_restitution(scene.restitution, simulation);
}

}  // namespace

template <int D>
void set_conditions(World<D>& world, const Scene& scene)
{
  world.material = {scene.friction, scene.restitution};
  world.rotation = scene.rotation;
  world.gravity = -scene.gravity * Vector<D>::UnitY();
  world.step = scene.step;
  world.solver = scene.solver;
  world.threads = scene.threads;
  world.law = law_parameters(scene);
}

template <int D>
double bed_height(const Simulation<D>& simulation, double base_top)
{
  const auto& grains = simulation.world().grains;
  double area = 0, moment = 0;
  for (std::size_t g = 0; g < grains.size(); ++g) {
    if (grains.fixed[g]) continue;
    const double own = std::pow(grains.radius[g], D);
    area += own;
    moment += own * simulation.position(g).y();
  }
  return area > 0 ? 2 * moment / area - base_top : base_top;
}

double expected_grains(const Scene& scene)
{
  constexpr double too_many_to_build = 1e8;  // boundaries of such scenes fill the memory, too
  const auto [large, small] = numbers_of(scene, usual_volume(scene));
  const double mobile = static_cast<double>(large) + static_cast<double>(small);
  if (mobile > too_many_to_build) return mobile;
  return mobile + static_cast<double>(scene.geometry->boundaries(scene).position.size());
}

double expected_time_to_rest(const Scene& scene)
{
  constexpr double falls = 1.2;  // times of free fall; measured on beds of 20 to 80 d_S
  return falls * std::sqrt(2 * scene.depth / scene.gravity);
}

namespace {

/// A bed that has come to rest: before its fall and after it, and its distance from Scene::depth,
/// over this depth.
template <int D>
struct Bed {
  Simulation<D> falling, resting;
  std::int64_t steps;
  double off;
};

/// The bed at time 0. Its deposition is repeated if it is to be recorded.
template <int D>
Simulation<D> finished(Bed<D>& bed, const Scene& scene, const DepositionHooks<D>& hooks)
{
  auto& simulation = hooks.record ? bed.falling : bed.resting;
  if (hooks.record) replay(simulation, bed.steps, scene, hooks);
  simulation.set_clock(0);
  return std::move(simulation);
}

}  // namespace

template <int D>
Simulation<D> deposit(const Scene& scene, const DepositionHooks<D>& hooks)
{
  double volume = usual_volume(scene), sweeps = 0;
  // Not seeded again in each attempt: the height of a shallow bed varies by more than 2 %, so each
  // attempt needs other random numbers.
  RandomNumbers random(scene.seed);
  std::optional<Bed<D>> closest;  // of slow attempts
  int attempts = 0, too_high = 0;
  for (std::size_t deposited = 0;
       (attempts < most_attempts || deposited < most_deposited) && too_high < most_too_high;
       ++attempts) {
    auto packing = loose_packing(scene, volume, hooks.layered, random);
    deposited += packing.grains.size();
    set_falling(packing, scene, random);
    auto falling = simulation_of<D>(packing, scene);
    auto resting = falling;
    const auto settled = settle(resting, scene, hooks);
    const double height = bed_height(resting, scene.geometry->boundaries(scene).top);
    const double off =
        scene.geometry->checks_height ? std::abs(height - scene.depth) / scene.depth : 0;
    Bed<D> bed{std::move(falling), std::move(resting), settled.steps, off};
    if (bed.off <= depth_tolerance) return finished(bed, scene, hooks);
    if (settled.is_slow()) {
      sweeps += settled.sweeps;
      if (!closest || bed.off < closest->off) closest.emplace(std::move(bed));
      if (sweeps > most_sweeps && closest->off <= tolerance_if_slow)
        return finished(*closest, scene, hooks);
    }
    too_high += scene.large_grains && height > scene.depth && numbers_of(scene, volume).small == 0;
    volume *=
        height > 0 ? std::clamp(scene.depth / height, 1 / most_growth, most_growth) : most_growth;
  }
  throw RunError(fmt::format(
      "no bed of depth {:.4g} m could be deposited in {} attempts; is it only a few grains deep, or "
      "do its large grains alone fill more?",
      scene.depth, attempts));
}

template void set_conditions(World<2>&, const Scene&);
template double bed_height(const Simulation<2>&, double);
template Simulation<2> deposit(const Scene&, const DepositionHooks<2>&);
template void set_conditions(World<3>&, const Scene&);
template double bed_height(const Simulation<3>&, double);
template Simulation<3> deposit(const Scene&, const DepositionHooks<3>&);

}  // namespace grseg
