// SPDX-License-Identifier: GPL-3.0-or-later
#include "sim/contact/contact_law-inl.hpp"
#include "sim/neighbours/impulse_memory.hpp"
#include "sim/solver/sweep.hpp"
#include "sim/step/simulation.hpp"
#include "tests/hard_cases/case.hpp"
#include "tests/sim/worlds.hpp"

#include <gsl/gsl_rng.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <map>
#include <memory>
#include <numeric>
#include <set>

namespace grseg {
namespace {

namespace law = HWY_NAMESPACE;

struct Bed {
  World<2> world;
  std::vector<Vec2> position, velocity;
};

using Random = std::unique_ptr<gsl_rng, decltype(&gsl_rng_free)>;

Random random_numbers()
{
  return {gsl_rng_alloc(gsl_rng_mt19937), gsl_rng_free};
}

/// Discs of several sizes on a disordered lattice above a row of beads, in random motion; every
/// `flying`-th disc moves away fast.
Bed bed_of(double length, double height, bool periodic, std::size_t flying)
{
  const auto random = random_numbers();
  const auto between = [&](double low, double high) {
    return low + (high - low) * gsl_rng_uniform(random.get());
  };
  Bed bed;
  const auto add = [&](const Vec2& at, double radius, bool fixed, const Vec2& velocity) {
    worlds::add(bed.world, {at, radius, fixed});
    bed.position.push_back(at);
    bed.velocity.push_back(velocity);
  };
  for (double y = 1.1; y < height; y += 1.05)
    for (double x = 0.55; x + 0.5 < length; x += 1.05) {
      const double speed = flying > 0 && bed.position.size() % flying == 0 ? 300 : 3;
      add({x + between(-0.05, 0.05), y + between(-0.05, 0.05)}, between(0.3, 0.55), false,
          {between(-speed, speed), between(-speed, speed)});
    }
  for (double x = 0.5; x <= length - 0.5; x += 1) add({x, -0.5}, 0.5, true, {0, 0});
  bed.world.box = {length, 2 * height, periodic};
  if (!periodic) bed.world.walls = {worlds::floor_at(-2), {{0, 0}, {1, 0}}, {{length, 0}, {-1, 0}}};
  bed.world.material = {0.5, 0.25};
  bed.world.gravity = {3, -9.8};
  bed.world.step = 2e-3;
  bed.world.solver = {0.1, 100};
  return bed;
}

Simulation<2> simulation_of(const Bed& bed)
{
  Simulation<2> simulation(bed.world, bed.position);
  for (std::size_t g = 0; g < bed.velocity.size(); ++g)
    simulation.set_velocity(g, bed.velocity[g], 1);
  return simulation;
}

using Gaps = std::map<std::pair<int, int>, double>;

/// Gap between grain i and grain or wall j.
double gap_of(const World<2>& world, const std::vector<Vec2>& position, int i, int j)
{
  const auto a = static_cast<std::size_t>(i);
  const double radius = world.grains.radius[a];
  if (j < 0) {
    const auto& wall = world.walls[static_cast<std::size_t>(-j - 1)];
    return (position[a] - wall.point).dot(wall.normal) - radius;
  }
  const auto b = static_cast<std::size_t>(j);
  Vec2 apart = position[a] - position[b];
  const double length = world.box.length_x;
  if (world.box.periodic_x) apart.x() -= length * std::round(apart.x() / length);
  return apart.norm() - radius - world.grains.radius[b];
}

/// Gaps up to `limit` at `position`, of all pairs that are not too far apart along x; grains are
/// named as in a frame.
Gaps gaps_by_brute_force(const World<2>& world, const std::vector<Vec2>& position, double limit)
{
  Gaps gaps;
  const auto& grains = world.grains;
  const double reach = 2 * *std::max_element(grains.radius.begin(), grains.radius.end()) + limit;
  const double length = world.box.length_x;
  const auto fixed = [&](int g) { return grains.fixed[static_cast<std::size_t>(g)]; };
  const auto look_at = [&](int a, int b) {
    if (fixed(a) && fixed(b)) return;
    const bool a_first = fixed(a) ? false : fixed(b) || a < b;
    const double gap = gap_of(world, position, a, b);
    if (gap <= limit) gaps[{a_first ? a : b, a_first ? b : a}] = gap;
  };
  std::vector<std::pair<double, int>> along;
  for (int g = 0; g < static_cast<int>(position.size()); ++g) {
    const double x = position[static_cast<std::size_t>(g)].x();
    along.push_back({world.box.periodic_x ? x - length * std::floor(x / length) : x, g});
  }
  std::sort(along.begin(), along.end());
  if (world.box.periodic_x)  // once more, shifted by a period
    for (std::size_t n = 0; n < position.size() && along[n].first <= reach; ++n)
      along.push_back({along[n].first + length, along[n].second});
  for (std::size_t n = 0; n < along.size(); ++n)
    for (std::size_t m = n + 1; m < along.size(); ++m) {
      if (along[m].first - along[n].first > reach) break;
      if (along[m].second != along[n].second) look_at(along[n].second, along[m].second);
    }
  for (int g = 0; g < static_cast<int>(position.size()); ++g)
    for (int w = -static_cast<int>(world.walls.size()); w < 0; ++w)
      if (!fixed(g) && gap_of(world, position, g, w) <= limit)
        gaps[{g, w}] = gap_of(world, position, g, w);
  return gaps;
}

/// Runs the bed and compares the contacts of each frame with those found among all pairs.
void expect_all_contacts(const Bed& bed, int steps)
{
  auto simulation = simulation_of(bed);
  Frame<2> frame;
  std::size_t seen = 0;
  for (int step = 0; step < steps; ++step) {
    std::vector<Vec2> ahead;
    for (std::size_t g = 0; g < bed.position.size(); ++g)
      ahead.push_back(bed.world.law.forecast * bed.world.step * simulation.velocity(g));
    simulation.advance(frame);
    for (std::size_t g = 0; g < ahead.size(); ++g) ahead[g] += frame.position[g];
    const double blurred = 1e-12;  // positions are rounded when they are wrapped
    const double limit = simulation.world().law.margin;
    const auto certain = gaps_by_brute_force(bed.world, ahead, limit - blurred);
    const auto possible = gaps_by_brute_force(bed.world, ahead, limit + blurred);
    const auto& contacts = frame.contacts;
    Gaps found;
    for (std::size_t c = 0; c < contacts.size(); ++c)
      EXPECT_TRUE(found.insert({{contacts.i[c], contacts.j[c]}, contacts.gap[c]}).second);
    for (const auto& [names, gap] : certain)
      EXPECT_TRUE(found.count(names)) << names.first << ' ' << names.second << " step " << step;
    for (const auto& [names, gap] : found) {
      EXPECT_TRUE(possible.count(names)) << names.first << ' ' << names.second << " step " << step;
      EXPECT_NEAR(gap, gap_of(bed.world, frame.position, names.first, names.second), blurred);
    }
    seen += found.size();
    if (testing::Test::HasFailure()) return;
  }
  EXPECT_GT(seen, bed.position.size() / 2);
  EXPECT_GT(simulation.pair_list_renewals(), 2u);
  EXPECT_LT(simulation.pair_list_renewals(), static_cast<std::size_t>(steps));
}

TEST(Detection, FindsTheContactsOfAPeriodicBedUnderEveryForecast)
{
  for (const double forecast : {0.0, 0.5, 1.0}) {
    auto bed = bed_of(30, 10, true, 0);
    bed.world.law.forecast = forecast;
    expect_all_contacts(bed, 150);
  }
}

TEST(Detection, FindsTheContactsBetweenWalls)
{
  for (const double forecast : {0.0, 0.5}) {
    auto bed = bed_of(20, 10, false, 0);
    bed.world.law.forecast = forecast;
    expect_all_contacts(bed, 150);
  }
}

TEST(Detection, FindsPairsWithinAMargin)
{
  auto bed = bed_of(20, 10, false, 0);
  bed.world.law.margin = 0.1;
  expect_all_contacts(bed, 150);
}

TEST(Detection, FindsTheContactsInACellOfFewColumns)
{
  for (const double length : {3.2, 5.3}) expect_all_contacts(bed_of(length, 40, true, 0), 150);
}

TEST(Detection, FindsTheContactsOfGrainsThatFlyThroughEverything)
{
  auto bed = bed_of(20, 10, true, 40);
  bed.world.step = 2e-4;
  expect_all_contacts(bed, 200);
}

TEST(Detection, FindsTheContactsOfAGiantWithMoreNeighboursThanThereAreColours)
{
  Bed bed;
  const int ring = 150;
  const double radius = 20, small = std::sin(std::numbers::pi / ring) * radius * 1.01;
  worlds::add(bed.world, {{0, 0}, radius});
  bed.position.push_back({0, 0});
  for (int k = 0; k < ring; ++k) {
    const double angle = 2 * std::numbers::pi * k / ring;
    bed.position.push_back((radius + small * 1.02) * Vec2(std::cos(angle), std::sin(angle)));
    worlds::add(bed.world, {bed.position.back(), small});
  }
  bed.velocity.assign(bed.position.size(), Vec2::Zero());
  for (int k = 1; k <= ring; ++k)
    bed.velocity[static_cast<std::size_t>(k)] = -bed.position[static_cast<std::size_t>(k)] / 20;
  bed.world.box = {100, 100, false};
  bed.world.step = 1e-2;
  bed.world.skin = 0.02;
  bed.world.solver = {0.1, 100};
  expect_all_contacts(bed, 40);
}

// Tests with beds of more than one strip.

TEST(Detection, FindsTheContactsOfAWideBed)
{
  auto periodic = bed_of(4000, 9, true, 0), open = bed_of(6000, 9, false, 0);
  for (auto* bed : {&periodic, &open}) {
    ASSERT_GT(bed->position.size(), 30000u);
    bed->world.threads = 2;
    bed->world.step = 2e-2;
    bed->world.law.forecast = 0.5;
    expect_all_contacts(*bed, 8);
  }
}

std::vector<double> numbers_of_25_steps(Bed bed, int threads, Precision precision)
{
  bed.world.threads = threads;
  bed.world.solver.precision = precision;
  bed.world.skin = 0.3;  // so that the list is renewed
  auto simulation = simulation_of(bed);
  std::vector<double> all;
  for (int step = 0; step < 25; ++step) {
    const auto report = simulation.advance();
    all.insert(all.end(),
               {report.solver.residual, report.solver.residual_rms, report.sum_overlap,
                report.sum_gap_bearing, report.base_impulse.x(), report.base_impulse.y()});
  }
  EXPECT_GT(simulation.pair_list_renewals(), 1u);
  for (std::size_t g = 0; g < bed.position.size(); ++g)
    all.insert(all.end(), {simulation.position(g).x(), simulation.position(g).y(),
                           simulation.angular_velocity(g)});
  return all;
}

TEST(Detection, AnyNumberOfThreadsGivesTheSameBytes)
{
  auto bed = bed_of(4000, 12, true, 0);
  hard_cases::Case same("H38", "bits of 25 steps with 2 and 3 threads are those with one"),
      single("H38", "the same, with sweeps in single precision");
  const auto one = numbers_of_25_steps(bed, 1, Precision::doubles),
             one_single = numbers_of_25_steps(bed, 1, Precision::mixed);
  EXPECT_NE(one, one_single);
  for (const int threads : {2, 3}) {
    same.holds(numbers_of_25_steps(bed, threads, Precision::doubles) == one);
    single.holds(numbers_of_25_steps(bed, threads, Precision::mixed) == one_single);
  }
}

// --- Blocks, byte by byte ---

/// A pair list, the state for which it was sorted, and the request of the step.
struct Prepared {
  GrainState<2> state;
  PairList<2> list;
  std::vector<Wall<2>> walls;
  DetectionRule<2> rule;

