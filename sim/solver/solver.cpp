// SPDX-License-Identifier: GPL-3.0-or-later
#include "sim/solver/solver.hpp"

#include "sim/contact/parallel.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace grseg {
namespace {

// Sweeps cannot resolve the last digits of velocities. Where loads fade, as in a gas, a tolerance
// relative to them may be smaller than that, and would never be met; after so many sweeps changes
// are compared with the velocities, too.
constexpr double last_digits = 8 * std::numeric_limits<double>::epsilon();
constexpr int sweeps_before_round_off = 32;

/// m/s, the largest component of all velocities.
double fastest(std::span<const Motion> motion)
{
  double largest = 0;
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
class LocalWork {
 public:
  explicit LocalWork(std::span<const BlockRuns> strips) : strips_(strips), swept_(strips.size(), 1)
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

  std::span<const BlockRuns> strips_;
  std::vector<std::uint8_t> swept_;
  std::size_t relaxed_ = 0, all_ = 0;  // blocks
  bool local_ = false;
};

}  // namespace

SolverReport solve_contacts(std::span<const BlockRuns> strips, std::size_t count,
                            std::span<Motion> motion, double friction, Effects effects,
                            const SolverSettings& settings, double floor,
                            Extrapolation& extrapolation, int threads, FreeBodies* free)
{
  SolverReport report;
  if (count == 0) return report;
  for_alternate_strips(threads, strips.size(), [&](std::size_t s) {
    apply_impulses(strips[s].blocks, motion.data(), effects);
  });
  if (free != nullptr) free->update_velocities(motion);
  const auto sweep = choose_sweep(effects);
  const auto contact_count = static_cast<double>(count);
  std::vector<SweepResult> results(strips.size());
  LocalWork work(strips);
  if (settings.acceleration) extrapolation.begin();
  double round_off = 0;  // m/s, once it is needed
  // The second sweep of a strip finds its contacts in the cache.
  const int at_a_time = strips.size() > 1 ? 2 : 1;
  for (int sweeps = at_a_time;; sweeps += at_a_time) {
    for_alternate_strips(threads, strips.size(), [&](std::size_t s) {
      for (int k = 0; work.swept(s) && k < at_a_time; ++k)
        results[s] = sweep(strips[s], motion.data(), friction);
    });
    auto result = total(results);
    if (free != nullptr) {
      result.largest = std::max(result.largest, free->update_velocities(motion));
      free->relax_contacts(motion, friction, effects);
      free->update_velocities(motion);
    }
    const double reference = std::max(std::sqrt(result.sum_reference / contact_count), floor);
    // Without gravity the sweep that lets the last contact go leaves a reference of 0.
    const auto relative = [&](double change) { return change == 0 ? 0 : change / reference; };
    report.sweeps = at_a_time * work.rounds();
    report.residual = relative(result.largest);
    report.residual_rms = relative(std::sqrt(result.sum_squares / contact_count));
    report.converged = report.residual <= settings.tolerance;
    if (!report.converged && sweeps >= sweeps_before_round_off) {
      if (round_off == 0) round_off = last_digits * fastest(motion);
      report.converged = result.largest <= round_off;
    }
    const bool enough = sweeps >= settings.min_sweeps || result.largest == 0;
    if ((report.converged && enough) || sweeps >= settings.max_sweeps) return report;
    work.choose(results, settings.tolerance * reference, enough && free == nullptr);
    if (settings.acceleration && !work.local())
      extrapolation.extrapolate(strips, motion, result.sum_squares, threads);
  }
}

}  // namespace grseg
