// SPDX-License-Identifier: GPL-3.0-or-later
#include "sim/solver/solver.hpp"

#include "tests/sim/contact_list.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <random>
#include <tuple>

namespace grseg {
namespace {

TEST(Solver, AVelocityFarBelowTheFloorNeedsNoSecondSweep)
{
  std::vector<Motion<2>> motion{{{0, -1e-12}, 1}, {}};
  Contact<2> c{};
  c.n[1] = c.kappa = c.mass_n = 1;
  c.mass_t = 1.0 / 3;
  c.j = 1;
  std::vector<Contact<2>> contacts{c};
  EXPECT_EQ(solve_contacts(contacts, motion, 0.5, {}, {1e-2, 100}, 1e-6).sweeps, 1);
}

TEST(Solver, MakesTheLeastNumberOfSweepsUnlessOneChangesNothing)
{
  // A column of ten discs on a floor, without initial impulses; from the first sweep on, the floor
  // carries the lowest disc only.
  const auto sweeps = [](int discs, int at_least) {
    std::vector<Motion<2>> motion(static_cast<std::size_t>(discs), Motion<2>{{0, -1}, 1});
    motion.push_back({});
    std::vector<Contact<2>> contacts;
    for (int k = 0; k < discs; ++k) {
      Contact<2> c{};
      c.n[1] = c.kappa = 1;
      c.mass_n = k == 0 ? 1 : 0.5;
      c.mass_t = c.mass_n / 3;
      c.i = k, c.j = k == 0 ? discs : k - 1;
      contacts.push_back(c);
    }
    return solve_contacts(contacts, motion, 0, {}, {10, 100, false, at_least}, 0).sweeps;
  };
  EXPECT_EQ(sweeps(10, 1), 1);
  EXPECT_EQ(sweeps(10, 8), 8);
  EXPECT_EQ(sweeps(1, 8), 2);
}

TEST(Solver, ComparesChangesWithNoMoreThanTheRangeAllows)
{
  // A wall stops a disc of speed 1, and two others hit a disc of speed 1e-3 in turn: the mean of W
  // p is dominated by the fast disc.
  const auto residual = [](const ReferenceRange& range) {
    std::vector<Motion<2>> motion{{{0, -1}, 1}, {{1e-3, 0}, 1}, {{-1e-3, 0}, 1}, {}};
    Contact<2> stop{};
    stop.n[1] = stop.kappa = stop.mass_n = 1;
    stop.i = 0, stop.j = 3;
    Contact<2> hit{};
    hit.n[0] = -1;
    hit.kappa = 1;
    hit.mass_n = 0.5;
    hit.i = 1, hit.j = 2;
    std::vector<Contact<2>> contacts{stop, hit};
    return solve_contacts(contacts, motion, 0, {}, {10, 1}, range).residual;
  };
  EXPECT_NEAR(residual(0), std::sqrt(2), 1e-5);
  EXPECT_NEAR(residual({0, 0.01}), 1 / 0.01, 1e-9);
}

/// Rows of ten touching discs, one strip each; the first disc of the first row is hit.
struct Rows {
  static constexpr std::size_t discs = 10;
  std::vector<Motion<2>> motion;
  std::vector<ContactBlocks> packed;

  explicit Rows(std::size_t rows) : motion(rows * discs, Motion<2>{{0, 0}, 1}), packed(rows)
  {
    motion[0].v[0] = 1;
    motion.emplace_back();
    for (std::size_t r = 0; r < rows; ++r) {
      std::vector<Contact<2>> contacts;
      for (std::size_t k = discs - 1; k > 0; --k) {
        Contact<2> c{};
        c.n[0] = c.kappa = 1, c.mass_n = 0.5, c.mass_t = 1.0 / 6;
        c.i = static_cast<std::int32_t>(r * discs + k);
        c.j = c.i - 1;
        contacts.push_back(c);
      }
      packed[r].pack(contacts, motion, motion.size() - 1);
    }
  }
  SolverReport solve(int threads)
  {
    std::vector<BlockRuns<2>> strips;
    for (auto& p : packed) strips.push_back(p.runs());
    SolverMemory<2> memory;
    return solve_contacts<2>(
        strips, motion, {packed.size() * (discs - 1), 0, {}, {1e-6, 10000}, 0, threads}, memory);
  }
};

TEST(Solver, AStripThatNeedsManySweepsDoesNotCostOthersMore)
{
  Rows one(1), many(40), shared(40);
  const auto alone = one.solve(1), among = many.solve(1);
  EXPECT_TRUE(among.converged);
  EXPECT_LE(among.residual, 1e-6);
  EXPECT_GT(alone.sweeps, 100);
  EXPECT_LT(among.sweeps, alone.sweeps / 5);
  for (std::size_t k = 0; k < Rows::discs; ++k) EXPECT_NEAR(many.motion[k].v[0], 0.1, 1e-3);
  EXPECT_EQ(shared.solve(3).sweeps, among.sweeps);
  for (std::size_t k = 0; k < Rows::discs; ++k)
    EXPECT_EQ(shared.motion[k].v[0], many.motion[k].v[0]);
}

/// Rows of ten discs, one strip each, that touch along rows and columns and are hit at random; an even
/// number of rows closes to a ring.
struct Net {
  static constexpr std::size_t discs = 10;
  std::vector<Motion<2>> motion;
  std::vector<ContactBlocks> packed;
  std::vector<BlockRuns<2>> strips;

