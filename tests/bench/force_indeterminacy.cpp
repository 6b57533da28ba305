// SPDX-License-Identifier: GPL-3.0-or-later
// Solves the contact problem of single steps of a run again and again, to a tight tolerance, from
// other starting impulses and in other orders of the contacts, and writes each solution as a
// trajectory. scripts/force-indeterminacy runs it; docs/studies/force-indeterminacy.md reports.
#include "formats/core/errors.hpp"
#include "formats/trajectory/writer.hpp"
#include "sim/contact/contact_law-inl.hpp"
#include "sim/run/checkpoint.hpp"
#include "sim/run/provenance.hpp"
#include "sim/run/restart.hpp"
#include "sim/scene/random_numbers.hpp"
#include "sim/scene/release.hpp"
#include "tests/sim/contact_list.hpp"

#include <boost/program_options.hpp>
#include <fmt/format.h>
#include <fmt/os.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <map>
#include <numeric>
#include <optional>

namespace grseg {
namespace {

namespace law = HWY_NAMESPACE;
namespace po = boost::program_options;

/// The contact problem of one step.
struct FrozenStep {
  Frame<2> frame;                 // as the run solved it
  std::vector<Motion> before;     // at the beginning of the step, by row
  std::vector<Motion> free;       // with gravity, before contact impulses
  std::vector<Contact> contacts;  // as in `frame`; impulses are those of the run's solution
  std::vector<Contact> warm;      // the same with the impulses that the run started from
  double friction, floor;         // floor of the solver's reference, m/s
};

/// Rebounds and impulses that the step before left to a pair of rows.
struct Left {
  double impulse_n = 0, impulse_t = 0, approach = 0;
};
using LeftByPair = std::map<std::pair<std::int32_t, std::int32_t>, Left>;

LeftByPair left_to_pairs(const Simulation::State& state)
{
  LeftByPair left;
  const auto& pairs = state.pairs;
  for (std::size_t k = 0; k + 1 < pairs.i.size(); ++k) {
    const std::size_t a = pairs.i[k] / 2, b = pairs.j[k] / 2;
    if (a >= state.row.size() || b >= state.row.size()) continue;
    const auto i = state.row[a], j = state.row[b];
    const Left found{pairs.impulse_n[k], pairs.impulse_t[k], pairs.approach[k]};
    left[{i, j}] = left[{j, i}] = found;  // neither part of an impulse changes with the order
  }
  return left;
}

std::vector<Motion> motion_by_row(const Simulation& simulation)
{
  std::vector<Motion> motion;
  for (std::size_t g = 0; g < simulation.world().grains.size(); ++g)
    motion.push_back(simulation.motion(g));
  return motion;
}

/// Contact k of the step's frame, as contact_law.hpp defines it.
Contact contact_of(const FrozenStep& step, const World& world, std::size_t k, const Left& left)
{
  const auto& list = step.frame.contacts;
  Contact c{};
  c.i = list.i[k], c.j = list.j[k];
  const auto i = static_cast<std::size_t>(c.i), j = static_cast<std::size_t>(c.j);
  const double reach = world.grains.radius[i] + world.grains.radius[j];
  const Vec2 normal = list.branch[k].normalized(), tangent(-normal.y(), normal.x());
  const auto &a = step.before[i], &b = step.before[j];
  c.nx = normal.x(), c.ny = normal.y();
  c.kappa = (reach + list.gap[k]) / reach;
  c.mass_n = law::normal_mass(a.inverse_mass + b.inverse_mass, true);
  c.mass_t = law::tangential_mass(c.mass_n, c.kappa);
  const double separation = normal.dot(Vec2(a.vx - b.vx, a.vy - b.vy));
  const double e = world.material.restitution, horizon = world.law.horizon * world.step;
  const auto rebound =
      horizon > 0 ? law::rebound_of<true, true, double> : law::rebound_of<true, false, double>;
  c.rebound = rebound(list.gap[k], separation, left.impulse_n / c.mass_n, left.approach, e, horizon)
                  .velocity;
  c.impulse_n = world.step * list.force[k].dot(normal);
  c.impulse_t = world.step * list.force[k].dot(tangent);
  return c;
}

/// Lets `simulation` make one step, and keeps its contact problem.
FrozenStep freeze(Simulation& simulation)
{
  constexpr double floor_of_reference = 1e-3;  // as in simulation.cpp
  const auto& world = simulation.world();
  const auto left = left_to_pairs(simulation.state());
  FrozenStep step;
  step.before = step.free = motion_by_row(simulation);
  simulation.advance(step.frame);
  for (auto& m : step.free)
    if (m.inverse_mass > 0)
      m.vx += world.step * world.gravity.x(), m.vy += world.step * world.gravity.y();
  for (std::size_t k = 0; k < step.frame.contacts.size(); ++k) {
    const auto& list = step.frame.contacts;
    if (list.j[k] < 0) throw UsageError("the run has walls; choose one without");
    const auto found = left.find({list.i[k], list.j[k]});
    const Left own = found == left.end() ? Left{} : found->second;
    step.contacts.push_back(contact_of(step, world, k, own));
    step.warm.push_back(step.contacts.back());
    step.warm.back().impulse_n = own.impulse_n;
    step.warm.back().impulse_t = own.impulse_t;
  }
  step.friction = world.material.friction;
  step.floor = floor_of_reference * world.gravity.norm() * world.step;
  return step;
}

/// Motion after `contacts` have acted, added up anew.
std::vector<Motion> motion_after(const FrozenStep& step, const std::vector<Contact>& contacts)
{
  auto motion = step.free;
  for (const auto& c : contacts) {
    auto &a = motion[static_cast<std::size_t>(c.i)], &b = motion[static_cast<std::size_t>(c.j)];
    const double px = c.impulse_n * c.nx - c.impulse_t * c.ny;
    const double py = c.impulse_n * c.ny + c.impulse_t * c.nx;
    const double spin = disc_rim_factor * c.kappa * c.impulse_t;
    a.vx += a.inverse_mass * px, a.vy += a.inverse_mass * py, a.rim_speed -= a.inverse_mass * spin;
    b.vx -= b.inverse_mass * px, b.vy -= b.inverse_mass * py, b.rim_speed -= b.inverse_mass * spin;
  }
  return motion;
}

/// The solver's reference velocity: quadratic mean of W p, m/s.
double reference_of(const FrozenStep& step, const std::vector<Contact>& contacts)
{
  double sum = 0;
  for (const auto& c : contacts) {
    const double n = c.impulse_n / c.mass_n, t = c.impulse_t / c.mass_t;
    sum += n * n + t * t;
  }
  return std::max(step.floor, std::sqrt(sum / static_cast<double>(contacts.size())));
}

/// How far a solution is from the law, in reference velocities; of Coulomb's cone, in mean impulses.
struct Violation {
  double largest = 0;          // change of any contact relaxed alone
  double approach = 0;         // below the rebound
  double complementarity = 0;  // of p_n and u+ - rebound: the smaller of W p_n and u+ - rebound
  double cone = 0;             // |p_t| - mu p_n, and -p_n
};

Violation violation_of(const FrozenStep& step, const std::vector<Contact>& contacts)
{
  const auto motion = motion_after(step, contacts);
  const double reference = reference_of(step, contacts);
  Violation v;
  v.largest = contact_residual(contacts, motion, step.friction, {}) / reference;
  for (const auto& c : contacts) {
    const auto &a = motion[static_cast<std::size_t>(c.i)],
               &b = motion[static_cast<std::size_t>(c.j)];
    const double excess = (a.vx - b.vx) * c.nx + (a.vy - b.vy) * c.ny - c.rebound;
    v.approach = std::max(v.approach, -excess / reference);
    v.complementarity =
        std::max(v.complementarity, std::min(c.impulse_n / c.mass_n, excess) / reference);
    const double outside =
        std::max(std::abs(c.impulse_t) - step.friction * c.impulse_n, -c.impulse_n);
    v.cone = std::max(v.cone, outside / (c.mass_n * reference));
  }
  return v;
}

/// How a solution was come by.
struct Start {
  std::string name;
  enum class Kind { run, simulator, zero, warm, random } kind;
  double size = 1;  // of random impulses: their mean over that of the run's solution
  std::uint64_t seed = 1;
};

std::vector<Start> starts_of(int seeds)
{
  using Kind = Start::Kind;
  std::vector<Start> all{{"as-run", Kind::run}, {"simulator", Kind::simulator}};
  for (std::uint64_t s = 1; s <= 2; ++s) {
    all.push_back({fmt::format("zero-{}", s), Kind::zero, 0, s});
    all.push_back({fmt::format("warm-{}", s), Kind::warm, 0, s});
  }
  for (std::uint64_t s = 1; s <= static_cast<std::uint64_t>(seeds); ++s)
    all.push_back({fmt::format("random-{}", s), Kind::random, 1, s});
  for (std::uint64_t s = 1; s <= 2; ++s)
    all.push_back({fmt::format("large-random-{}", s), Kind::random, 10, s});
  return all;
}

struct Solution {
  std::vector<Contact> contacts;  // in the order of the frame
  SolverReport report;
};

/// Normal impulses are exponential, tangential ones uniform within Coulomb's cone.
void randomize(std::vector<Contact>& contacts, double mean, double friction, RandomNumbers& random)
{
  for (auto& c : contacts) {
    c.impulse_n = -mean * std::log(1 - random.uniform());
    c.impulse_t = friction * c.impulse_n * (2 * random.uniform() - 1);
  }
}

double mean_impulse(const std::vector<Contact>& contacts)
{
  double sum = 0;
  for (const auto& c : contacts) sum += c.impulse_n;
  return sum / static_cast<double>(contacts.size());
}

/// `start` of any kind but the first two, swept in a random order of its own.
Solution solve(const FrozenStep& step, const Start& start, const SolverSettings& settings)
{
  RandomNumbers random(1000 * start.seed + static_cast<std::uint64_t>(start.kind));
  auto contacts = step.warm;
  if (start.kind == Start::Kind::zero)
    for (auto& c : contacts) c.impulse_n = c.impulse_t = 0;
  if (start.kind == Start::Kind::random)
    randomize(contacts, start.size * mean_impulse(step.contacts), step.friction, random);
  std::vector<std::size_t> order(contacts.size());
  std::iota(order.begin(), order.end(), 0);
  random.shuffle(order);
  std::vector<Contact> shuffled;
  for (const auto k : order) shuffled.push_back(contacts[k]);
  auto motion = step.free;
  Solution solution;
  solution.report = solve_contacts(shuffled, motion, step.friction, {}, settings, step.floor);
  for (std::size_t k = 0; k < order.size(); ++k) contacts[order[k]] = shuffled[k];
  solution.contacts = contacts;
  return solution;
}

/// `simulation` under another solver.
Simulation with_solver(const Simulation& simulation, const Scene& scene,
                       const SolverSettings& settings)
{
  auto world = simulation.world();
  world.solver = settings;
  Simulation other(world, simulation.state());
  start_flow(other, scene);
  return other;
}

/// The next step made by the simulator itself, with its own start and order, in the contacts of
/// `step`.
Solution solve_by_simulator(Simulation simulation, const FrozenStep& step)
{
  Frame<2> frame;
  Solution solution{step.contacts, {}};
  solution.report = simulation.advance(frame).solver;
  for (std::size_t k = 0; k < frame.contacts.size(); ++k) {
    auto& c = solution.contacts[k];
    const Vec2 impulse = simulation.world().step * frame.contacts.force[k];
    c.impulse_n = impulse.dot(Vec2(c.nx, c.ny));
    c.impulse_t = impulse.dot(Vec2(-c.ny, c.nx));
  }
  return solution;
}

/// The frame that the solution would have been.
Frame<2> frame_of(const FrozenStep& step, const World& world, const std::vector<Contact>& contacts)
{
  auto frame = step.frame;
  const auto motion = motion_after(step, contacts);
  for (std::size_t k = 0; k < contacts.size(); ++k) {
    const auto& c = contacts[k];
    frame.contacts.force[k] =
        Vec2(c.impulse_n * c.nx - c.impulse_t * c.ny, c.impulse_n * c.ny + c.impulse_t * c.nx) /
        world.step;
  }
  for (std::size_t g = 0; g < motion.size(); ++g) {
    const auto &m = motion[g], &b = step.before[g];
    frame.velocity[g] = {m.vx, m.vy};
    frame.angular_velocity[g] = m.rim_speed / world.grains.radius[g];
    frame.force[g] = world.grains.mass[g] / world.step * Vec2(m.vx - b.vx, m.vy - b.vy);
  }
  return frame;
}

/// Differences of two solutions: of velocities in reference velocities, of impulses (normal and
/// tangential) in mean normal impulses.
struct Difference {
  double velocity_rms = 0, velocity_largest = 0, impulse_rms = 0, impulse_largest = 0;
};

Difference difference_of(const FrozenStep& step, const std::vector<Contact>& a,
                         const std::vector<Contact>& b)
{
  Difference d;
  const double reference = reference_of(step, b), mean = mean_impulse(b);
  const auto moved = motion_after(step, a), as = motion_after(step, b);
  for (std::size_t g = 0; g < moved.size(); ++g) {
    const Vec3 apart(moved[g].vx - as[g].vx, moved[g].vy - as[g].vy,
                     moved[g].rim_speed - as[g].rim_speed);
    d.velocity_rms += apart.squaredNorm() / (reference * reference);
    d.velocity_largest = std::max(d.velocity_largest, apart.norm() / reference);
  }
  for (std::size_t k = 0; k < a.size(); ++k) {
    const Vec2 apart(a[k].impulse_n - b[k].impulse_n, a[k].impulse_t - b[k].impulse_t);
    d.impulse_rms += apart.squaredNorm() / (mean * mean);
    d.impulse_largest = std::max(d.impulse_largest, apart.norm() / mean);
  }
  d.velocity_rms = std::sqrt(d.velocity_rms / static_cast<double>(moved.size()));
  d.impulse_rms = std::sqrt(d.impulse_rms / static_cast<double>(a.size()));
  return d;
}

/// Forces that a solution leaves open, counted: components of force that are not given by Coulomb's
/// law (two of a contact that sticks, one of one that slides), and equations of motion of the grains
/// that they act on. Where there are more components than equations, forces cannot be unique.
struct Count {
  std::size_t bearing = 0, sliding = 0, grains = 0;

