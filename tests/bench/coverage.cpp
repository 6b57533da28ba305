// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/fit/fit_pairs.hpp"
#include "analysis/statistics/steady_series.hpp"
#include "tests/analysis/correlated_windows.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

/// Coverage of 95 % intervals, i.e. how often they contain the truth, on windows of known
/// correlation: the tables of docs/studies/uncertainty.md.
namespace grseg {
namespace {

using namespace synthetic;

int trials = 1000;  // of each line of the tables

/// Coverage over the trials, and the half-width in units of the range that contains 95 % of the estimates.
class Tally {
 public:
  explicit Tally(double truth) : truth_(truth) {}

  void add(double estimate, const Estimate& interval)
  {
    hits_ += holds(interval, truth_);
    squares_ += (estimate - truth_) * (estimate - truth_);
    const double width = (interval.high - interval.low) / 2;
    widths_.push_back(std::isnan(width) ? INFINITY : width);
  }
  double coverage() const { return hits_ / static_cast<double>(widths_.size()); }
  double width() const
  {
    auto sorted = widths_;
    std::sort(sorted.begin(), sorted.end());
    const double deviation = std::sqrt(squares_ / static_cast<double>(sorted.size()));
    return sorted[sorted.size() / 2] / (1.96 * deviation);
  }

