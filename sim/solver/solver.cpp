// SPDX-License-Identifier: GPL-3.0-or-later
#include "sim/solver/solver.hpp"

#include "sim/contact/parallel.hpp"
#include "sim/solver/wavefront.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>

namespace grseg {
namespace {

// Sweeps cannot resolve the last digits of velocities. If loads fade, as in a gas, a tolerance
// relative to the loads may be smaller than these digits and would never be met. After
// `sweeps_before_round_off` sweeps changes are therefore compared with the velocities, too.
template <class Real>
constexpr double last_digits = 8 * double{std::numeric_limits<Real>::epsilon()};
constexpr int sweeps_before_round_off = 32;

// Number of sweeps after a good first guess in which changes hardly ever grow. In more sweeps they
// do, and extrapolation without a restart would converge more slowly than plain sweeps.
constexpr int most_without_restart = 8;

/// Largest component of all velocities, m/s.
template <int D, class Real>
double fastest(std::span<const MotionOf<D, Real>> motion)
{
  Real largest = 0;
  for (const auto& m : motion)
    for (const auto& components : {std::span<const Real>(m.v), std::span<const Real>(m.rim)})
      for (const Real v : components) largest = std::max(largest, std::abs(v));
  return largest;
}

SweepResult total(const std::vector<SweepResult>& strips)
{
  SweepResult total;
  for (const auto& s : strips) {
    total.largest = std::max(total.largest, s.largest);
    total.sum_squares += s.sum_squares;
    total.sum_reference += s.sum_reference;
  }
  return total;
}

/// Chooses the strips to sweep: all strips, until few have changes above the tolerance, then only
/// these and their neighbours. In a wide scene some contact always needs more sweeps.
template <int D, class Real>
class LocalWork {
 public:
  explicit LocalWork(std::span<const RunsOf<D, Real>> strips)
      : strips_(strips), swept_(strips.size(), 1)
  {
    for (const auto& strip : strips) all_ += strip.blocks.size();
  }

  bool swept(std::size_t strip) const { return swept_[strip] != 0; }
  bool local() const { return local_; }
  /// Number of sweeps over all strips with the same number of relaxations, rounded up.
  int rounds() const { return static_cast<int>((relaxed_ + all_ - 1) / all_); }

  /// To be called after a sweep over the chosen strips.
  void count()
  {
    for (std::size_t s = 0; s < strips_.size(); ++s)
      if (swept(s)) relaxed_ += strips_[s].blocks.size();
  }
  /// To be called after count(), with the results of the sweep; chooses the strips of the next one.
  void choose(const std::vector<SweepResult>& results, double limit)
  {
    const auto unsettled = [&](std::size_t s) { return results[s].largest > limit; };
    const std::size_t strips = results.size();
    std::size_t count = 0;
    for (std::size_t s = 0; s < strips; ++s) count += unsettled(s) ? 1 : 0;
    local_ = local_ || 4 * count <= strips;
    if (!local_) return;
    for (std::size_t s = 0; s < strips; ++s)
      swept_[s] =
          unsettled(s) || unsettled((s + 1) % strips) || unsettled((s + strips - 1) % strips) ? 1
                                                                                              : 0;
  }

 private:
  std::span<const RunsOf<D, Real>> strips_;
  std::vector<std::uint8_t> swept_;
  std::size_t relaxed_ = 0, all_ = 0;  // blocks relaxed so far; blocks in all strips
  bool local_ = false;
};

/// One solve; the velocities must already include the effect of the first guess.
template <int D, class Real>
class Sweeping {
 public:
  Sweeping(std::span<const RunsOf<D, Real>> strips, std::span<MotionOf<D, Real>> motion,
           const SolverTask<D>& task, ExtrapolationOf<D, Real>& extrapolation)
      : strips_(strips),
        motion_(motion),
        task_(task),
        extrapolation_(extrapolation),
        least_(std::max(1, std::min(task.settings.min_sweeps, task.settings.max_sweeps))),
        at_a_time_(strips.size() > 1 ? 2 : 1),
        results_(strips.size()),
        work_(strips)
  {
  }

  SolverReport until_settled()
  {
    const auto& settings = task_.settings;
    if (settings.acceleration) extrapolation_.begin(strips_, motion_, task_.threads);
    while (true) {
      const bool several = strips_.size() > 1 && !task_.apart.any();
      const auto result = several && sweeps_ == 0 ? first_of_several() : sweep_all();
      if (sweeps_ >= least_ || (result.sum_squares == 0 && result.largest == 0)) {
        const auto report = report_on(result);
        if (report.converged || sweeps_ >= settings.max_sweeps) return report;
        if (!task_.apart.any()) work_.choose(results_, settings.tolerance * reference(result));
      }
      if (settings.acceleration && !work_.local())
        extrapolation_.extrapolate(strips_, motion_, result.sum_squares, task_.threads);
    }
  }

 private:
  /// Makes the first sweeps over several strips, whose results no decision depends on: as many as
  /// the least number of sweeps, but not more than most_without_restart.
  SweepResult first_of_several()
  {
    const int rounds = (std::min(least_, most_without_restart) + at_a_time_ - 1) / at_a_time_;
    const auto last = static_cast<std::size_t>(rounds - 1);
    std::vector<double> factors;  // of the extrapolation after each round but the last
    for (std::size_t round = 0; round < last; ++round)
      factors.push_back(extrapolation_.next_factor());
    std::vector<SweepResult> before(strips_.size());  // results of the last round but one
    Wavefront(strips_.size(), rounds)
        .run(
            task_.threads,
            [&](std::size_t s, std::size_t round) {
              before[s] = results_[s];
              sweep_strip(s, round < last ? Measured::squares : Measured::all);
            },
            [&](std::size_t s, std::size_t round) {
              if (task_.settings.acceleration && round < last)
                extrapolation_.extrapolate_strip(strips_, s, motion_, factors[round]);
            });
    sweeps_ = rounds * at_a_time_;
    for (int round = 0; round < rounds; ++round) work_.count();
    if (last > 0) extrapolation_.set_last_change(total(before).sum_squares);
    return total(results_);
  }

