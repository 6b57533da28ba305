// SPDX-License-Identifier: GPL-3.0-or-later
#include "sim/solver/solver.hpp"

#include "sim/contact/parallel.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>

namespace grseg {
namespace {

// Sweeps cannot resolve the last digits of velocities. Where loads fade, as in a gas, a tolerance
// relative to them may be smaller than that, and would never be met; after so many sweeps changes
// are compared with the velocities, too.
template <class Real>
constexpr double last_digits = 8 * double{std::numeric_limits<Real>::epsilon()};
constexpr int sweeps_before_round_off = 32;

/// m/s, the largest component of all velocities.
template <class Real>
double fastest(std::span<const MotionOf<Real>> motion)
{
  Real largest = 0;
  for (const auto& m : motion)
    largest = std::max({largest, std::abs(m.vx), std::abs(m.vy), std::abs(m.rim_speed)});
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

/// Which strips are swept: all, until few have changes above the tolerance; then only these and
/// their neighbours, because somewhere in a wide scene there is always a contact that needs more
/// sweeps.
template <class Real>
class LocalWork {
 public:
  explicit LocalWork(std::span<const RunsOf<Real>> strips)
      : strips_(strips), swept_(strips.size(), 1)
  {
    count_blocks();
    all_ = relaxed_;
  }

  bool swept(std::size_t strip) const { return swept_[strip] != 0; }
  bool local() const { return local_; }
  /// As many as if every strip had been swept as often.
  int rounds() const { return static_cast<int>((relaxed_ + all_ - 1) / all_); }

  /// After a sweep; `enough` of all strips have been made.
  void choose(const std::vector<SweepResult>& results, double limit, bool enough)
  {
    const auto unsettled = [&](std::size_t s) { return results[s].largest > limit; };
    const std::size_t strips = results.size();
    std::size_t count = 0;
    for (std::size_t s = 0; s < strips; ++s) count += unsettled(s) ? 1 : 0;
    local_ = local_ || (enough && 4 * count <= strips);
    if (local_)
      for (std::size_t s = 0; s < strips; ++s)
        swept_[s] =
            unsettled(s) || unsettled((s + 1) % strips) || unsettled((s + strips - 1) % strips) ? 1
                                                                                                : 0;
    count_blocks();
  }

 private:
  void count_blocks()
  {
    for (std::size_t s = 0; s < strips_.size(); ++s)
      if (swept(s)) relaxed_ += strips_[s].blocks.size();
  }

  std::span<const RunsOf<Real>> strips_;
  std::vector<std::uint8_t> swept_;
  std::size_t relaxed_ = 0, all_ = 0;  // blocks
  bool local_ = false;
};

/// What a solve is asked for, but for the contacts.
struct Task {
  std::size_t count;  // of contacts
  double friction;
  Effects effects;
  const SolverSettings& settings;
  double floor;  // m/s
  int threads;
  FreeBodies* free;
};

template <class Real>
SolverReport sweep_until_settled(std::span<const RunsOf<Real>> strips,
                                 std::span<MotionOf<Real>> motion, const Task& task,
                                 ExtrapolationOf<Real>& extrapolation)
{
  const auto& settings = task.settings;
  for_alternate_strips(task.threads, strips.size(), [&](std::size_t s) {
    apply_impulses(strips[s].blocks, motion.data(), task.effects);
  });
  const bool any_free = task.free != nullptr;
  const auto update_free = [&] {
    if constexpr (std::is_same_v<Real, double>) return task.free->update_velocities(motion);
    return 0.0;
  };
  if (any_free) update_free();
  const auto sweep = choose_sweep<Real>(task.effects);
  const auto friction = static_cast<Real>(task.friction);
  const auto contact_count = static_cast<double>(task.count);
  std::vector<SweepResult> results(strips.size());
  LocalWork<Real> work(strips);
  if (settings.acceleration) extrapolation.begin();
  SolverReport report;
  double round_off = 0;  // m/s, once it is needed
  // The second sweep of a strip finds its contacts in the cache.
  const int at_a_time = strips.size() > 1 ? 2 : 1;
  for (int sweeps = at_a_time;; sweeps += at_a_time) {
    for_alternate_strips(task.threads, strips.size(), [&](std::size_t s) {
      for (int k = 0; work.swept(s) && k < at_a_time; ++k)
        results[s] = sweep(strips[s], motion.data(), friction);
    });
    auto result = total(results);
    if constexpr (std::is_same_v<Real, double>) {
      if (any_free) {
        result.largest = std::max(result.largest, update_free());
        task.free->relax_contacts(motion, friction, task.effects);
        update_free();
      }
    }
    const double reference = std::max(std::sqrt(result.sum_reference / contact_count), task.floor);
    // Without gravity the sweep that lets the last contact go leaves a reference of 0.
    const auto relative = [&](double change) { return change == 0 ? 0 : change / reference; };
    report.sweeps = at_a_time * work.rounds();
    report.residual = relative(result.largest);
    report.residual_rms = relative(std::sqrt(result.sum_squares / contact_count));
    report.converged = report.residual <= settings.tolerance;
    if (!report.converged && sweeps >= sweeps_before_round_off) {
      if (round_off == 0) round_off = last_digits<Real> * fastest<Real>(motion);
      report.converged = result.largest <= round_off;
    }
    const bool enough = sweeps >= settings.min_sweeps || result.largest == 0;
    if ((report.converged && enough) || sweeps >= settings.max_sweeps) return report;
    work.choose(results, settings.tolerance * reference, enough && !any_free);
    if (settings.acceleration && !work.local())
      extrapolation.extrapolate(strips, motion, result.sum_squares, task.threads);
  }
}

SolverReport solve_mixed(std::span<const BlockRuns> strips, std::span<Motion> motion,
                         const Task& task, SolverMemory& memory)
{
  auto& contacts = memory.contacts;
  contacts.take(strips, motion, task.threads);
  const auto report =
      sweep_until_settled(contacts.strips(), contacts.motion(), task, memory.singles);
  for_alternate_strips(task.threads, strips.size(), [&](std::size_t s) {
    contacts.give_back(s, strips[s], task.friction);
    apply_impulses(strips[s].blocks, motion.data(), task.effects);
  });
  return report;
}

}  // namespace

SolverReport solve_contacts(std::span<const BlockRuns> strips, std::size_t count,
                            std::span<Motion> motion, double friction, Effects effects,
                            const SolverSettings& settings, double floor, SolverMemory& memory,
                            int threads, FreeBodies* free)
{
  if (count == 0) return {};
  const Task task{count, friction, effects, settings, floor, threads, free};
  if (settings.precision == Precision::mixed && free == nullptr)
    return solve_mixed(strips, motion, task, memory);
  return sweep_until_settled(strips, motion, task, memory.doubles);
}

}  // namespace grseg
