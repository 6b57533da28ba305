// SPDX-License-Identifier: GPL-3.0-or-later
#include "sim/deposition.hpp"
#include "sim/scene.hpp"

#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <map>

/// What a step of the paper's chute costs, and its parts: looking through the listed pairs, and a
/// new list. Beds are deposited here and flow for two seconds first.
namespace grseg {
namespace {

boost::program_options::variables_map values_of(const std::string& accuracy,
                                                const std::string& length)
{
  namespace po = boost::program_options;
  const std::vector<std::string> words{"--accuracy", accuracy, "--length", length};
  po::variables_map values;
  po::store(po::command_line_parser(words).options(scene_options()).run(), values);
  return values;
}

/// The chute in flow; copied by whoever changes it.
const Simulation& flow(const std::string& accuracy, const std::string& length)
{
  static std::map<std::string, Simulation> made;
  const auto key = accuracy + length;
  if (const auto found = made.find(key); found != made.end()) return found->second;
  const auto scene = resolve_scene(GRSEG_SCENES "/chute.ini", values_of(accuracy, length));
  auto simulation = deposit(scene, {});
  const double slope = scene.slope * 3.14159265358979323846 / 180;
  simulation.tilt({scene.gravity * std::sin(slope), -scene.gravity * std::cos(slope)});
  while (simulation.time() < 2) simulation.advance();
  return made.emplace(key, simulation).first->second;
}

void step(benchmark::State& state, const std::string& accuracy, const std::string& length)
{
  auto simulation = flow(accuracy, length);
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

}  // namespace
}  // namespace grseg

int main(int argc, char** argv)
{
  for (const char* accuracy : {"standard", "draft"})
    benchmark::RegisterBenchmark(fmt::format("step/{}", accuracy).c_str(), grseg::step,
                                 std::string(accuracy), std::string("35dL"))
        ->Iterations(5000);
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
}
