// SPDX-License-Identifier: GPL-3.0-or-later
#include "sim/solver/sweep.hpp"
#include "tests/frozen_problem.hpp"
#include "tests/instructions.hpp"
#include "tests/sim/contact_list.hpp"
#include "tests/sim/small_chute.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <functional>
#include <limits>

/// Effects that a scene does not need cost nothing: instructions are counted, not timed, and numbers that
/// only an effect needs are not even read. effects_test.cpp shows that results do not change in any bit.
namespace grseg {
namespace {

// Numbers of additions, subtractions and multiplications in relax() in sim/contact/contact_law-inl.hpp, and
// in the sums over its changes, that are behind `if constexpr`. Floating-point rules forbid a compiler to
// leave one out or, without contraction, to merge two, so the bounds are valid for every compiler.
// Compilers move numbers differently: moves are not counted.
constexpr long of_friction = 17, of_rotation = 12, of_restitution = 1;

/// Instructions of the sweep for two further blocks of eight contacts.
Instructions of_two_blocks(Effects effects)
{
  const auto sweep = choose_sweep<2>(effects);
  const auto count = [&](std::size_t blocks) {
    std::vector<ContactBlock<2>> all(blocks, ContactBlock<2>{});
    const std::vector<std::uint32_t> ends{static_cast<std::uint32_t>(blocks)};
    std::vector<Motion<2>> idle(1);
    return instructions_of([&] { sweep({all, ends}, idle.data(), 0.5); }).value();
  };
  const auto three = count(3), one = count(1);
  return {three.all - one.all, three.arithmetic - one.arithmetic};
}

/// Smallest number of vectors that make up a block. Without vector instructions a compiler may
/// still pair numbers.
long parts_of_a_block(const std::string& instruction_set)
{
  if (instruction_set == "avx512") return 1;
  return instruction_set == "avx2" ? 2 : 4;
}

bool may_count()
{
  return instructions_of([] {}).has_value();
}

class OnEachInstructionSet : public testing::TestWithParam<std::string> {
 protected:
  void SetUp() override
  {
    if (!may_count()) GTEST_SKIP() << "no process may trace another here";
    use_instruction_set(GetParam());
  }
  void TearDown() override { use_instruction_set(""); }
};
using LeftOut = OnEachInstructionSet;

TEST_P(LeftOut, AnEffectLeftOutTakesAllItsArithmeticOutOfASweep)
{
  const long parts = 2 * parts_of_a_block(GetParam());
  const long all = of_two_blocks({true, true, true}).arithmetic,
             inelastic = of_two_blocks({true, true, false}).arithmetic,
             unturned = of_two_blocks({true, false, true}).arithmetic,
             smooth = of_two_blocks({false, true, true}).arithmetic,
             bare = of_two_blocks({false, false, false}).arithmetic;
  EXPECT_GE(all - inelastic, parts * of_restitution);
  EXPECT_GE(all - unturned, parts * of_rotation);
  EXPECT_GE(all - smooth, parts * (of_friction + of_rotation));
  EXPECT_GE(all - bare, parts * (of_friction + of_rotation + of_restitution));
  RecordProperty("arithmetic of two blocks: all; without restitution; rotation; friction; any",
                 fmt::format("{} {} {} {} {}", all, inelastic, unturned, smooth, bare));
}

TEST_P(LeftOut, WithoutFrictionRotationCostsNothing)
{
  EXPECT_EQ(of_two_blocks({false, true, true}).all, of_two_blocks({false, false, true}).all);
  EXPECT_EQ(of_two_blocks({false, true, false}).all, of_two_blocks({false, false, false}).all);
}

std::string plain(const testing::TestParamInfo<std::string>& set)
{
  return set.param;
}
INSTANTIATE_TEST_SUITE_P(InstructionSets, LeftOut, testing::ValuesIn(instruction_sets()), plain);

constexpr double poison = std::numeric_limits<double>::quiet_NaN();

using Bits = std::vector<std::uint64_t>;

void add_bits(Bits& bits, double x)
{
  bits.push_back(std::bit_cast<std::uint64_t>(x));
}

/// Velocities and normal impulses after three sweeps over the frozen problem, after `spoil` has
/// changed its blocks and bodies.
Bits swept(Effects effects, const std::function<void(ContactBlock<2>&)>& spoil_block,
           const std::function<void(Motion<2>&)>& spoil_body)
{
  auto problem = read_frozen_problem(GRSEG_TEST_INPUTS "/chute-contact-problem.txt");
  problem.motion.emplace_back();
  ContactBlocks packed;
  packed.pack(problem.contacts, problem.motion, problem.motion.size() - 1);
  for (auto& block : packed.blocks()) spoil_block(block);
  for (auto& body : problem.motion) spoil_body(body);
  Bits bits;
  for (int k = 0; k < 3; ++k) {
    const auto found =
        choose_sweep<2>(effects)(packed.runs(), problem.motion.data(), problem.friction);
    for (const double x : {found.largest, found.sum_squares, found.sum_reference})
      add_bits(bits, x);
  }
  apply_impulses<2>(packed.blocks(), problem.motion.data(), effects);
  for (const auto& block : packed.blocks())
    for (const double n : block.impulse_n) add_bits(bits, n);
  for (const auto& m : problem.motion)
    for (const double v : {m.v[0], m.v[1]}) add_bits(bits, v);
  return bits;
}

TEST(NotEvenRead, IsWhatFrictionRotationAndRestitutionNeedInSweepsWithoutThem)
{
  const auto whole_block = [](ContactBlock<2>&) {};
  const auto whole_body = [](Motion<2>&) {};
  const auto of_friction = [](ContactBlock<2>& b) {
    for (auto* lanes : {&b.kappa, &b.mass_t, &b.impulse_t[0]}) lanes->fill(poison);
  };
  const auto of_restitution = [](ContactBlock<2>& b) { b.rebound.fill(poison); };
  const auto of_rotation = [](Motion<2>& m) { m.rim[0] = poison; };
  for (const auto& set : instruction_sets()) {
    use_instruction_set(set);
    const Effects smooth{false, true, true}, unturned{true, false, true},
        inelastic{true, true, false}, all{};
    EXPECT_EQ(swept(smooth, of_friction, of_rotation), swept(smooth, whole_block, whole_body));
    EXPECT_EQ(swept(unturned, whole_block, of_rotation), swept(unturned, whole_block, whole_body));
    EXPECT_EQ(swept(inelastic, of_restitution, whole_body),
              swept(inelastic, whole_block, whole_body));
    EXPECT_NE(swept(all, of_friction, whole_body), swept(all, whole_block, whole_body));
    EXPECT_NE(swept(all, whole_block, of_rotation), swept(all, whole_block, whole_body));
    EXPECT_NE(swept(all, of_restitution, whole_body), swept(all, whole_block, whole_body));
  }
  use_instruction_set("");
}

/// Normals of the contacts in the small chute's bed, found with or without spoilt shifts.
Bits found_in_a_bed(bool periodic, bool spoilt)
{
  const auto bed = small_chute::bed(small_chute::scene());
  const auto& world = bed.world();
  std::vector<Vec2> position;
  for (std::size_t g = 0; g < world.grains.size(); ++g) position.push_back(bed.position(g));
  auto state = make_state<2>(world.grains, position);
  PairList<2> list({}, {world.box.length_x, world.box.length_y, false}, 0.006, world.skin,
                   world.law.margin, 1);
  list.renew(state, state.position);
  auto pairs = list.pairs();
  if (spoilt)
    for (auto& geometry : pairs.geometry) geometry.shift = poison;
  DetectionRule<2> rule;
  rule.ahead = rule.middle = state.position;
  rule.motion = state.motion;
  rule.margin = world.law.margin;
  rule.periodic = periodic;
  std::vector<StripContacts<2>> contacts;
  find_contacts(pairs, rule, contacts);
  Bits bits;
  for (const auto& strip : contacts)
    for (std::size_t b = 0; b < strip.size; ++b)
      for (const auto* lanes : {&strip.blocks[b].n[0], &strip.blocks[b].n[1]})
        for (const double x : *lanes) add_bits(bits, x);
  return bits;
}

TEST(NotEvenRead, IsThePeriodWhereACellHasEnds)
{
  for (const auto& set : instruction_sets()) {
    use_instruction_set(set);
    const auto found = found_in_a_bed(false, false);
    EXPECT_GT(found.size(), 100u);
    EXPECT_EQ(found_in_a_bed(false, true), found);
    EXPECT_EQ(found_in_a_bed(true, false), found);
    EXPECT_NE(found_in_a_bed(true, true), found);
  }
  use_instruction_set("");
}

using Change = std::function<void(World<2>&)>;

/// The small chute in motion between walls, one sweep per step, with changed conditions.
Simulation<2> chute_with(const Change& change)
{
  static const auto start = [] {
    auto bed = small_chute::bed(small_chute::scene(
        {"--lateral", "walls", "--contact-law", "centred", "--depth", "10dS", "--length", "8dL"}));
    for (int k = 0; k < 300; ++k) bed.advance();
    return bed;
  }();
  auto world = start.world();
  world.solver = {1e300, 1};
  change(world);
  std::vector<Vec2> position;
  for (std::size_t g = 0; g < world.grains.size(); ++g) position.push_back(start.position(g));
  Simulation<2> simulation(world, position);
  for (std::size_t g = 0; g < position.size(); ++g) simulation.set_velocity(g, start.velocity(g));
  // The first step makes the list, the second one allocates all remaining memory.
  for (int k = 0; k < 2; ++k) simulation.advance();
  return simulation;
}

Instructions step_of(Simulation<2> simulation)
{
  return instructions_of([&] { simulation.advance(); }).value();
}

class LeftOutOfAStep : public testing::Test {
 protected:
  void SetUp() override
  {
    if (!may_count()) GTEST_SKIP() << "no process may trace another here";
  }
};

/// Lower bound of the number of blocks of eight contacts in a step.
long blocks_of_a_step(const Change& change)
{
  auto simulation = chute_with(change);
  Frame<2> frame;
  simulation.advance(frame);
  return static_cast<long>(frame.contacts.size() / block_lanes);
}

TEST_F(LeftOutOfAStep, FrictionAndRestitutionLeaveNothingWhereTheirCoefficientIsZero)
{
  // Compared with coefficients so small that they have no effect but must be computed.
  const auto rough = [](double friction) -> Change {
    return [friction](World<2>& w) { w.material.friction = friction; };
  };
  const auto rebounding = [](double e) -> Change {
    return [e](World<2>& w) { w.material.restitution = e; };
  };
  const long blocks = blocks_of_a_step(rough(0));
  ASSERT_GT(blocks, 1);
  const auto arithmetic = [](const Change& change) {
    return step_of(chute_with(change)).arithmetic;
  };
  EXPECT_GE(arithmetic(rough(1e-300)) - arithmetic(rough(0)), (of_friction + of_rotation) * blocks);
  EXPECT_GE(arithmetic(rebounding(1e-300)) - arithmetic(rebounding(0)), of_restitution * blocks);
}

TEST_F(LeftOutOfAStep, GravityAndBodiesThatMoveLeaveNothingForAnyGrainWhereThereAreNone)
{
  const Change weightless = [](World<2>& w) { w.gravity = Vec2::Zero(); };
  const Change faint = [](World<2>& w) { w.gravity = {1e-200, -1e-200}; };
  const auto grains = static_cast<long>(chute_with(weightless).world().grains.size());
  EXPECT_GE(step_of(chute_with(faint)).all - step_of(chute_with(weightless)).all, grains);

  long fixed = 0;
  const Change still = [&](World<2>& w) {
    BoundaryBody base;
    base.end = static_cast<std::uint32_t>(w.grains.size());
    while (w.grains.fixed[base.end - 1 - static_cast<std::size_t>(fixed)]) ++fixed;
    base.begin = base.end - static_cast<std::uint32_t>(fixed);
    w.bodies = {base};
  };
  const long with = step_of(chute_with(still)).all;
  EXPECT_GE(with - step_of(chute_with([](World<2>&) {})).all, fixed);
  EXPECT_GT(fixed, 3);
}

TEST_F(LeftOutOfAStep, AStepWithoutAFrameSpendsNothingOnRecording)
{
  const Change nothing = [](World<2>&) {};
  auto simulation = chute_with(nothing);
  Frame<2> frame;
  auto recorded = simulation;
  const long with = instructions_of([&] { recorded.advance(frame); }).value().all;
  EXPECT_GE(with - step_of(simulation).all,
            10 * static_cast<long>(simulation.world().grains.size()));
}

}  // namespace
}  // namespace grseg
