// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/bench/flow.hpp"

#include <benchmark/benchmark.h>
#include <fmt/format.h>
#include <malloc.h>

#include <fstream>

/// What a step of the paper's chute costs and, in wide beds, what of it a new list does, and the
/// memory it takes. Wide beds are copies of the chute side by side.
namespace grseg {
namespace {

/// An entry of /proc/self/status, in bytes.
double memory(const std::string& entry)
{
  std::ifstream status("/proc/self/status");
  std::string word;
  double kilobytes = 0;
  while (status >> word)
    if (word == entry) status >> kilobytes;
  return 1024 * kilobytes;
}

/// The memory taken since this was made, while the process has most of it.
class PeakMemory {
 public:
  PeakMemory()
  {
    malloc_trim(0);  // what others have freed must not be taken again unseen
    before_ = memory("VmRSS:");
  }
  /// Whatever peak there was so far does not count.
  static void reset() { std::ofstream("/proc/self/clear_refs") << 5; }
  double bytes() const { return memory("VmHWM:") - before_; }

 private:
  double before_ = 0;
};

Simulation bed(const std::string& accuracy, int copies, int threads)
{
  if (copies == 1) return flow(accuracy);
  auto world = flow(accuracy).world();
  world.threads = threads;
  return side_by_side(flow(accuracy), world, copies);
}

void step(benchmark::State& state, const std::string& accuracy, int copies, int threads)
{
  flow(accuracy);
  const PeakMemory memory;
  auto simulation = bed(accuracy, copies, threads);
  PeakMemory::reset();
  // The second list is the first that has an old one beside it; memory is all there after it.
  for (int warm = 0; warm < 20 || simulation.pair_list_renewals() < 3; ++warm) simulation.advance();
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
  state.counters["bytes_per_grain"] =
      memory.bytes() / static_cast<double>(simulation.world().grains.size());
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