  SweepResult sweep_all()
  {
    const bool may_be_last = sweeps_ + at_a_time_ >= least_;
    for_alternate_strips(task_.threads, strips_.size(), [&](std::size_t s) {
      if (work_.swept(s)) sweep_strip(s, may_be_last ? Measured::all : Measured::squares);
    });
    sweeps_ += at_a_time_;
    work_.count();
    auto result = total(results_);
    result.largest = std::max(result.largest, solve_apart());
    return result;
  }

  /// Solves free bodies and wedged grains; returns the largest change of a velocity, m/s.
  double solve_apart()
  {
    double largest = 0;
    if constexpr (std::is_same_v<Real, double>) {
      const auto& [free, wedged] = task_.apart;
      if (free != nullptr) largest = free->balance(motion_, task_.friction, task_.effects);
      if (wedged != nullptr)
        largest = std::max(largest, wedged->settle(motion_, task_.friction, task_.effects));
    }
    return largest;
  }

  void sweep_strip(std::size_t strip, Measured measured)
  {
    const auto quick = choose_sweep<D, Real>(task_.effects, Measured::squares),
               last = choose_sweep<D, Real>(task_.effects, measured);
    const auto friction = static_cast<Real>(task_.friction);
    if (at_a_time_ > 1) quick(strips_[strip], motion_.data(), friction);
    results_[strip] = last(strips_[strip], motion_.data(), friction);
  }

  SolverReport report_on(const SweepResult& result)
  {
    // Without gravity, the reference is 0 after the sweep in which the last contact opens.
    const auto relative = [&](double change) {
      return change == 0 ? 0 : change / reference(result);
    };
    SolverReport report;
    report.sweeps = at_a_time_ * work_.rounds();
    report.residual = relative(result.largest);
    report.residual_rms =
        relative(std::sqrt(result.sum_squares / static_cast<double>(task_.count)));
    report.converged = report.residual <= task_.settings.tolerance;
    if (!report.converged && sweeps_ >= sweeps_before_round_off) {
      if (round_off_ == 0) round_off_ = last_digits<Real> * fastest<D, Real>(motion_);
      report.converged = result.largest <= round_off_;
    }
    return report;
  }

  /// Reference velocity, m/s: quadratic mean of W p, limited to its range.
  double reference(const SweepResult& result) const
  {
    const double mean = std::sqrt(result.sum_reference / static_cast<double>(task_.count));
    return std::clamp(mean, task_.range.least, task_.range.most);
  }

  std::span<const RunsOf<D, Real>> strips_;
  std::span<MotionOf<D, Real>> motion_;
  const SolverTask<D>& task_;
  ExtrapolationOf<D, Real>& extrapolation_;
  const int least_;  // least number of sweeps
  // Sweeps of a strip in a row: in the second one, its contacts are in the cache.
  const int at_a_time_;
  int sweeps_ = 0;
  std::vector<SweepResult> results_;  // per strip, of the last sweep
  LocalWork<D, Real> work_;
  double round_off_ = 0;  // m/s, set when it is needed
};
template <int D>
SolverReport solve_mixed(std::span<const BlockRuns<D>> strips, std::span<Motion<D>> motion,
                         const SolverTask<D>& task, SolverMemory<D>& memory)
{
  auto& contacts = memory.contacts;
  contacts.take(strips, motion, task.effects, task.threads);
  const auto report = Sweeping<D, float>(contacts.strips(), contacts.motion(), task, memory.singles)
                          .until_settled();
  for_alternate_strips(task.threads, strips.size(), [&](std::size_t s) {
    contacts.give_back(s, strips[s], task.friction, task.effects, motion.data());
  });
  return report;
}

}  // namespace

template <int D>
SolverReport solve_contacts(std::span<const BlockRuns<D>> strips, std::span<Motion<D>> motion,
                            const SolverTask<D>& task, SolverMemory<D>& memory)
{
  const auto& apart = task.apart;
  if (task.count == 0) return {};
  if (task.settings.precision == Precision::mixed && !apart.any())
    return solve_mixed<D>(strips, motion, task, memory);
  const auto apply = [&] {
    for_alternate_strips(task.threads, strips.size(), [&](std::size_t s) {
      apply_impulses<D>(strips[s].blocks, motion.data(), task.effects);
    });
  };
  if (apart.free == nullptr) {
    apply();
    return Sweeping<D, double>(strips, motion, task, memory.doubles).until_settled();
  }
  // Impulses may be far larger in between than at the end, and their round-off stays in velocities.
  // So velocities are computed again, from the final impulses alone.
  memory.free_flight.assign(motion.begin(), motion.end());
  apply();
  apart.free->update_velocities(motion);
  const auto report = Sweeping<D, double>(strips, motion, task, memory.doubles).until_settled();
  for (std::size_t k = 0; k < motion.size(); ++k)
    if (motion[k].inverse_mass > 0) motion[k] = memory.free_flight[k];
  apply();
  return report;
}

template SolverReport solve_contacts(std::span<const BlockRuns<2>>, std::span<Motion<2>>,
                                     const SolverTask<2>&, SolverMemory<2>&);
template SolverReport solve_contacts(std::span<const BlockRuns<3>>, std::span<Motion<3>>,
                                     const SolverTask<3>&, SolverMemory<3>&);

}  // namespace grseg