  std::size_t components() const { return 2 * bearing - sliding; }
  std::size_t equations() const { return 3 * grains; }
};

Count count_of(const FrozenStep& step, const std::vector<Contact>& contacts)
{
  constexpr double round_off = 1e-9;
  Count count;
  std::vector<std::uint8_t> loaded(step.free.size());
  for (const auto& c : contacts) {
    if (c.impulse_n <= 0) continue;
    ++count.bearing;
    const double limit = (1 - round_off) * step.friction * c.impulse_n;
    count.sliding += std::abs(c.impulse_t) >= limit ? 1 : 0;
    for (const auto g : {static_cast<std::size_t>(c.i), static_cast<std::size_t>(c.j)})
      loaded[g] = step.free[g].inverse_mass > 0 ? 1 : 0;
  }
  count.grains = static_cast<std::size_t>(std::count(loaded.begin(), loaded.end(), 1));
  return count;
}

constexpr auto heads =
    "frame\ttime[s]\tsolution\tsweeps\tresidual\tviolation\tapproach\tcomplementarity\tcone\t"
    "velocity_rms\tvelocity_largest\timpulse_rms\timpulse_largest\tbearing\tsliding\tcomponents\t"
    "equations\n";

/// A row of solutions.tsv.
void write_row(fmt::ostream& table, int n, const FrozenStep& step, const std::string& name,
               const Solution& solution, const std::vector<Contact>& reference)
{
  const auto v = violation_of(step, solution.contacts);
  const auto d = difference_of(step, solution.contacts, reference);
  const auto count = count_of(step, solution.contacts);
  table.print("{}\t{:.9g}\t{}\t{}\t{:.3g}", n, step.frame.time, name, solution.report.sweeps,
              solution.report.residual);
  for (const double x : {v.largest, v.approach, v.complementarity, v.cone, d.velocity_rms,
                         d.velocity_largest, d.impulse_rms, d.impulse_largest})
    table.print("\t{:.3g}", x);
  table.print("\t{}\t{}\t{}\t{}\n", count.bearing, count.sliding, count.components(),
              count.equations());
}

struct Given {
  std::string checkpoint, folder;
  int frames = 50, seeds = 8, exact_steps = 0;
  double interval = 0.25;
  SolverSettings settings;
};

std::optional<Given> read_command_line(int argc, char** argv)
{
  Given given;
  given.settings.acceleration = true;
  po::options_description options(
      "force_indeterminacy CHECKPOINT FOLDER [options]: solves steps of a run again and again\n");
  auto value = [](auto& to) { return po::value(&to)->default_value(to); };
  given.settings.tolerance = 1e-8, given.settings.max_sweeps = 20000;
  options.add_options()("checkpoint", po::value(&given.checkpoint)->required(), "of a run")(
      "folder", po::value(&given.folder)->required(), "for START.h5 and solutions.tsv")(
      "frames", value(given.frames), "steps that are solved")(
      "interval", value(given.interval), "s between them")("seeds", value(given.seeds),
                                                           "random starts")(
      "exact-steps", value(given.exact_steps),
      "steps before each of them that are made at the tolerance, too")(
      "tolerance", value(given.settings.tolerance), "of the solver")(
      "max-sweeps", value(given.settings.max_sweeps), "of the solver")("help", "this text");
  po::positional_options_description place;
  place.add("checkpoint", 1).add("folder", 1);
  po::variables_map values;
  po::store(po::command_line_parser(argc, argv).options(options).positional(place).run(), values);
  if (values.count("help") > 0) {
    std::cout << options;
    return {};
  }
  po::notify(values);
  return given;
}

void solve_all(const Given& given)
{
  const auto checkpoint = read_checkpoint(given.checkpoint);
  const auto scene = scene_of(checkpoint, given.checkpoint);
  auto simulation = restored_simulation(checkpoint, scene, scene, {});
  start_flow(simulation, scene);
  std::filesystem::create_directories(given.folder);
  auto table = fmt::output_file(given.folder + "/solutions.tsv");
  table.print(heads);
  const auto starts = starts_of(given.seeds);
  std::vector<TrajectoryWriter> writers;
  auto parameters = provenance(scene, {});
  parameters.numbers["frame_interval"] = {given.interval};
  const RunDescription description{
      simulation.world().grains, simulation.world().box, parameters, {}};
  for (const auto& start : starts)
    writers.emplace_back(fmt::format("{}/{}.h5", given.folder, start.name), description);
  const auto steps_between = std::llround(given.interval / scene.step);
  if (steps_between <= given.exact_steps)
    throw UsageError("--exact-steps: choose fewer, or a longer --interval");
  for (int n = 0; n < given.frames; ++n) {
    for (std::int64_t k = 1; k < steps_between - given.exact_steps; ++k) simulation.advance();
    auto exact = with_solver(simulation, scene, given.settings);
    for (int k = 0; k < given.exact_steps; ++k) exact.advance();
    simulation = with_solver(exact, scene, scene.solver);
    const auto step = freeze(simulation);
    const auto simulator = solve_by_simulator(exact, step);
    for (std::size_t s = 0; s < starts.size(); ++s) {
      const auto kind = starts[s].kind;
      const auto solution = kind == Start::Kind::run ? Solution{step.contacts, {}}
                            : kind == Start::Kind::simulator
                                ? simulator
                                : solve(step, starts[s], given.settings);
      write_row(table, n, step, starts[s].name, solution, simulator.contacts);
      writers[s].append(frame_of(step, simulation.world(), solution.contacts), {});
    }
    table.flush();
  }
  for (auto& writer : writers) writer.close();
}

}  // namespace
}  // namespace grseg

int main(int argc, char** argv)
{
  try {
    if (const auto given = grseg::read_command_line(argc, argv)) grseg::solve_all(*given);
  } catch (const std::exception& error) {
    fmt::print(stderr, "force_indeterminacy: {}\n", error.what());
    return 1;
  }
}
