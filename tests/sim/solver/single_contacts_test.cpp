// SPDX-License-Identifier: GPL-3.0-or-later
#include "sim/solver/single_contacts.hpp"

#include "sim/contact/contact_law-inl.hpp"
#include "sim/solver/sweep.hpp"
#include "tests/frozen_problem.hpp"
#include "tests/sim/contact_list.hpp"

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <limits>

/// Sweeps in single precision, and their results in double precision.
namespace grseg {
namespace {

namespace law = HWY_NAMESPACE;

/// The frozen problem with the entry on which unused lanes act. Contacts already have a load, which
/// the velocities do not include yet.
FrozenProblem problem()
{
  auto p = read_frozen_problem(GRSEG_TEST_INPUTS "/chute-contact-problem.txt");
  p.motion.emplace_back();
  for (std::size_t k = 0; k < p.contacts.size(); ++k) {
    auto& c = p.contacts[k];
    c.kappa = 0.98 + 0.0005 * static_cast<double>(k % 60);
    c.impulse_n = c.mass_n * 1e-3 * static_cast<double>(k % 7);
    c.impulse_t[0] = 0.5 * c.impulse_n * (static_cast<double>(k % 3) - 1);
  }
  return p;
}

using Bits = std::vector<std::uint32_t>;

void add_bits(Bits& bits, float x)
{
  bits.push_back(std::bit_cast<std::uint32_t>(x));
}

bool in_use(const BlockOf<2, float>& block, std::size_t lane)
{
  return block.i[lane] != block.j[lane];
}

Bits bits_of(std::span<const BlockOf<2, float>> blocks, std::span<const MotionOf<2, float>> motion)
{
  Bits bits;
  for (const auto& b : blocks)
    for (std::size_t k = 0; k < lanes_of<float>; ++k)
      if (in_use(b, k)) add_bits(bits, b.impulse_n[k]), add_bits(bits, b.impulse_t[0][k]);
  for (const auto& m : motion)
    for (const float x : {m.v[0], m.v[1], m.rim[0]}) add_bits(bits, x);
  return bits;
}

/// Relaxes the contacts one by one, in the order of blocks and lanes.
template <Effects with>
void relax_one_by_one(std::span<BlockOf<2, float>> blocks, std::vector<MotionOf<2, float>>& motion)
{
  for (auto& b : blocks)
    for (std::size_t k = 0; k < lanes_of<float>; ++k) {
      if (!in_use(b, k)) continue;
      const std::uint32_t i = b.i[k] / 4, j = b.j[k] / 4;
      Increments<2, float> c{
          {b.n[0][k], b.n[1][k]}, b.kappa[k],         b.weight_i[k], b.weight_j[k],
          b.mass_ratio[k],        b.rebound[k],       b.base_n[k],   {b.base_t[0][k]},
          b.impulse_n[k],         {b.impulse_t[0][k]}};
      law::relax<with>(c, motion[i], motion[j], static_cast<float>(FrozenProblem::friction));
      b.impulse_n[k] = c.impulse_n;
      b.impulse_t[0][k] = c.impulse_t[0];
    }
}

template <Effects with>
void expect_the_law(const std::string& instructions)
{
  use_instruction_set(instructions);
  auto p = problem();
  ContactBlocks packed;
  packed.pack(p.contacts, p.motion, p.motion.size() - 1);
  SingleContacts<2> singles;
  const std::array strips{packed.runs()};
  singles.take(strips, p.motion, with, 1);
  const auto& run = singles.strips()[0];
  std::vector<BlockOf<2, float>> blocks(run.blocks.begin(), run.blocks.end());
  std::vector<MotionOf<2, float>> motion(singles.motion().begin(), singles.motion().end());
  for (int sweep = 0; sweep < 4; ++sweep) {
    choose_sweep<2, float>(with)(run, singles.motion().data(),
                                 static_cast<float>(FrozenProblem::friction));
    relax_one_by_one<with>(blocks, motion);
  }
  EXPECT_EQ(bits_of(run.blocks, singles.motion()), bits_of(blocks, motion)) << instructions;
  use_instruction_set("");
}

TEST(SinglePrecision, SweepsAreTheLawOfAPairToTheLastBitOnEveryInstructionSet)
{
  for (const auto& set : instruction_sets()) {
    expect_the_law<Effects{true, true, true}>(set);
    expect_the_law<Effects{true, true, false}>(set);
    expect_the_law<Effects{true, false, true}>(set);
    expect_the_law<Effects{false, false, true}>(set);
    expect_the_law<Effects{false, false, false}>(set);
  }
}

TEST(SinglePrecision, MeasuresAreThoseOfEveryContact)
{
  auto p = problem();
  ContactBlocks packed;
  packed.pack(p.contacts, p.motion, p.motion.size() - 1);
  auto twice = p;
  ContactBlocks again;
  again.pack(twice.contacts, twice.motion, twice.motion.size() - 1);
  SingleContacts<2> singles;
  apply_impulses<2>(again.blocks(), twice.motion.data(), {});
  singles.take(std::array{packed.runs()}, p.motion, {}, 1);
  const auto found = choose_sweep<2, float>({})(singles.strips()[0], singles.motion().data(), 0.5F);
  const auto exact = choose_sweep<2>({})(again.runs(), twice.motion.data(), 0.5);
  // Bound: a rounding error of the fastest velocity in each of the ten relaxations of a body, over
  // the largest change; sums of squares have twice that.
  constexpr double error = 1e-4;
  EXPECT_NEAR(found.largest, exact.largest, error * exact.largest);
  EXPECT_NEAR(found.sum_squares, exact.sum_squares, 2 * error * exact.sum_squares);
  EXPECT_NEAR(found.sum_reference, exact.sum_reference, 2 * error * exact.sum_reference);
}

struct Solved {
  std::vector<Contact<2>> contacts;
  std::vector<Motion<2>> motion;
  int sweeps;
};

Solved solved(Precision precision, SolverSettings settings)
{
  auto p = problem();
  p.motion.pop_back();
  settings.precision = precision;
  const auto report = solve_contacts(p.contacts, p.motion, p.friction, {}, settings, 0);
  return {p.contacts, p.motion, report.sweeps};
}

TEST(SinglePrecision, VelocitiesAreThoseOfDoublePrecisionUpToItsRounding)
{
  constexpr int sweeps = 24;
  const SolverSettings settings{
      .tolerance = 0, .max_sweeps = sweeps, .acceleration = false, .min_sweeps = sweeps};
  const auto mixed = solved(Precision::mixed, settings),
             exact = solved(Precision::doubles, settings);
  double fastest = 0, largest = 0;
  for (std::size_t b = 0; b < exact.motion.size(); ++b) {
    const auto &m = mixed.motion[b], &e = exact.motion[b];
    fastest = std::max({fastest, std::abs(e.v[0]), std::abs(e.v[1]), std::abs(e.rim[0])});
    largest = std::max({largest, std::abs(m.v[0] - e.v[0]), std::abs(m.v[1] - e.v[1]),
                        std::abs(m.rim[0] - e.rim[0])});
  }
  // A disc of diameter 2 has at most nine neighbours of diameter 1. Each relaxation rounds the
  // velocities of its bodies once, and sweeps do not amplify these errors.
  constexpr double relaxations = 9 * sweeps;
  EXPECT_LT(largest, relaxations * std::numeric_limits<float>::epsilon() * fastest);
  EXPECT_GT(largest, 0);
  EXPECT_EQ(mixed.sweeps, exact.sweeps);
}

TEST(SinglePrecision, MomentumAndSpinBalanceInDoublePrecision)
{
  const auto start = problem().motion;
  const auto end = solved(Precision::mixed, {.tolerance = 0.1, .max_sweeps = 100});
  std::vector<Vec2> momentum(end.motion.size(), Vec2::Zero());  // momentum from contacts, kg m/s
  std::vector<double> spin(end.motion.size(), 0);               // mass times rim speed, kg m/s
  double largest = 0;
  for (const auto& c : end.contacts) {
    const auto i = static_cast<std::size_t>(c.i), j = static_cast<std::size_t>(c.j);
    const Vec2 normal(c.n[0], c.n[1]), tangent(-c.n[1], c.n[0]);
    const Vec2 impulse = c.impulse_n * normal + c.impulse_t[0] * tangent;
    momentum[i] += impulse;
    momentum[j] -= impulse;
    for (const auto b : {i, j}) spin[b] -= rim_factor<2> * c.kappa * c.impulse_t[0];
    largest = std::max(largest, impulse.norm());
  }
  for (std::size_t b = 0; b < end.motion.size(); ++b) {
    const auto &m = end.motion[b], &s = start[b];
    if (m.inverse_mass == 0) continue;
    // Round-off of velocities of some m/s, as in a computation in double precision.
    EXPECT_NEAR((m.v[0] - s.v[0]) / m.inverse_mass, momentum[b].x(),
                1e-12 * (largest + 1 / m.inverse_mass));
    EXPECT_NEAR((m.v[1] - s.v[1]) / m.inverse_mass, momentum[b].y(),
                1e-12 * (largest + 1 / m.inverse_mass));
    EXPECT_NEAR((m.rim[0] - s.rim[0]) / m.inverse_mass, spin[b],
                1e-12 * (largest + 1 / m.inverse_mass));
  }
}

TEST(SinglePrecision, NoContactPullsOrRubsHarderThanCoulombAllows)
{
  const auto end = solved(Precision::mixed, {.tolerance = 0.1, .max_sweeps = 100});
  std::size_t bearing = 0, open = 0, sliding = 0;
  for (const auto& c : end.contacts) {
    EXPECT_GE(c.impulse_n, 0);
    EXPECT_LE(std::abs(c.impulse_t[0]), FrozenProblem::friction * c.impulse_n);
    bearing += c.impulse_n > 0;
    open += c.impulse_n == 0;
    sliding += c.impulse_n > 0 && std::abs(c.impulse_t[0]) == FrozenProblem::friction * c.impulse_n;
  }
  EXPECT_GT(bearing, 1000u);
  EXPECT_GT(open, 100u);
  EXPECT_GT(sliding, 100u);
}

TEST(SinglePrecision, AContactThatPartsLosesItsLoadToTheLastDigit)
{
  // Loads with digits that single precision cannot represent.
  for (const double load : {0.1, 1.0 / 3, 0.7}) {
    std::vector<Motion<2>> motion{{{load, 0}, 1}, {{-load, 0}, 1}};  // as if it had twice the load
    Contact<2> c{};
    c.n[0] = 1, c.kappa = 1;
    c.mass_n = 0.5, c.mass_t = c.mass_n / 3;
    c.impulse_n = load, c.impulse_t[0] = load / 7;
    c.i = 0, c.j = 1;
    std::vector<Contact<2>> contacts{c};
    solve_contacts(contacts, motion, 0.5, {}, {.max_sweeps = 10, .precision = Precision::mixed}, 0);
    EXPECT_EQ(contacts[0].impulse_n, 0);
    EXPECT_EQ(contacts[0].impulse_t[0], 0);
    EXPECT_EQ(motion[0].v[0], load);
    EXPECT_EQ(motion[0].rim[0], 0);
  }
}

TEST(SinglePrecision, UnitsOfMassChangeNoDigit)
{
  auto p = problem();
  p.motion.pop_back();
  auto heavy = p;
  constexpr double unit = 1024.0 * 1024 * 1024;
  for (auto& m : heavy.motion) m.inverse_mass /= unit;
  for (auto& c : heavy.contacts)
    for (auto* x : {&c.mass_n, &c.mass_t, &c.impulse_n, &c.impulse_t[0]}) *x *= unit;
  const SolverSettings settings{.tolerance = 0.1, .max_sweeps = 100, .precision = Precision::mixed};
  solve_contacts(p.contacts, p.motion, p.friction, {}, settings, 0);
  solve_contacts(heavy.contacts, heavy.motion, p.friction, {}, settings, 0);
  for (std::size_t b = 0; b < p.motion.size(); ++b) {
    EXPECT_EQ(p.motion[b].v[0], heavy.motion[b].v[0]);
    EXPECT_EQ(p.motion[b].v[1], heavy.motion[b].v[1]);
  }
}

}  // namespace
}  // namespace grseg
