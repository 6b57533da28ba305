// SPDX-License-Identifier: GPL-3.0-or-later
#include "sim/contact/contact_blocks.hpp"
#include "sim/solver/sweep.hpp"
#include "tests/frozen_problem.hpp"
#include "tests/sim/contact_list.hpp"

#include <fmt/format.h>

#include <cmath>
#include <functional>

/// Error of the velocity change over the number of sweeps from a cold start, for the contacts of
/// one step of the chute: plain sweeps, over-relaxed sweeps, and Nesterov's extrapolation of the
/// impulses with restart. Over-relaxation by omega is a sweep with omega times the effective mass.
namespace grseg {
namespace {

/// Impulses and velocities, which depend linearly on each other.
struct State {
  std::vector<ContactBlock<2>> blocks;
  std::vector<std::uint32_t> ends;
  std::vector<Motion<2>> motion;
};

State cold_start(double omega)
{
  auto p = read_frozen_problem(GRSEG_TEST_INPUTS "/chute-contact-problem.txt");
  p.motion.emplace_back();
  for (auto& c : p.contacts) c.mass_n *= omega, c.mass_t *= omega;
  ContactBlocks packed;
  packed.pack(p.contacts, p.motion, p.motion.size() - 1);
  const auto runs = packed.runs();
  return {{runs.blocks.begin(), runs.blocks.end()}, {runs.ends.begin(), runs.ends.end()}, p.motion};
}

void sweep(State& s)
{
  choose_sweep<2>({})({s.blocks, s.ends}, s.motion.data(), FrozenProblem::friction);
}

/// Distance of two sets of velocities: the square root of twice the kinetic energy of their
/// difference (a disc's I omega^2 is m rim^2 / 2).
double distance(const std::vector<Motion<2>>& a, const std::vector<Motion<2>>& b)
{
  double sum = 0;
  for (std::size_t g = 0; g < a.size(); ++g) {
    if (a[g].inverse_mass == 0) continue;
    const double x = a[g].v[0] - b[g].v[0], y = a[g].v[1] - b[g].v[1],
                 s = a[g].rim[0] - b[g].rim[0];
    sum += (x * x + y * y + s * s / 2) / a[g].inverse_mass;
  }
  return std::sqrt(sum);
}

/// Returns to + factor (to - from), for impulses and velocities.
State extrapolate(const State& from, const State& to, double factor)
{
  State result = to;
  const auto extrapolate = [&](double a, double b) { return b + factor * (b - a); };
  for (std::size_t b = 0; b < to.blocks.size(); ++b)
    for (std::size_t lane = 0; lane < block_lanes; ++lane) {
      result.blocks[b].impulse_n[lane] =
          extrapolate(from.blocks[b].impulse_n[lane], to.blocks[b].impulse_n[lane]);
      result.blocks[b].impulse_t[0][lane] =
          extrapolate(from.blocks[b].impulse_t[0][lane], to.blocks[b].impulse_t[0][lane]);
    }
  for (std::size_t g = 0; g < to.motion.size(); ++g) {
    result.motion[g].v[0] = extrapolate(from.motion[g].v[0], to.motion[g].v[0]);
    result.motion[g].v[1] = extrapolate(from.motion[g].v[1], to.motion[g].v[1]);
    result.motion[g].rim[0] = extrapolate(from.motion[g].rim[0], to.motion[g].rim[0]);
  }
  return result;
}

/// True if the last step went against the change that the sweep from `start` asked for: compares
/// (start - now) and (now - before), impulses over effective masses.
bool turned_back(const State& start, const State& now, const State& before)
{
  double product = 0;
  for (std::size_t b = 0; b < now.blocks.size(); ++b)
    for (std::size_t lane = 0; lane < block_lanes; ++lane) {
      const auto &s = start.blocks[b], &n = now.blocks[b], &o = before.blocks[b];
      if (n.mass_n[lane] == 0) continue;
      product += (s.impulse_n[lane] - n.impulse_n[lane]) * (n.impulse_n[lane] - o.impulse_n[lane]) /
                 n.mass_n[lane];
      product += (s.impulse_t[0][lane] - n.impulse_t[0][lane]) *
                 (n.impulse_t[0][lane] - o.impulse_t[0][lane]) / n.mass_t[lane];
    }
  return product > 0;
}

using EachSweep = std::function<void(int, const State&)>;

void run_plain(double omega, int sweeps, const EachSweep& report)
{
  auto state = cold_start(omega);
  for (int k = 1; k <= sweeps; ++k) {
    sweep(state);
    report(k, state);
  }
}

void run_nesterov(double omega, int sweeps, const EachSweep& report)
{
  auto before = cold_start(omega), start = before;
  double t = 1;
  for (int k = 1; k <= sweeps; ++k) {
    auto now = start;
    sweep(now);
    if (turned_back(start, now, before)) t = 1;
    const double next_t = (1 + std::sqrt(1 + 4 * t * t)) / 2;
    start = extrapolate(before, now, (t - 1) / next_t);
    t = next_t;
    before = now;
    report(k, now);
  }
}

void print(const char* name, double omega, bool nesterov, const State& exact)
{
  const auto free = cold_start(1).motion;
  const double change = distance(exact.motion, free);
  fmt::print("{:<10} {:>5}", name, omega);
  const EachSweep report = [&](int k, const State& s) {
    for (const int shown : {10, 20, 40, 80, 100, 160, 320, 640, 1280})
      if (k == shown) fmt::print(" {:9.3g}", distance(s.motion, exact.motion) / change);
  };
  (nesterov ? run_nesterov : run_plain)(omega, 1280, report);
  fmt::print("\n");
}

void print_all()
{
  State exact, other;
  run_nesterov(1, 20000, [&](int, const State& s) { exact = s; });
  run_plain(1, 100000, [&](int k, const State& s) {
    if (k == 100000) other = s;
  });
  const auto free = cold_start(1).motion;
  fmt::print("# reference: 20000 accelerated sweeps; 100000 plain ones differ by {:.2g}\n",
             distance(exact.motion, other.motion) / distance(exact.motion, free));
  fmt::print(
      "# method     omega, error of the velocity change (energy norm) after 10 20 40 80 100 "
      "160 320 640 1280 sweeps\n");
  for (const double omega : {1.0, 1.2, 1.3, 1.4, 1.5, 1.6}) print("plain", omega, false, exact);
  for (const double omega : {0.8, 1.0, 1.2, 1.3}) print("nesterov", omega, true, exact);
}

}  // namespace
}  // namespace grseg

int main()
{
  grseg::print_all();
}
