// SPDX-License-Identifier: GPL-3.0-or-later
#include "sim/deposition.hpp"
#include "sim/scene.hpp"

#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <cmath>
#include <map>

/// What a step of the paper's chute costs and, in wide beds, what of it a new list does. The bed is
/// deposited here and flows for two seconds first; wide beds are copies of it side by side.
namespace grseg {
namespace {

/// The chute in flow; copied by whoever changes it.
const Simulation& flow(const std::string& accuracy)
{
  namespace po = boost::program_options;
  static std::map<std::string, Simulation> made;
  if (const auto found = made.find(accuracy); found != made.end()) return found->second;
  const std::vector<std::string> words{"--accuracy", accuracy};
  po::variables_map values;
  po::store(po::command_line_parser(words).options(scene_options()).run(), values);
  const auto scene = resolve_scene(GRSEG_SCENES "/chute.ini", values);
  auto simulation = deposit(scene);
  const auto gravity = to_parameters(scene).numbers.at("gravity");
  simulation.tilt({gravity[0], gravity[1]});
  while (simulation.time() < 2) simulation.advance();
  return made.emplace(accuracy, simulation).first->second;
}

Simulation side_by_side(const Simulation& one, int copies, int threads)
{
  auto world = one.world();
  const auto grains = world.grains;
  const double length = world.box.length_x;
  world.grains = {};
  world.threads = threads;
  world.box.length_x = copies * length;
  std::vector<Vec2> position;
  for (int copy = 0; copy < copies; ++copy) {
    for (std::size_t g = 0; g < grains.size(); ++g) {
      const double x = one.position(g).x();
      position.push_back(
          {x - length * std::floor(x / length) + copy * length, one.position(g).y()});
      world.grains.id.push_back(static_cast<std::int32_t>(position.size()));
      world.grains.species.push_back(grains.species[g]);
      world.grains.radius.push_back(grains.radius[g]);
      world.grains.mass.push_back(grains.mass[g]);
      world.grains.fixed.push_back(grains.fixed[g]);
    }
  }
  Simulation wide(world, position);
  for (std::size_t g = 0; g < position.size(); ++g)
    wide.set_velocity(g, one.velocity(g % grains.size()), one.angular_velocity(g % grains.size()));
  return wide;
}

void step(benchmark::State& state, const std::string& accuracy, int copies, int threads)
{
  auto simulation = copies > 1 ? side_by_side(flow(accuracy), copies, threads) : flow(accuracy);
  for (int warm = 0; warm < 20; ++warm) simulation.advance();
  const auto renewals = simulation.pair_list_renewals();
  double sweeps = 0, contacts = 0;
  for (auto _ : state) {
    const auto report = simulation.advance();
    sweeps += report.solver.sweeps;
    contacts += static_cast<double>(report.touching);
  }
  using benchmark::Counter;
  state.counters["sweeps"] = Counter(sweeps, Counter::kAvgIterations);
  state.counters["contacts"] = Counter(contacts, Counter::kAvgIterations);
  state.counters["renewals"] = Counter(
      static_cast<double>(simulation.pair_list_renewals() - renewals), Counter::kAvgIterations);
}

void add(const std::string& accuracy, int copies, int threads, int steps)
{
  const auto name = copies > 1
                        ? fmt::format("step/{}/{}_wide/{}_threads", accuracy, copies, threads)
                        : fmt::format("step/{}", accuracy);
  auto* added = benchmark::RegisterBenchmark(name.c_str(), step, accuracy, copies, threads);
  added->Iterations(steps)->Unit(benchmark::kMicrosecond);
  if (threads > 1) added->UseRealTime();
}

}  // namespace
}  // namespace grseg

int main(int argc, char** argv)
{
  for (const char* accuracy : {"standard", "draft"}) {
    grseg::add(accuracy, 1, 1, 5000);
    for (const int threads : {1, 2}) grseg::add(accuracy, 10, threads, 300);
    for (const int threads : {1, 2}) grseg::add(accuracy, 100, threads, 60);
    for (const int threads : {1, 2}) grseg::add(accuracy, 300, threads, 30);
  }
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
}