 private:
  double truth_, hits_ = 0, squares_ = 0;
  std::vector<double> widths_;
};

/// Adds mixed contacts, which carry the part `mixed` of the stress of each layer, to find p*.
constexpr double mixed = 0.4;
FitData with_mixed_contacts(FitData data)
{
  data.quantity = Quantity::contact;
  for (auto& sums : data.rows) {
    for (std::size_t species = 0; species < 2; ++species)
      sums.of(OwnSum::inside, species) *= 1 - mixed;
    sums.of(PairSum::whole, 0)(1, 1) = mixed;
  }
  return data;
}

/// p* of with_mixed_contacts() in the limit of infinitely many windows: phi_S, phi_L and B without
/// mixed contacts give the excess of large grains, (1 - m) B sum phi_L phi_S + m sum (p - phi_L) = 0.
double true_zero(double b)
{
  double phi_sum = 0, products = 0, layers = 0;
  for (const double phi : ScatteredStress::compositions) {
    phi_sum += phi;
    products += phi * (1 - phi);
    ++layers;
  }
  return (phi_sum - (1 - mixed) / mixed * b * products) / layers;
}

constexpr double Estimators::*shown[] = {&Estimators::B, &Estimators::paper_B,
                                         &Estimators::paper_a};

void print_one_run(double rho, std::size_t windows)
{
  Ar1 noise(rho);
  const auto truth = ScatteredStress::truth(0);
  Tally mean(0), undoubted(truth.B), zero(true_zero(truth.B));
  std::vector<Tally> estimates;
  for (const auto place : shown) estimates.emplace_back(truth.*place);
  int doubted = 0;
  for (int trial = 0; trial < trials; ++trial) {
    const auto of_mean =
        mean_over_windows(noise.series(static_cast<Eigen::Index>(windows)), {windows}).estimate();
    mean.add(of_mean.value, of_mean);
    const auto data = ScatteredStress::windows({windows}, 0, noise);
    const auto fit = fit_rule(data, {}, {});
    const auto p_zero =
        line_over_share(with_mixed_contacts(data), {}, Population::windows).p_zero.estimate();
    zero.add(p_zero.value, p_zero);
    for (std::size_t k = 0; k < std::size(shown); ++k)
      estimates[k].add(fit.value.*shown[k], fit.estimate(shown[k]));
    doubted += !fit.doubt.empty();
    if (fit.doubt.empty()) undoubted.add(fit.value.B, fit.estimate(&Estimators::B));
  }
  fmt::print("{:3} {:7} {:6.3f}", rho, windows, mean.coverage());
  for (const auto& tally : estimates) fmt::print(" {:8.3f}", tally.coverage());
  fmt::print(" {:8.3f} {:6.2f} {:8.3f} {:9.3f}\n", zero.coverage(), estimates[0].width(),
             static_cast<double>(doubted) / trials, undoubted.coverage());
  std::fflush(stdout);
}

/// Prints coverage for runs of 30 windows, rho = 1/2; `scatter` is the scatter of runs in standard
/// errors of one run's mean.
void print_runs(std::size_t runs, double scatter)
{
  constexpr std::size_t windows = 30;
  const double run_scatter = scatter * std::sqrt(3.0 / windows);
  Ar1 noise(0.5);
  Tally b(ScatteredStress::truth(run_scatter).B), inside = b;
  const RunLengths lengths(runs, windows);
  for (int trial = 0; trial < trials; ++trial) {
    const auto fit = fit_rule(ScatteredStress::windows(lengths, run_scatter, noise), {}, {});
    b.add(fit.value.B, fit.estimate(&Estimators::B));
    inside.add(fit.value.B, fit.at(Population::windows));
  }
  fmt::print("{:4} {:7} {:6.3f} {:6.2f} {:13.3f} {:6.2f}\n", runs, scatter, b.coverage(), b.width(),
             inside.coverage(), inside.width());
  std::fflush(stdout);
}

/// Prints coverage for drifting compositions, with a B that depends on composition.
void print_drift(double rho, std::size_t windows)
{
  Ar1 noise(rho);
  const auto known = ScatteredStress::drifting(windows, nullptr);
  Tally b(estimators_of(fit_points(known, {}, {})).B);
  for (int trial = 0; trial < trials; ++trial) {
    const auto fit = fit_rule(ScatteredStress::drifting(windows, &noise), {}, {});
    b.add(fit.value.B, fit.estimate(&Estimators::B));
  }
  fmt::print("{:3} {:7} {:6.3f} {:6.2f}\n", rho, windows, b.coverage(), b.width());
  std::fflush(stdout);
}

/// Adds to each run of `series` a function of the fraction of the run that has passed.
template <class Of>
Eigen::VectorXd added(Eigen::VectorXd series, const RunLengths& runs, const Of& of)
{
  Eigen::Index k = 0;
  for (const auto length : runs)
    for (std::size_t window = 0; window < length; ++window)
      series[k++] += of((static_cast<double>(window) + 0.5) / static_cast<double>(length));
  return series;
}

bool shows_start(const Series& series, const RunLengths& runs)
{
  const auto start = start_of(series, runs);
  return start && start->chance() < rarely;
}

/// Prints how often a start and a change are seen in steady series and in series with a start, 2 or 4
/// exp(-10 x) standard deviations of a window at the fraction x of a run, or a drift of 1, 2 or 4 over
/// the run; and the coverage of the mean without the start that is found.
void print_starts()
{
  fmt::print(
      "# share of the trials with a start: steady, start of 2, of 4; with a change: steady, drift of 1, 2, 4;\n"
      "# coverage of the mean after a start of 4, all windows and without the start that is found\n"
      "# rho runs windows | none  2  4 | none  1  2  4 | all  without\n");
  for (const double rho : {0.0, 0.5, 0.8})
    for (const auto& runs :
         {RunLengths{16}, RunLengths{48}, RunLengths{120}, RunLengths{48, 48, 48, 48}}) {
      Ar1 noise(rho);
      int starts[3] = {}, changes[4] = {};
      Tally all(0), without(0);
      for (int trial = 0; trial < trials; ++trial) {
        const auto steady = noise.series(runs, 0);
        for (int k = 0; k < 3; ++k)
          starts[k] += shows_start(
              Series(added(steady, runs, [k](double x) { return 2 * k * std::exp(-10 * x); })),
              runs);
        for (int k = 0; k < 4; ++k)
          changes[k] += change_of(Series(added(steady, runs,
                                               [size = k == 0 ? 0 : std::pow(2, k - 1)](double x) {
                                                 return size * x;
                                               })),
                                  runs)
                            ->is_seen();
        const Series started(added(steady, runs, [](double x) { return 4 * std::exp(-10 * x); }));
        const auto mean = mean_over_windows(started.above, runs).estimate();
        all.add(mean.value, mean);
        const double out = seen_start(started, runs);
        auto left = runs;
        const auto rest = started.without_start(out > 0.5 ? 0 : out, left);
        const auto later = mean_over_windows(rest.above, left).estimate();
        without.add(later.value, later);
      }
      const auto share = [](int count) { return static_cast<double>(count) / trials; };
      fmt::print(
          "{:3} {:4} {:7} | {:.3f} {:.3f} {:.3f} | {:.3f} {:.3f} {:.3f} {:.3f} | {:.3f} {:.3f}\n",
          rho, runs.size(), runs[0], share(starts[0]), share(starts[1]), share(starts[2]),
          share(changes[0]), share(changes[1]), share(changes[2]), share(changes[3]),
          all.coverage(), without.coverage());
    }
  std::fflush(stdout);
}

/// Coverage tally for one population (runs, windows, flows).
struct PopulationTally {
  Population over;
  Tally b{0};
};

void add_to(Tally& tally, const Estimate& b, double truth)
{
  tally.add(b.value - truth, {b.value - truth, b.low - truth, b.high - truth});
}

double truth_of(Population over, const RunsOfFlows::Draw::Truth& truth)
{
  switch (over) {
    case Population::windows:
      return truth.of_runs;
    case Population::runs:
      return truth.of_each[0];
    default:
      return truth.of_flows;
  }
}

bool is_defined(Population over, std::size_t flows)
{
  return flows > 1 || over == Population::windows || over == Population::runs;
}

void print_flows(const FlowDesign& design)
{
  RunsOfFlows source(design);
  std::vector<PopulationTally> tallies;
  for (const auto& [word, over, meaning] : populations) tallies.push_back({over});
  int doubted = 0;
  for (int trial = 0; trial < trials; ++trial) {
    const auto drawn = source.draw();
    const auto fits = fit_flows(drawn.data, {}, {});
    doubted += !fits.all.doubt.empty();
    for (auto& [over, b] : tallies) {
      if (over == Population::runs && !fits.of_each.empty()) {
        for (std::size_t m = 0; m < fits.of_each.size(); ++m)
          add_to(b, fits.of_each[m].at(over), drawn.truth.of_each[m]);
        continue;
      }
      add_to(b, fits.all.at(over), truth_of(over, drawn.truth));
    }
  }
  fmt::print("{} x {} {:5} {:5}", design.flows, design.runs, design.flow_scatter,
             design.run_variance);
  for (const auto& [over, b] : tallies)
    if (is_defined(over, design.flows))
      fmt::print(" | {:.3f} {:4.2f}", b.coverage(), b.width());
    else
      fmt::print(" | - -");
  fmt::print(" | {:.3f}\n", static_cast<double>(doubted) / trials);
  std::fflush(stdout);
}

void print_all_flows()
{
  fmt::print(
      "# {} trials: runs of {} windows, rho = {}; scatter between flows in standard\n"
      "# errors of a flow, variance between runs in that of a run's mean. Of each population the\n"
      "# coverage and the width of the interval of B; doubt: share of the trials\n"
      "# design scatter variance",
      trials, RunsOfFlows::windows, RunsOfFlows::rho);
  for (const auto& [word, over, meaning] : populations) fmt::print(" | {}", word);
  fmt::print(" | doubt\n");
  std::fflush(stdout);
  for (const auto& [flows, runs] :
       {std::pair<std::size_t, std::size_t>{6, 4}, {6, 2}, {1, 4}, {1, 8}})
    for (const double variance : {0.0, 1.0, 3.0})
      for (const double scatter : {0.0, 0.5, 1.0, 2.0, 4.0})
        print_flows({flows, runs, scatter, variance});
}

void print_windows()
{
  fmt::print(
      "# {} trials each; width: median, 1 = 1.96 standard deviations of the estimates; doubt: share of\n"
      "# the trials in which the tool warns; coverage of B where it does not\n"
      "# one run\n# rho windows   mean B paper_B paper_a p*  width    doubt undoubted\n",
      trials);
  for (const double rho : {0.0, 0.5, 0.8})
    for (const std::size_t windows : {3u, 6u, 12u, 24u, 48u, 120u, 480u})
      print_one_run(rho, windows);
}

void print_drifts()
{
  fmt::print(
      "# one run whose layers segregate, under a rule whose B depends on composition\n"
      "# rho windows B  width\n");
  for (const double rho : {0.0, 0.5, 0.8})
    for (const std::size_t windows : {24u, 48u, 120u, 480u}) print_drift(rho, windows);
}

void print_all_runs()
{
  fmt::print(
      "# several runs of 30 windows, rho = 0.5\n"
      "# runs scatter B  width  windows_alone  width\n");
  for (const std::size_t runs : {2u, 3u, 4u, 8u})
    for (const double scatter : {0.0, 1.0, 3.0}) print_runs(runs, scatter);
}

constexpr std::pair<const char*, void (*)()> tables[] = {{"windows", print_windows},
                                                         {"drifts", print_drifts},
                                                         {"runs", print_all_runs},
                                                         {"flows", print_all_flows},
                                                         {"starts", print_starts}};

}  // namespace
}  // namespace grseg

/// coverage [TABLE [TRIALS]]: prints one table or all.
int main(int argc, char** argv)
{
  const std::string only = argc < 2 ? "" : argv[1];
  if (argc > 2) grseg::trials = std::stoi(argv[2]);
  for (const auto& [name, print] : grseg::tables)
    if (only.empty() || only == name) print();
}
