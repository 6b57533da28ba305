// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/bench/flow.hpp"

#include <benchmark/benchmark.h>
#include <fmt/format.h>
#include <malloc.h>

#include <fstream>

/// Cost of a step of Staron & Phillips' chute and of a chute of spheres; in wide beds also the memory.
/// Wide beds are copies of the chute side by side.
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

template <int D>
Simulation<D> bed(const std::string& accuracy, int copies, int threads)
{
  if (copies == 1) return flow<D>(accuracy);
  auto world = flow<D>(accuracy).world();
  world.threads = threads;
  return side_by_side(flow<D>(accuracy), world, copies);
}

template <int D>
void step(benchmark::State& state, const std::string& accuracy, int copies, int threads)
{
  flow<D>(accuracy);
  const PeakMemory memory;
  auto simulation = bed<D>(accuracy, copies, threads);
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

template <int D>
void add(const std::string& accuracy, int copies, int threads, int steps)
{
  auto name = fmt::format("step/{}/{}", D == 2 ? "discs" : "spheres", accuracy);
  if (copies > 1) name += fmt::format("/{}_wide/{}_threads", copies, threads);
  auto* added = benchmark::RegisterBenchmark(name.c_str(), step<D>, accuracy, copies, threads);
  added->Iterations(steps)->Unit(benchmark::kMicrosecond);
  if (threads > 1) added->UseRealTime();
}

}  // namespace
}  // namespace grseg

int main(int argc, char** argv)
{
  for (const char* accuracy : {"standard", "draft"}) {
    grseg::add<2>(accuracy, 1, 1, 5000);
    grseg::add<3>(accuracy, 1, 1, 2000);
    for (const int threads : {1, 2}) {
      grseg::add<2>(accuracy, 10, threads, 300);
      grseg::add<2>(accuracy, 100, threads, 60);
      grseg::add<2>(accuracy, 300, threads, 30);
      grseg::add<3>(accuracy, 9, threads, 100);
      grseg::add<3>(accuracy, 90, threads, 20);
    }
  }
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
}