  /// Grains are larger than in the bed; with 15 %, most touch.
  explicit Prepared(const Bed& bed, double growth = 1.15)
      : state(make_state<2>(bed.world.grains, bed.position)),
        list(bed.world.walls, bed.world.box, growth * 0.55, 0.3),
        walls(bed.world.walls)
  {
    for (std::size_t g = 0; g < bed.position.size(); ++g) {
      state.motion[g].v[0] = bed.velocity[g].x();
      state.motion[g].v[1] = bed.velocity[g].y();
      state.radius[g] *= growth;
    }
    list.renew(state, state.position);
    for (std::size_t k = 0; k < list.pairs().size(); ++k)
      if (list.pairs().listed(k)) {
        const double load = (k % 2 == 0 ? 0.01 : 1) * static_cast<double>(1 + k);
        list.pairs().memory[k] = {load, {0.5 - static_cast<double>(k % 7)}};
      }
    rule.ahead = rule.middle = state.position;
    rule.motion = state.motion;
    rule.walls = walls;
    rule.restitution = 0.25;
    rule.periodic = bed.world.box.periodic_x;
  }
};

using Bits = std::vector<std::uint64_t>;

void append(Bits& bits, double x)
{
  bits.push_back(std::bit_cast<std::uint64_t>(x));
}

Bits bits_of(const StripContacts<2>& contacts, const DetectionSums& sums)
{
  Bits bits{contacts.size, contacts.count, contacts.on_base, sums.touching};
  for (const double x : {sums.overlap, sums.largest_overlap, sums.fastest_approach})
    append(bits, x);
  for (std::size_t b = 0; b < contacts.size; ++b) {
    const auto& block = contacts.blocks[b];
    for (const auto* lanes :
         {&block.n[0], &block.n[1], &block.kappa, &block.mass_n, &block.mass_t, &block.rebound,
          &block.impulse_n, &block.impulse_t[0], &contacts.origins[b].gap})
      for (const double x : *lanes) append(bits, x);
    for (std::size_t lane = 0; lane < block_lanes; ++lane)
      for (const auto number : {block.i[lane], block.j[lane], contacts.origins[b].pair[lane]})
        bits.push_back(number);
  }
  return bits;
}

Bits found(Prepared& p)
{
  std::vector<StripContacts<2>> contacts;
  const auto sums = find_contacts(p.list.pairs(), p.rule, contacts);
  return bits_of(contacts.at(0), sums);
}

class DetectionOn : public testing::TestWithParam<std::string> {
 protected:
  void SetUp() override { use_instruction_set(GetParam()); }
  void TearDown() override { use_instruction_set(""); }
};

INSTANTIATE_TEST_SUITE_P(EveryInstructionSet, DetectionOn, testing::ValuesIn(instruction_sets()),
                         [](const auto& set) { return set.param; });

TEST_P(DetectionOn, GivesTheBytesOfTheBestInstructionSet)
{
  for (const bool periodic : {true, false}) {
    Prepared here(bed_of(20, 10, periodic, 0));
    const auto bits = found(here);
    use_instruction_set("");
    Prepared best(bed_of(20, 10, periodic, 0));
    EXPECT_EQ(bits, found(best));
    use_instruction_set(GetParam());
  }
}

/// A listed pair with the quantities of contact_law.hpp.
struct PairInWords {
  bool acts;
  double separation, gap, load, remembered;
  Contact<2> contact;
};

/// Computed in the law's own order of operations, so that bits can be compared.
PairInWords in_words(const Prepared& p, const PairClass& c, std::size_t k)
{
  const auto& pairs = p.list.pairs();
  const std::size_t i = pairs.i[k] / 2, j = pairs.j[k] / 2;
  const auto &a = p.state.motion[i], &b = p.state.motion[j];
  const double reach = pairs.geometry[k].reach, shift = pairs.geometry[k].shift;
  PairInWords pair{};
  law::Normal<2, double> n{};
  const auto along = [](const Vec2& x) { return std::array{x.x(), x.y()}; };
  if (c.wall < 0) {
    const auto apart = [&](std::span<const Vec2> x) {
      return Vec2(x[i].x() - x[j].x() + shift, x[i].y() - x[j].y());
    };
    const Vec2 then = apart(p.rule.ahead), now = apart(p.rule.middle);
    pair.acts = law::acts(along(then), reach, p.rule.margin);
    n = law::normal_of_grains(along(now), true);
    pair.contact.kappa = n.distance * (1 / reach);
  } else {
    const auto& wall = p.walls[static_cast<std::size_t>(c.wall)];
    const Vec2 then = p.rule.ahead[i] - wall.point, now = p.rule.middle[i] - wall.point;
    pair.acts = law::acts_on_wall(then.dot(wall.normal), reach, p.rule.margin);
    n = law::normal_of_wall(along(now), along(wall.normal));
    pair.contact.kappa = 1;
  }
  pair.gap = n.distance - reach;
  pair.separation = (a.v[0] - b.v[0]) * n.n[0] + (a.v[1] - b.v[1]) * n.n[1];
  pair.contact.n[0] = n.n[0];
  pair.contact.n[1] = n.n[1];
  pair.contact.mass_n = law::normal_mass(a.inverse_mass + b.inverse_mass, true);
  pair.contact.mass_t =
      law::tangential_mass(pair.contact.mass_n, pair.contact.kappa, rim_factor<2>);
  pair.contact.impulse_n = pairs.memory[k].n;
  pair.contact.impulse_t[0] = pairs.memory[k].t[0];
  pair.load = pairs.memory[k].n * (a.inverse_mass + b.inverse_mass);
  const auto rebound_of = p.rule.horizon > 0 ? law::rebound_of<true, true, double>
                                             : law::rebound_of<true, false, double>;
  const auto rebound = rebound_of(pair.gap, pair.separation, pair.load, pairs.memory[k].approach,
                                  p.rule.restitution, p.rule.horizon);
  pair.contact.rebound = rebound.velocity;
  pair.remembered = rebound.remembered;
  return pair;
}

Bits bits_of(const PairInWords& pair, bool with_memory)
{
  Bits bits;
  const auto& c = pair.contact;
  for (const double x : {c.n[0], c.n[1], c.kappa, c.mass_n, c.mass_t, c.rebound, c.impulse_n,
                         c.impulse_t[0], pair.gap, with_memory ? pair.remembered : 0})
    append(bits, x);
  return bits;
}

Bits bits_of(const StripContacts<2>& contacts, std::size_t block, std::size_t lane,
             bool with_memory)
{
  Bits bits;
  const auto& c = contacts.blocks[block];
  const auto& origin = contacts.origins[block];
  for (const auto* lanes : {&c.n[0], &c.n[1], &c.kappa, &c.mass_n, &c.mass_t, &c.rebound,
                            &c.impulse_n, &c.impulse_t[0], &origin.gap})
    append(bits, (*lanes)[lane]);
  append(bits, with_memory ? origin.approach[lane] : 0);
  return bits;
}

/// Number of pairs of each kind in a comparison.
struct Seen {
  std::size_t acting = 0, idle = 0, apart = 0, newcomers = 0, rebounding = 0;
  std::size_t pressed_rebounding = 0, pressed_stopped = 0;  // pairs under a load, and approaching
};

/// Compares the result of detection for a bed with the direct computation for every listed pair.
void expect_the_law_in_words(const Prepared& p, Seen& seen)
{
  const bool with_memory = p.rule.horizon > 0;
  std::vector<StripContacts<2>> strips;
  const auto sums = find_contacts(p.list.pairs(), p.rule, strips);
  const auto& contacts = strips.at(0);
  const auto& pairs = p.list.pairs();
  std::map<std::size_t, std::pair<std::size_t, std::size_t>> found;  // pair: block and lane
  for (std::size_t b = 0; b < contacts.size; ++b)
    for (std::size_t lane = 0; lane < block_lanes; ++lane) {
      const std::size_t k = contacts.origins[b].entry(lane);
      if (k == pairs.size()) continue;
      EXPECT_TRUE(found.insert({k, {b, lane}}).second);
    }
  std::size_t touching = 0;
  double overlap = 0, largest = 0, fastest = 0;
  for (const auto& c : pairs.classes)
    for (std::size_t k = c.begin; k < c.end; ++k) {
      if (!pairs.listed(k)) continue;
      const auto words = in_words(p, c, k);
      const auto at = found.find(k);
      EXPECT_EQ(at != found.end(), words.acts) << k;
      if (at == found.end()) {
        ++seen.idle;
        continue;
      }
      const auto [b, lane] = at->second;
      EXPECT_EQ(bits_of(contacts, b, lane, with_memory), bits_of(words, with_memory)) << k;
      EXPECT_EQ(contacts.blocks[b].i[lane], 2 * pairs.i[k]);
      EXPECT_EQ(contacts.blocks[b].j[lane], 2 * pairs.j[k]);
      EXPECT_EQ(b >= contacts.on_base, p.state.motion[pairs.j[k] / 2].inverse_mass == 0);
      ++seen.acting;
      seen.apart += words.gap > 0;
      seen.newcomers += words.remembered > 0;
      seen.rebounding += words.gap > 0 && words.contact.rebound > 0;
      const bool pressed = words.load > 0 && words.gap <= 0 && words.separation < 0;
      seen.pressed_rebounding += pressed && words.contact.rebound > 0;
      seen.pressed_stopped += pressed && words.contact.rebound == 0;
      touching += words.gap <= 0;
      overlap += std::max(-words.gap, 0.0);
      largest = std::max(largest, -words.gap);
      fastest = std::max(fastest, -words.separation);
    }
  EXPECT_EQ(contacts.count, found.size());
  EXPECT_EQ(sums.touching, touching);
  EXPECT_NEAR(sums.overlap, overlap, 1e-12);
  EXPECT_EQ(sums.largest_overlap, largest);
  EXPECT_EQ(sums.fastest_approach, fastest);
}

TEST_P(DetectionOn, ContactsAreThoseOfTheLawInWordsToTheLastBit)
{
  Seen seen;
  for (const bool periodic : {true, false})
    expect_the_law_in_words(Prepared(bed_of(20, 10, periodic, 0)), seen);
  EXPECT_GT(seen.acting, 100u);
  EXPECT_GT(seen.idle, 100u);
  EXPECT_GT(seen.pressed_rebounding, 20u);
  EXPECT_GT(seen.pressed_stopped, 20u);
}

TEST_P(DetectionOn, PairsStillApartAreSlowedDownAsTheLawInWordsSaysToTheLastBit)
{
  Seen seen;
  for (const bool periodic : {true, false}) {
    Prepared p(bed_of(80, 10, periodic, 0), 1);
    p.rule.horizon = 0.02;
    p.rule.margin = 0.05;
    std::vector<Vec2> then(p.state.position);
    for (std::size_t b = 0; b < then.size(); ++b)
      then[b] += p.rule.horizon * Vec2(p.state.motion[b].v[0], p.state.motion[b].v[1]);
    p.rule.ahead = then;
    // New pairs, pairs that were slowed down in the step before, and pairs that have had a load for long.
    for (std::size_t k = 0; k < p.list.pairs().size(); ++k) {
      if (k % 3 != 2) p.list.pairs().memory[k] = {};
      if (k % 3 == 1) p.list.pairs().memory[k].approach = 0.1 * static_cast<double>(k % 7);
    }
    expect_the_law_in_words(p, seen);
  }
  EXPECT_GT(seen.apart, 50u);
  EXPECT_GT(seen.newcomers, 5u);
  EXPECT_GT(seen.rebounding, 5u);
}

TEST_P(DetectionOn, AnEffectLeftOutEqualsItsNeutralCoefficientToTheLastBit)
{
  Prepared general(bed_of(20, 10, false, 0)), lean = general;
  lean.rule.ahead = lean.rule.middle = lean.state.position;
  general.rule.restitution = 0;
  general.rule.rim_factor = 0;
  general.rule.periodic = true;
  for (const bool rotation : {true, false})
    for (const bool restitution : {true, false}) {
      lean.rule.restitution = 0;
      lean.rule.rim_factor = 0;
      lean.rule.effects.rotation = rotation;
      lean.rule.effects.restitution = restitution;
      lean.rule.periodic = false;
      EXPECT_EQ(found(general), found(lean));
    }
}

TEST_P(DetectionOn, ImpulsesGoBackToTheirPairsAndAreForgottenWithTheContact)
{
  Prepared p(bed_of(20, 10, false, 0));
  std::vector<StripContacts<2>> strips;
  find_contacts(p.list.pairs(), p.rule, strips);
  auto& contacts = strips.at(0);
  double n = 0, gap = 0;
  Vec2 base = Vec2::Zero();
  std::size_t bearing = 0;
  for (std::size_t b = 0; b < contacts.size; ++b) {
    auto& block = contacts.blocks[b];
    for (std::size_t lane = 0; lane < block_lanes; ++lane) {
      if (contacts.origins[b].entry(lane) == p.list.pairs().size()) continue;
      n = static_cast<double>((b + lane) % 3);
      block.impulse_n[lane] = n;
      block.impulse_t[0][lane] = -n / 2;
      bearing += n > 0;
      gap += n > 0 ? std::abs(contacts.origins[b].gap[lane]) : 0;
      if (b < contacts.on_base) continue;
      const Vec2 normal{block.n[0][lane], block.n[1][lane]}, tangent{-normal.y(), normal.x()};
      base += n * normal - n / 2 * tangent;
    }
  }
  const auto sums = keep_impulses<2>(strips, p.list.pairs());
  EXPECT_EQ(sums.force_bearing, bearing);
  EXPECT_NEAR(sums.gap_bearing, gap, 1e-12);
  EXPECT_NEAR((sums.on_base_side - base).norm(), 0, 1e-12);
  const auto kept = contacts.used({}).blocks;
  for (std::size_t b = 0; b < kept.size(); ++b)
    for (std::size_t lane = 0; lane < block_lanes; ++lane) {
      const auto& impulse = p.list.pairs().memory[contacts.origins[b].entry(lane)];
      EXPECT_EQ(impulse.n, kept[b].impulse_n[lane]);
      EXPECT_EQ(impulse.t[0], kept[b].impulse_t[0][lane]);
    }
  // Pairs must now overlap to act: fewer do, and only these keep their impulses.
  const auto before = contacts.origins;
  const auto size = contacts.size;
  p.rule.margin = -0.02;
  find_contacts(p.list.pairs(), p.rule, strips);
  std::set<std::uint32_t> acting;
  for (std::size_t b = 0; b < contacts.size; ++b)
    acting.insert(contacts.origins[b].pair.begin(), contacts.origins[b].pair.end());
  const auto had = p.list.pairs().memory;
  forget_impulses<2>(strips, p.list.pairs());
  std::size_t gone = 0;
  for (std::size_t b = 0; b < size; ++b)
    for (const auto pair : before[b].pair) {
      const auto& impulse = p.list.pairs().memory[pair / 4];
      EXPECT_EQ(impulse.n, acting.contains(pair) ? had[pair / 4].n : 0);
      EXPECT_EQ(impulse.t[0], acting.contains(pair) ? had[pair / 4].t[0] : 0);
      gone += acting.contains(pair) ? 0 : 1;
    }
  EXPECT_GT(gone, size);
  EXPECT_GT(acting.size(), size);
}

}  // namespace
}  // namespace grseg
