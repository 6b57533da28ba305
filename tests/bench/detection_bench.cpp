// SPDX-License-Identifier: GPL-3.0-or-later
#include "sim/neighbours/impulse_memory.hpp"
#include "tests/bench/flow.hpp"

#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <algorithm>

/// Cost of the parts of contact detection in Staron & Phillips' chute and in beds a hundred times
/// as wide, compared with a whole step. A step checks whether the list is complete, finds contacts,
/// drops and transfers impulses once, and renews the list `renewals` times on average.
namespace grseg {
namespace {

Simulation<2> bed(int copies)
{
  const auto one = flow<2>("standard");
  auto simulation = side_by_side(one, one.world(), copies);
  for (int warm = 0; warm < 20; ++warm) simulation.advance();
  return simulation;
}

/// A bed at one instant, with a list of its pairs.
struct Instant {
  explicit Instant(const Simulation<2>& simulation)
      : world(simulation.world()),
        state(make_state<2>(world.grains, positions_of(simulation))),
        list(world.walls, world.box,
             *std::max_element(world.grains.radius.begin(), world.grains.radius.end()), world.skin,
             world.law.margin)
  {
    put(simulation);
    list.renew(state, ahead);
    put(simulation);
    rule.ahead = ahead;
    rule.middle = state.position;
    rule.motion = state.motion;
    rule.walls = world.walls;
    rule.margin = world.law.margin;
    rule.restitution = world.material.restitution;
    rule.periodic = world.box.periodic_x;
  }

  /// Moves the grains to their positions in `simulation`, from any period.
  void put(const Simulation<2>& simulation)
  {
    const double length = world.box.length_x;
    ahead.resize(state.position.size());
    for (std::size_t b = 0; b < state.size(); ++b) {
      const auto g = static_cast<std::size_t>(state.row[b]);
      const Vec2 velocity = simulation.velocity(g);
      auto& position = state.position[b];
      position = simulation.position(g);
      position.x() -= length * std::floor(position.x() / length);
      state.motion[b].v[0] = velocity.x();
      state.motion[b].v[1] = velocity.y();
      ahead[b] = position + world.law.forecast * world.step * velocity;
    }
  }

  static std::vector<Vec2> positions_of(const Simulation<2>& simulation)
  {
    std::vector<Vec2> position;
    for (std::size_t g = 0; g < simulation.world().grains.size(); ++g)
      position.push_back(simulation.position(g));
    return position;
  }

  World<2> world;
  GrainState<2> state;
  PairList<2> list;
  std::vector<Vec2> ahead;  // positions at which contacts are searched, m
  DetectionRule<2> rule;
};

void report_contacts(benchmark::State& state, const std::vector<StripContacts<2>>& strips)
{
  double contacts = 0;
  for (const auto& strip : strips) contacts += static_cast<double>(strip.count);
  state.counters["contacts"] = contacts;
}

void find(benchmark::State& state, int copies)
{
  Instant now(bed(copies));
  std::vector<StripContacts<2>> strips;
  for (auto _ : state) benchmark::DoNotOptimize(find_contacts(now.list.pairs(), now.rule, strips));
  report_contacts(state, strips);
  state.counters["pairs"] = static_cast<double>(now.list.pairs().size());
}

void complete(benchmark::State& state, int copies)
{
  Instant now(bed(copies));
  bool complete = true;
  for (auto _ : state) complete &= now.list.complete(now.ahead);
  if (!complete) state.SkipWithError("the list is not complete");
}

/// Goes from one instant to another and back; they are as far apart as two renewals of the list in
/// the flow.
void renew(benchmark::State& state, int copies)
{
  auto simulation = bed(copies);
  const auto early = simulation;
  const auto renewals = simulation.pair_list_renewals();
  while (simulation.pair_list_renewals() < renewals + 2) simulation.advance();
  const auto steps_between = (simulation.steps_done() - early.steps_done()) / 2;
  auto late = early;
  for (std::int64_t k = 0; k < steps_between; ++k) late.advance();
  Instant now(early);
  bool is_late = false;
  for (auto _ : state) {
    state.PauseTiming();
    is_late = !is_late;
    now.put(is_late ? late : early);
    state.ResumeTiming();
    now.list.renew(now.state, now.ahead);
  }
  state.counters["pairs"] = static_cast<double>(now.list.pairs().size());
}

void keep_and_forget(benchmark::State& state, int copies)
{
  Instant now(bed(copies));
  std::vector<StripContacts<2>> strips;
  for (int step = 0; step < 2; ++step) find_contacts(now.list.pairs(), now.rule, strips);
  for (auto _ : state) {
    forget_impulses<2>(strips, now.list.pairs());
    benchmark::DoNotOptimize(keep_impulses<2>(strips, now.list.pairs()));
  }
  report_contacts(state, strips);
}

void whole_step(benchmark::State& state, int copies)
{
  auto simulation = bed(copies);
  const auto renewals = simulation.pair_list_renewals();
  double sweeps = 0;
  for (auto _ : state) sweeps += simulation.advance().solver.sweeps;
  using benchmark::Counter;
  state.counters["sweeps"] = Counter(sweeps, Counter::kAvgIterations);
  state.counters["renewals"] = Counter(
      static_cast<double>(simulation.pair_list_renewals() - renewals), Counter::kAvgIterations);
}

void add(const char* name, void (*what)(benchmark::State&, int), int copies, int times)
{
  const auto width = copies > 1 ? fmt::format("/{}_wide", copies) : "";
  benchmark::RegisterBenchmark(fmt::format("{}{}", name, width).c_str(), what, copies)
      ->Iterations(times)
      ->Unit(benchmark::kMicrosecond);
}

}  // namespace
}  // namespace grseg

int main(int argc, char** argv)
{
  for (const int copies : {1, 100}) {
    const int times = copies > 1 ? 60 : 3000;
    grseg::add("find_contacts", grseg::find, copies, times);
    grseg::add("complete", grseg::complete, copies, times);
    grseg::add("renew", grseg::renew, copies, times / 4);
    grseg::add("keep_and_forget", grseg::keep_and_forget, copies, times);
    grseg::add("step", grseg::whole_step, copies, times);
  }
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
}
