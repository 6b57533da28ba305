// SPDX-License-Identifier: GPL-3.0-or-later
#include "sim/contact/contact_blocks.hpp"
#include "sim/solver/single_contacts.hpp"
#include "sim/solver/sweep.hpp"
#include "tests/frozen_problem.hpp"
#include "tests/sim/contact_list.hpp"

#include <benchmark/benchmark.h>

#include <cmath>

/// Contact updates per second on the contacts of one step of the chute, by instruction set, and the
/// additional cost of a step's colouring, packing and warm start.
namespace grseg {
namespace {

/// The frozen problem, with the additional entry on which unused lanes act.
FrozenProblem problem()
{
  static const auto read = read_frozen_problem(GRSEG_TEST_INPUTS "/chute-contact-problem.txt");
  auto copy = read;
  copy.motion.emplace_back();
  return copy;
}

void count_contacts(benchmark::State& state, const FrozenProblem& p)
{
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(p.contacts.size()));
}

void sweep(benchmark::State& state, const std::string& instructions, Effects effects)
{
  use_instruction_set(instructions);
  auto p = problem();
  ContactBlocks packed;
  packed.pack(p.contacts, p.motion, p.motion.size() - 1);
  const auto one_sweep = choose_sweep<2>(effects);
  for (auto _ : state)
    benchmark::DoNotOptimize(one_sweep(packed.runs(), p.motion.data(), p.friction));
  count_contacts(state, p);
}

void single_sweep(benchmark::State& state, const std::string& instructions)
{
  use_instruction_set(instructions);
  auto p = problem();
  ContactBlocks packed;
  packed.pack(p.contacts, p.motion, p.motion.size() - 1);
  SingleContacts<2> singles;
  singles.take(std::array{packed.runs()}, p.motion, {}, 1);
  const auto one_sweep = choose_sweep<2, float>({});
  for (auto _ : state)
    benchmark::DoNotOptimize(one_sweep(singles.strips()[0], singles.motion().data(),
                                       static_cast<float>(FrozenProblem::friction)));
  count_contacts(state, p);
}

/// Conversion from double to single precision and back, with the first guesses applied.
void take_and_give_back(benchmark::State& state)
{
  use_instruction_set("");
  auto p = problem();
  ContactBlocks packed;
  packed.pack(p.contacts, p.motion, p.motion.size() - 1);
  SingleContacts<2> singles;
  for (auto _ : state) {
    singles.take(std::array{packed.runs()}, p.motion, {}, 1);
    singles.give_back(0, packed.runs(), p.friction, {}, p.motion.data());
  }
  count_contacts(state, p);
}

void scalar_relax_in_list_order(benchmark::State& state)
{
  auto p = problem();
  const auto relax_alone = choose_relax<2>({});
  for (auto _ : state) {
    double largest = 0;
    for (auto& c : p.contacts) {
      const auto change = relax_alone(c, p.motion[static_cast<std::size_t>(c.i)],
                                      p.motion[static_cast<std::size_t>(c.j)], p.friction);
      largest = std::max({largest, change.change_n, std::abs(change.change_t[0])});
    }
    benchmark::DoNotOptimize(largest);
  }
  count_contacts(state, p);
}

void colour_and_pack(benchmark::State& state)
{
  const auto p = problem();
  ContactBlocks packed;
  for (auto _ : state) packed.pack(p.contacts, p.motion, p.motion.size() - 1);
  count_contacts(state, p);
}

void unpack(benchmark::State& state)
{
  auto p = problem();
  ContactBlocks packed;
  packed.pack(p.contacts, p.motion, p.motion.size() - 1);
  for (auto _ : state) packed.unpack(p.contacts);
  count_contacts(state, p);
}

void warm_start(benchmark::State& state)
{
  use_instruction_set("");
  auto p = problem();
  ContactBlocks packed;
  packed.pack(p.contacts, p.motion, p.motion.size() - 1);
  for (auto _ : state) apply_impulses<2>(packed.blocks(), p.motion.data(), {});
  count_contacts(state, p);
}

BENCHMARK(scalar_relax_in_list_order);
BENCHMARK(colour_and_pack);
BENCHMARK(unpack);
BENCHMARK(warm_start);
BENCHMARK(take_and_give_back);

void add_sweeps()
{
  for (const auto& name : instruction_sets()) {
    const auto add = [&](const char* effects_name, Effects effects) {
      benchmark::RegisterBenchmark(("sweep/" + name + effects_name).c_str(), sweep, name, effects);
    };
    add("", {});
    benchmark::RegisterBenchmark(("sweep/" + name + "/single").c_str(), single_sweep, name);
    add("/no_restitution", {.restitution = false});
    add("/no_rotation", {.rotation = false});
    add("/no_friction", {.friction = false});
  }
}

}  // namespace
}  // namespace grseg

int main(int argc, char** argv)
{
  grseg::add_sweeps();
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
}
