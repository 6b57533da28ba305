// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/bench/flow.hpp"

#include <benchmark/benchmark.h>
#include <fmt/format.h>
#include <malloc.h>

#include <fstream>

/// Cost of a step of Staron & Phillips' chute and, in wide beds, the part of it that a new list
/// takes, and the memory. Wide beds are copies of the chute side by side.
namespace grseg {
namespace {

/// Value of an entry of /proc/self/status, bytes.
double memory(const std::string& entry)
{
  std::ifstream status("/proc/self/status");
  std::string word;
  double kilobytes = 0;
  while (status >> word)
    if (word == entry) status >> kilobytes;
  return 1024 * kilobytes;
}

/// Memory used since this object was made, at the process's peak.
class PeakMemory {
 public:
  PeakMemory()
  {
    malloc_trim(0);  // so that memory freed before is not reused unnoticed
    before_ = memory("VmRSS:");
  }
  /// Resets the peak, so that earlier peaks do not count.
  static void reset() { std::ofstream("/proc/self/clear_refs") << 5; }
  double bytes() const { return memory("VmHWM:") - before_; }

 private:
  double before_ = 0;
};

Simulation<2> bed(const std::string& accuracy, int copies, int threads)
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
  // The second list is the first one that exists beside an old list; after it all memory is allocated.
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
