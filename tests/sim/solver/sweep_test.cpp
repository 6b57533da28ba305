// SPDX-License-Identifier: GPL-3.0-or-later
#include "sim/solver/sweep.hpp"

#include "tests/frozen_problem.hpp"
#include "tests/sim/contact_list.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <set>

namespace grseg {
namespace {

std::vector<std::uint64_t> bits_of(const std::vector<Motion<2>>& motion)
{
  std::vector<std::uint64_t> bits;
  for (const auto& m : motion)
    for (const double x : {m.v[0], m.v[1], m.rim[0], m.inverse_mass})
      bits.push_back(std::bit_cast<std::uint64_t>(x));
  return bits;
}

std::vector<std::uint64_t> bits_of(const std::vector<Contact<2>>& contacts)
{
  std::vector<std::uint64_t> bits;
  for (const auto& c : contacts)
    for (const double x : {c.impulse_n, c.impulse_t[0]})
      bits.push_back(std::bit_cast<std::uint64_t>(x));
  return bits;
}

/// The first `count` contacts of the frozen problem; the last mobile body is replaced by a wall,
/// which some grains touch.
FrozenProblem problem(std::size_t count = 5459)
{
  static const auto read = read_frozen_problem(GRSEG_TEST_INPUTS "/chute-contact-problem.txt");
  auto p = read;
  p.contacts.resize(count);
  const auto wall = static_cast<std::int32_t>(p.motion.size());
  p.motion.push_back({{0.01, -0.02}});
  for (std::int32_t g = 100; g < 120; ++g) {
    Contact<2> c{};
    c.n[0] = 0.6, c.n[1] = 0.8, c.kappa = 1;
    c.mass_n = 1 / p.motion[static_cast<std::size_t>(g)].inverse_mass;
    c.mass_t = c.mass_n / 3;
    c.rebound = 0.001;
    c.i = g, c.j = wall;
    p.contacts.push_back(c);
  }
  for (std::size_t k = 0; k < p.contacts.size(); ++k)
    p.contacts[k].kappa = 0.98 + 0.0005 * static_cast<double>(k % 60);
  return p;
}

constexpr int sweeps = 4;

/// Results of sweeps as bits: bodies, contacts, and the report of the last sweep.
std::vector<std::uint64_t> swept(FrozenProblem p, Effects effects)
{
  p.motion.emplace_back();
  ContactBlocks packed;
  packed.pack(p.contacts, p.motion, p.motion.size() - 1);
  SweepResult result;
  for (int s = 0; s < sweeps; ++s)
    result = choose_sweep<2>(effects)(packed.runs(), p.motion.data(), p.friction);
  packed.unpack(p.contacts);
  EXPECT_EQ(bits_of({p.motion.back()}), bits_of(std::vector<Motion<2>>{{}}));
  auto bits = bits_of(p.motion), impulses = bits_of(p.contacts);
  bits.insert(bits.end(), impulses.begin(), impulses.end());
  for (const double x : {result.largest, result.sum_squares, result.sum_reference})
    bits.push_back(std::bit_cast<std::uint64_t>(x));
  return bits;
}

/// The same results, computed contact by contact in the order of the colours; each sum is first
/// over the contacts of one lane.
std::vector<std::uint64_t> relaxed(FrozenProblem p, Effects effects)
{
  const auto relax_alone = choose_relax<2>(effects);
  p.motion.emplace_back();
  ContactBlocks packed;
  packed.pack(p.contacts, p.motion, p.motion.size() - 1);
  std::vector<std::size_t> contact_in(packed.blocks().size() * block_lanes, p.contacts.size());
  for (std::size_t k = 0; k < p.contacts.size(); ++k) contact_in[packed.slots()[k]] = k;
  double largest = 0;
  std::array<double, 8> squares{}, reference{};
  for (int s = 0; s < sweeps; ++s) {
    largest = 0, squares = {}, reference = {};
    for (std::size_t slot = 0; slot < contact_in.size(); ++slot) {
      if (contact_in[slot] == p.contacts.size()) continue;
      auto& c = p.contacts[contact_in[slot]];
      auto alone = c;
      if (!effects.restitution) alone.rebound = 0;
      const auto r = relax_alone(alone, p.motion[static_cast<std::size_t>(c.i)],
                                 p.motion[static_cast<std::size_t>(c.j)], p.friction);
      c.impulse_n = alone.impulse_n;
      c.impulse_t[0] = alone.impulse_t[0];
      largest = std::max({largest, r.change_n, std::abs(r.change_t[0])});
      squares[slot % 8] += r.change_n * r.change_n;
      reference[slot % 8] += r.level_n * r.level_n;
      if (!effects.friction) continue;
      squares[slot % 8] += r.change_t[0] * r.change_t[0];
      reference[slot % 8] += r.level_t[0] * r.level_t[0];
    }
  }
  auto bits = bits_of(p.motion), impulses = bits_of(p.contacts);
  bits.insert(bits.end(), impulses.begin(), impulses.end());
  const auto sum = [](const auto& s) {
    return ((s[0] + s[4]) + (s[2] + s[6])) + ((s[1] + s[5]) + (s[3] + s[7]));
  };
  for (const double x : {largest, sum(squares), sum(reference)})
    bits.push_back(std::bit_cast<std::uint64_t>(x));
  return bits;
}

/// Every test runs once per instruction set of this machine.
class SweepOn : public testing::TestWithParam<std::string> {
 protected:
  void SetUp() override { use_instruction_set(GetParam()); }
  void TearDown() override { use_instruction_set(""); }
};

INSTANTIATE_TEST_SUITE_P(EveryInstructionSet, SweepOn, testing::ValuesIn(instruction_sets()),
                         [](const auto& set) { return set.param; });

TEST_P(SweepOn, RunsOnTheInstructionSetAskedFor)
{
  EXPECT_EQ(instruction_set(), GetParam());
}

TEST_P(SweepOn, EveryVariantEqualsTheContactLawInOrderOfColoursToTheLastBit)
{
  const auto p = problem();
  for (const bool friction : {true, false})
    for (const bool rotation : {true, false})
      for (const bool restitution : {true, false}) {
        const Effects effects{friction, rotation, restitution};
        EXPECT_EQ(swept(p, effects), relaxed(p, effects));
      }
}

TEST_P(SweepOn, AnyNumberOfContactsFitsIntoBlocks)
{
  for (std::size_t count = 0; count < 40; ++count)
    EXPECT_EQ(swept(problem(count), {}), relaxed(problem(count), {})) << count;
}

TEST_P(SweepOn, ABodyWithMoreContactsThanColoursIsSweptOneByOne)
{
  FrozenProblem p;
  p.motion.assign(201, {{0, 0}, 1});
  p.motion[0] = {{1, -2}, 0.01, {0.5}};
  for (std::int32_t g = 1; g <= 200; ++g) {
    Contact<2> c{};
    c.n[0] = std::cos(g), c.n[1] = std::sin(g), c.kappa = 1;
    c.mass_n = 1 / 1.01;
    c.mass_t = c.mass_n / 3;
    c.i = g, c.j = 0;
    p.contacts.push_back(c);
  }
  EXPECT_EQ(swept(p, {}), relaxed(p, {}));
}

TEST_P(SweepOn, AnEffectLeftOutEqualsItsNeutralCoefficientToTheLastBit)
{
  auto inelastic = problem();
  for (auto& c : inelastic.contacts) c.rebound = 0;
  EXPECT_EQ(swept(inelastic, {}), swept(problem(), {.restitution = false}));
  // Without rotation lever arms are 0, so friction turns nothing and rim speeds have no effect.
  auto pointlike = problem();
  for (auto& c : pointlike.contacts) c.kappa = 0;
  EXPECT_EQ(swept(pointlike, {}), swept(problem(), {.rotation = false}));
}

TEST_P(SweepOn, FrictionLeftOutEqualsZeroFrictionToTheLastBit)
{
  auto with = problem(), without = problem();
  ContactBlocks packed;
  for (auto* p : {&with, &without}) {
    p->motion.emplace_back();
    packed.pack(p->contacts, p->motion, p->motion.size() - 1);
    const Effects effects{.friction = p == &with};
    for (int s = 0; s < sweeps; ++s) choose_sweep<2>(effects)(packed.runs(), p->motion.data(), 0);
    packed.unpack(p->contacts);
  }
  EXPECT_EQ(bits_of(with.motion), bits_of(without.motion));
  EXPECT_EQ(bits_of(with.contacts), bits_of(without.contacts));
}

TEST_P(SweepOn, ImpulsesAppliedMoveTheBodiesAsRelaxingDid)
{
  auto p = problem();
  p.motion.emplace_back();
  const auto start = p.motion;
  ContactBlocks packed;
  packed.pack(p.contacts, p.motion, p.motion.size() - 1);
  for (int s = 0; s < 50; ++s) choose_sweep<2>({})(packed.runs(), p.motion.data(), p.friction);
  auto again = start;
  apply_impulses<2>(packed.blocks(), again.data(), {});
  for (std::size_t g = 0; g < start.size(); ++g) {
    EXPECT_NEAR(again[g].v[0], p.motion[g].v[0], 1e-13);
    EXPECT_NEAR(again[g].v[1], p.motion[g].v[1], 1e-13);
    EXPECT_NEAR(again[g].rim[0], p.motion[g].rim[0], 1e-13);
  }
}

TEST(ContactBlocks, NoMobileBodyAppearsTwiceInABlock)
{
  auto p = problem();
  p.motion.emplace_back();
  ContactBlocks packed;
  packed.pack(p.contacts, p.motion, p.motion.size() - 1);
  std::set<std::pair<std::size_t, std::int32_t>> seen;
  for (std::size_t k = 0; k < p.contacts.size(); ++k)
    for (const auto body : {p.contacts[k].i, p.contacts[k].j})
      if (p.motion[static_cast<std::size_t>(body)].inverse_mass > 0) {
        EXPECT_TRUE(seen.insert({packed.slots()[k] / block_lanes, body}).second);
      }
  EXPECT_LE(packed.blocks().size(), p.contacts.size() / block_lanes + 10);
}

TEST(InstructionSets, AnUnknownOneIsRefused)
{
  EXPECT_THROW(use_instruction_set("mmx"), std::runtime_error);
}

}  // namespace
}  // namespace grseg