  explicit Net(std::size_t rows) : packed(rows)
  {
    std::mt19937 random(static_cast<unsigned>(rows));
    const auto number = [&] { return 1e-9 * static_cast<double>(random()) - 2; };
    for (std::size_t k = 0; k < rows * discs; ++k)
      motion.push_back({{number(), number()}, 1, {number()}});
    motion.emplace_back();
    for (std::size_t r = 0; r < rows; ++r) {
      std::vector<Contact<2>> contacts;
      for (std::size_t k = 0; k < discs; ++k) {
        if (k > 0) contacts.push_back(contact(r * discs + k, r * discs + k - 1, 1, 0));
        if (r + 1 < rows || rows % 2 == 0)
          contacts.push_back(contact((r + 1) % rows * discs + k, r * discs + k, 0, 1));
      }
      packed[r].pack(contacts, motion, motion.size() - 1);
    }
    for (std::size_t r = 0; r < rows; ++r) {
      strips.push_back(
          {packed[r].blocks(),
           packed[r].runs().ends,
           {static_cast<std::uint32_t>(r * discs), static_cast<std::uint32_t>((r + 1) * discs)}});
    }
  }
  static Contact<2> contact(std::size_t i, std::size_t j, double nx, double ny)
  {
    Contact<2> c{};
    c.n[0] = nx, c.n[1] = ny, c.kappa = 1, c.mass_n = 0.5, c.mass_t = 1.0 / 6;
    c.i = static_cast<std::int32_t>(i), c.j = static_cast<std::int32_t>(j);
    return c;
  }
  std::vector<double> numbers() const
  {
    std::vector<double> all;
    for (const auto& m : motion) all.insert(all.end(), {m.v[0], m.v[1], m.rim[0]});
    for (const auto& strip : strips)
      for (const auto& b : strip.blocks)
        for (const auto& lanes : {b.impulse_n, b.impulse_t[0]})
          all.insert(all.end(), lanes.begin(), lanes.end());
    return all;
  }
  /// Sweeps all strips one after the other, even numbers first, then extrapolates; the
  /// extrapolation uses changes from the eighth sweep on.
  void sweep_round_after_round(int sweeps, bool acceleration)
  {
    const auto sweep = choose_sweep<2>({});
    ExtrapolationOf<2, double> extrapolation;
    extrapolation.begin(strips, motion, 1);
    for (int done = 0; done < sweeps; done += 2) {
      double change = 0;
      for (const std::size_t odd : {0U, 1U})
        for (std::size_t r = odd; r < strips.size(); r += 2) {
          sweep(strips[r], motion.data(), 0.5);
          change_[r] = sweep(strips[r], motion.data(), 0.5).sum_squares;
        }
      for (const double of_strip : change_) change += of_strip;
      if (!acceleration || done + 2 >= sweeps) continue;
      if (done + 2 < 8) extrapolation.set_last_change(std::numeric_limits<double>::infinity());
      extrapolation.extrapolate(strips, motion, change, 1);
    }
  }

