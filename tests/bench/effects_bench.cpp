// SPDX-License-Identifier: GPL-3.0-or-later
#include "sim/run/recorder.hpp"
#include "sim/run/summary.hpp"
#include "tests/bench/flow.hpp"

#include <benchmark/benchmark.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <ctime>
#include <filesystem>
#include <functional>

/// Time saved by leaving out an effect that a chute does not need. Two runs from one state take the
/// same steps to the same bytes, in turn: `with` in kernels that compute the effect, at its neutral
/// coefficient, `without` in kernels that leave it out (tests/sim/solver/effects_test.cpp). Times are
/// processor time per step, s; `gain` is with / without.
namespace grseg {
namespace {

constexpr int turns = 100, steps_per_turn = 10;

using Change = void (*)(World<2>&);

/// The developed chute, without spin, with the conditions changed by `changes`.
Simulation<2> chute(const std::vector<Change>& changes)
{
  const auto one = flow<2>("standard");
  auto world = one.world();
  for (const auto change : changes) change(world);
  auto simulation = side_by_side(one, world, 1);
  for (std::size_t g = 0; g < world.grains.size(); ++g)
    simulation.set_velocity(g, simulation.velocity(g));
  for (int warm = 0; warm < 20; ++warm) simulation.advance();
  return simulation;
}

double processor_time()
{
  timespec now;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

struct Run {
  Simulation<2> simulation;
  std::function<StepReport(Simulation<2>&)> step = [](Simulation<2>& s) { return s.advance(); };
  double seconds = 0, sweeps = 0, contacts = 0;

  void take_turn()
  {
    const double begin = processor_time();
    for (int k = 0; k < steps_per_turn; ++k) {
      const auto report = step(simulation);
      sweeps += report.solver.sweeps;
      contacts += static_cast<double>(report.touching);
    }
    seconds += processor_time() - begin;
  }
};

bool in_the_same_state(const Simulation<2>& a, const Simulation<2>& b)
{
  const auto s = a.state(), t = b.state();
  return s.position == t.position && s.velocity == t.velocity && s.rim == t.rim;
}

void compare(benchmark::State& state, Run with, Run without)
{
  for (auto _ : state) {
    with.take_turn();
    without.take_turn();
  }
  if (!in_the_same_state(with.simulation, without.simulation))
    state.SkipWithError("the two runs are not the same");
  const double steps = static_cast<double>(state.iterations()) * steps_per_turn;
  state.counters["with"] = with.seconds / steps;
  state.counters["without"] = without.seconds / steps;
  state.counters["gain"] = with.seconds / without.seconds;
  state.counters["sweeps"] = without.sweeps / steps;
  state.counters["touching"] = without.contacts / steps;
}

void leave_out(benchmark::State& state, const std::vector<Change>& with,
               const std::vector<Change>& without)
{
  compare(state, {chute(with)}, {chute(without)});
}

void frames(benchmark::State& state)
{
  Frame<2> frame;
  const auto write_down = [&](Simulation<2>& s) { return s.advance(frame); };
  compare(state, {chute({}), write_down}, {chute({})});
}

void frames_in_a_file(benchmark::State& state)
{
  const auto start = chute({});
  const auto path = (std::filesystem::temp_directory_path() /
                     ("grseg_effects_bench_" + std::to_string(getpid()) + ".h5"))
                        .string();
  TrajectoryWriter writer(path,
                          {start.world().grains, start.world().box, {}, Recorder::observables(2)});
  Recorder recorder(writer, 2 * start.world().skin);  // the skin is half a diameter
  Frame<2> frame;
  const auto record = [&](Simulation<2>& s) {
    auto report = s.advance(frame);
    recorder.add(report);
    recorder.write(frame, s);
    return report;
  };
  compare(state, {start, record}, {start});
  writer.close();
  std::filesystem::remove(path);
}

/// A scene in kernels that compute every effect, including moving boundary bodies (here they are at
/// rest), compared with its own kernels. In a scene without gravity, a faint gravity would not give
/// the same bytes (tests/sim/solver/effects_test.cpp), so both leave out gravity.
void whole_scene(benchmark::State& state, const std::string& name, double time)
{
  const auto start = scene_at(time, name);
  auto world = start.world();
  world.general = true;
  if (world.bodies.empty()) {
    const auto& fixed = world.grains.fixed;
    BoundaryBody still;
    still.begin =
        static_cast<std::uint32_t>(std::find(fixed.begin(), fixed.end(), 1) - fixed.begin());
    still.end = static_cast<std::uint32_t>(fixed.size());
    world.bodies = {still};
  }
  compare(state, {Simulation<2>(world, start.state())},
          {Simulation<2>(start.world(), start.state())});
  state.counters["grains"] = static_cast<double>(world.grains.size());
  state.SetLabel(effects_left_out(scene_called(name)));
}

template <class... Arguments>
void add(const char* name, Arguments... arguments)
{
  benchmark::RegisterBenchmark(name, arguments...)
      ->Iterations(turns)
      ->Unit(benchmark::kMillisecond);
}

void add_all()
{
  using Changes = std::vector<Change>;
  const Change general = [](World<2>& w) { w.general = true; };
  const Change smooth = [](World<2>& w) { w.material.friction = 0; };
  const Change unturned = [](World<2>& w) { w.rotation = false; };
  const Change inelastic = [](World<2>& w) { w.material.restitution = 0; };
  const Change between_walls = [](World<2>& w) {
    w.walls = {{{0, 0}, {1, 0}}, {{w.box.length_x, 0}, {-1, 0}}};
    w.box.periodic_x = false;
  };
  const Change faint_gravity = [](World<2>& w) { w.gravity = {1e-200, -1e-200}; };
  const Change weightless = [](World<2>& w) { w.gravity = Vec2::Zero(); };

  add("friction", leave_out, Changes{smooth, general}, Changes{smooth});
  // Without friction nothing spins.
  add("rotation", leave_out, Changes{smooth, general}, Changes{smooth, general, unturned});
  add("friction_and_rotation", leave_out, Changes{smooth, general}, Changes{smooth, unturned});
  add("restitution", leave_out, Changes{inelastic, general}, Changes{inelastic});
  add("periodicity", leave_out, Changes{between_walls, general}, Changes{between_walls});
  add("gravity", leave_out, Changes{faint_gravity}, Changes{weightless});
  add("all_but_gravity", leave_out, Changes{smooth, inelastic, between_walls, general},
      Changes{smooth, inelastic, between_walls, unturned});
  add("frames", frames);
  add("frames_in_a_file", frames_in_a_file);
  // Each scene is measured in its typical state.
  for (const auto& [name, time] : {std::pair{"chute", 2.0},
                                   {"intruder", 2.0},
                                   {"drum", 2.0},
                                   {"shear", 2.0},
                                   {"shaken-box", 1.0},
                                   {"column", 0.1},
                                   {"hopper", 0.5}})
    add(fmt::format("scene/{}", name).c_str(), whole_scene, name, time);
}

}  // namespace
}  // namespace grseg

int main(int argc, char** argv)
{
  grseg::add_all();
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
}
