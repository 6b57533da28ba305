// SPDX-License-Identifier: GPL-3.0-or-later
#include "sim/recorder.hpp"
#include "tests/bench/flow.hpp"

#include <benchmark/benchmark.h>
#include <unistd.h>

#include <filesystem>

/// What it gains to leave out an effect that the paper's chute does not call for. Both runs of a
/// pair take the same steps from the same state to the same bytes: `with` in kernels that see to
/// the effect, at its neutral coefficient, `without` in those that leave it out
/// (tests/sim/effects_test.cpp).
namespace grseg {
namespace {

constexpr int steps = 1000;

using Change = void (*)(World&);

/// The chute in flow, without spin, under the conditions that `changes` make.
Simulation chute(const std::vector<Change>& changes)
{
  const auto& one = flow("standard");
  auto world = one.world();
  for (const auto change : changes) change(world);
  auto simulation = side_by_side(one, world, 1);
  for (std::size_t g = 0; g < world.grains.size(); ++g)
    simulation.set_velocity(g, simulation.velocity(g));
  for (int warm = 0; warm < 20; ++warm) simulation.advance();
  return simulation;
}

void advance(benchmark::State& state, const std::vector<Change>& changes)
{
  auto simulation = chute(changes);
  double sweeps = 0, contacts = 0;
  for (auto _ : state) {
    const auto report = simulation.advance();
    sweeps += report.solver.sweeps;
    contacts += static_cast<double>(report.touching);
  }
  using benchmark::Counter;
  state.counters["sweeps"] = Counter(sweeps, Counter::kAvgIterations);
  state.counters["contacts"] = Counter(contacts, Counter::kAvgIterations);
  state.counters["energy"] = simulation.translational_energy();
}

void write_down(benchmark::State& state)
{
  auto simulation = chute({});
  Frame frame;
  for (auto _ : state) simulation.advance(frame);
  state.counters["energy"] = simulation.translational_energy();
}

void write_to_file(benchmark::State& state)
{
  auto simulation = chute({});
  const auto path = (std::filesystem::temp_directory_path() /
                     ("grseg_effects_bench_" + std::to_string(getpid()) + ".h5"))
                        .string();
  TrajectoryWriter writer(
      path, {simulation.world().grains, simulation.world().box, {}, Recorder::observables()});
  Recorder recorder(writer, 2 * simulation.world().skin);
  Frame frame;
  for (auto _ : state) {
    recorder.add(simulation.advance(frame));
    recorder.write(frame, simulation);
  }
  state.counters["energy"] = simulation.translational_energy();
  writer.close();
  std::filesystem::remove(path);
}

template <class... Arguments>
void add(const std::string& name, Arguments... arguments)
{
  benchmark::RegisterBenchmark(name.c_str(), arguments...)
      ->Iterations(steps)
      ->Unit(benchmark::kMicrosecond);
}

void add_pair(const std::string& name, std::vector<Change> with, std::vector<Change> without)
{
  add("with/" + name, advance, std::move(with));
  add("without/" + name, advance, std::move(without));
}

void add_all()
{
  const Change general = [](World& w) { w.general = true; };
  const Change smooth = [](World& w) { w.material.friction = 0; };
  const Change unturned = [](World& w) { w.rotation = false; };
  const Change inelastic = [](World& w) { w.material.restitution = 0; };
  const Change between_walls = [](World& w) {
    w.walls = {{{0, 0}, {1, 0}}, {{w.box.length_x, 0}, {-1, 0}}};
    w.box.periodic_x = false;
  };
  const Change faint_gravity = [](World& w) { w.gravity = {1e-200, -1e-200}; };
  const Change weightless = [](World& w) { w.gravity = Vec2::Zero(); };

  add_pair("friction", {smooth, general}, {smooth});
  // Nothing spins without friction.
  add_pair("rotation", {smooth, general}, {smooth, general, unturned});
  add_pair("restitution", {inelastic, general}, {inelastic});
  add_pair("periodicity", {between_walls, general}, {between_walls});
  add_pair("gravity", {faint_gravity}, {weightless});
  add_pair("all_but_gravity", {smooth, inelastic, between_walls, general},
           {smooth, inelastic, between_walls, unturned});
  add("without/frames", advance, std::vector<Change>{});
  add("with/frames", write_down);
  add("with/frames_in_a_file", write_to_file);
}

}  // namespace
}  // namespace grseg

int main(int argc, char** argv)
{
  grseg::add_all();
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
}