 private:
  std::vector<double> change_ = std::vector<double>(packed.size());
};

TEST(Solver, StripsThatGoAheadEndWhereRoundAfterRoundEnds)
{
  for (const std::size_t rows : {2U, 3U, 6U, 7U, 30U}) {
    for (const auto& [least, most, acceleration] : {std::tuple{1, 1, true},
                                                    {2, 2, true},
                                                    {8, 3, true},
                                                    {8, 8, true},
                                                    {8, 8, false},
                                                    {60, 60, true}}) {
      const int sweeps = (std::min(least, most) + 1) / 2 * 2;
      Net expected(rows);
      expected.sweep_round_after_round(sweeps, acceleration);
      for (const int threads : {1, 2, 3}) {
        Net net(rows);
        SolverMemory<2> memory;
        const auto report = solve_contacts<2>(
            net.strips, net.motion,
            {19 * rows, 0.5, {}, {1e9, most, acceleration, least}, 0, threads}, memory);
        EXPECT_EQ(report.sweeps, sweeps);
        EXPECT_EQ(net.numbers(), expected.numbers())
            << rows << " rows, " << sweeps << " sweeps, " << threads << " threads";
      }
    }
  }
}

TEST(Solver, StripsThatGoAheadInSinglePrecisionGiveTheSameWithAnyNumberOfThreads)
{
  const auto solved = [](int threads) {
    Net net(30);
    SolverMemory<2> memory;
    solve_contacts<2>(net.strips, net.motion,
                      {19 * 30, 0.5, {}, {1e-3, 100, true, 8, Precision::mixed}, 0, threads},
                      memory);
    return net.numbers();
  };
  const auto alone = solved(1);
  EXPECT_EQ(solved(2), alone);
  EXPECT_EQ(solved(3), alone);
}

TEST(Solver, WithoutGravityTheSweepThatOpensTheLastContactIsFollowedByAnother)
{
  // Two discs that part, with an impulse between them that was correct before.
  std::vector<Motion<2>> motion{{{1, 0}, 1}, {{-1, 0}, 1}};
  Contact<2> c{};
  c.n[0] = c.kappa = c.impulse_n = 1;
  c.mass_n = 0.5, c.mass_t = 1.0 / 6;
  c.j = 1;
  std::vector<Contact<2>> contacts{c};
  const auto report = solve_contacts(contacts, motion, 0.5, {}, {0.5, 100}, 0);
  EXPECT_EQ(report.sweeps, 2);
  EXPECT_EQ(report.residual, 0);
  EXPECT_EQ(contacts[0].impulse_n, 0);
  EXPECT_EQ(motion[0].v[0], 1);
}

TEST(Solver, ANewcomerIsNotHiddenByThousandsOfSettledContacts)
{
  // 4000 discs rest on a floor with known impulses, beside a row of 10 touching discs whose first
  // disc is hit: without restitution all ten end with a tenth of its speed.
  const int row = 10, settled = 4000;
  std::vector<Motion<2>> motion;
  std::vector<Contact<2>> contacts;
  const auto join = [&](int i, int j, double nx, double ny, double mass, double impulse) {
    Contact<2> c{};
    c.n[0] = nx, c.n[1] = ny, c.kappa = 1;
    c.mass_n = mass, c.mass_t = mass / 3;
    c.impulse_n = impulse;
    c.i = i, c.j = j;
    contacts.push_back(c);
  };
  for (int k = 0; k < row; ++k) motion.push_back({{k == 0 ? 1.0 : 0.0, 0}, 1});
  for (int k = 0; k < settled; ++k) motion.push_back({{0, -1}, 1});
  motion.push_back({});
  for (int k = 0; k < settled; ++k) join(row + k, row + settled, 0, 1, 1, 1);
  for (int k = row - 2; k >= 0; --k) join(k + 1, k, 1, 0, 0.5, 0);
  const auto report = solve_contacts(contacts, motion, 0, {}, {1e-3, 100000}, 0);
  EXPECT_TRUE(report.converged);
  EXPECT_LE(report.residual, 1e-3);
  EXPECT_LE(contact_residual(contacts, motion, 0, {}), 1e-3);
  for (int k = 0; k < row; ++k) EXPECT_NEAR(motion[static_cast<std::size_t>(k)].v[0], 0.1, 0.05);
}

/// n discs in a column on the ground, at rest except for gravity of one step.
struct Column {
  std::vector<Motion<2>> motion;
  std::vector<Contact<2>> contacts;

  explicit Column(int n)
  {
    for (int k = 0; k < n; ++k) motion.push_back({{0.1 * (k % 3), -1}, 1, {0.2}});
    motion.push_back({});
    for (int k = 0; k < n; ++k) {
      Contact<2> c{};
      c.n[1] = c.kappa = 1;
      c.mass_n = k == 0 ? 1 : 0.5;
      c.mass_t = c.mass_n / 3;
      c.i = k;
      c.j = k == 0 ? n : k - 1;
      contacts.push_back(c);
    }
  }
  int sweeps(bool acceleration)
  {
    return solve_contacts(contacts, motion, 0.5, {}, {1e-10, 100000, acceleration}, 0).sweeps;
  }
};

TEST(Solver, AccelerationFindsTheSameSolutionWithAFifthOfTheSweeps)
{
  // Plain sweeps contract the error by cos^2(pi/2n), so about n^2 sweeps are needed; with
  // extrapolation about n. Odd and even numbers of bodies end differently in vector registers.
  for (const int n : {40, 41, 42, 43}) {
    Column plain(n), accelerated(n);
    const int sweeps = plain.sweeps(false);
    EXPECT_LT(accelerated.sweeps(true), sweeps / 5);
    EXPECT_LT(contact_residual(accelerated.contacts, accelerated.motion, 0.5, {}), 1e-8);
    for (std::size_t k = 0; k < plain.contacts.size(); ++k) {
      EXPECT_NEAR(accelerated.contacts[k].impulse_n,
                  static_cast<double>(n) - static_cast<double>(k), 1e-5);
      EXPECT_NEAR(accelerated.motion[k].v[0], plain.motion[k].v[0], 1e-5);
    }
    EXPECT_EQ(accelerated.motion.size(), plain.motion.size());
  }
}

TEST(Solver, AccelerationLeavesASolutionAlone)
{
  Column column(10);
  column.sweeps(true);
  auto again = column;
  for (auto& m : again.motion)
    if (m.inverse_mass > 0) m = {{0, -1}, 1};
  for (auto& c : again.contacts) c.impulse_t[0] = 0;
  EXPECT_LE(again.sweeps(true), 12);
  for (std::size_t k = 0; k < 10; ++k)
    EXPECT_NEAR(again.contacts[k].impulse_n, column.contacts[k].impulse_n, 1e-8);
}

}  // namespace
}  // namespace grseg
