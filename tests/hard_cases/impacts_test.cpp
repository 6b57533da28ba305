// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/hard_cases/case.hpp"
#include "tests/hard_cases/laws.hpp"
#include "tests/hard_cases/observed.hpp"

#include <gtest/gtest.h>

#include <cmath>

/// Impacts without gravity: two discs, a disc on something fixed, a row of touching discs.
namespace grseg::hard_cases {
namespace {

using worlds::Disc;
using worlds::floor_at;
using worlds::positions_of;

using Impact = UnderEveryLaw;
INSTANTIATE_TEST_SUITE_P(Laws, Impact, testing::ValuesIn(laws()), name_of);

constexpr double restitutions[] = {0, 0.25, 0.5, 1};

/// Velocities before and after the first step in which discs touch.
struct Encounter {
  SeenContact contact;
  Velocities before, after;
  double lost;  // loss of kinetic energy, J

  Vec2 u_before() const { return contact.relative(before); }
  Vec2 u_after() const { return contact.relative(after); }
};

Encounter encounter(Simulation<2> simulation)
{
  Frame<2> frame;
  for (;;) {
    const Velocities before(simulation);
    const double energy = kinetic_energy(simulation);
    simulation.advance(frame);
    if (frame.contacts.size() > 0)
      return {SeenContact(simulation.world(), frame.contacts, 0), before, Velocities(simulation),
              energy - kinetic_energy(simulation)};
    if (simulation.steps_done() > 1000) throw std::runtime_error("nothing has touched");
  }
}

/// Two discs of masses 1 and `mass` that approach at 3 m/s along x and touch `steps` steps later.
/// Across x their centres are `offset` times the sum of radii apart.
Simulation<2> two_discs(World<2> world, double mass, double offset, double steps)
{
  const double reach = 0.75, way = std::sqrt(1 - offset * offset) * reach;
  world.grains.mass = {1, mass};
  Simulation<2> simulation(world, {{0, 0}, {way + 3 * steps * world.step, offset * reach}});
  simulation.set_velocity(0, {1, 0}, 2);
  simulation.set_velocity(1, {-2, 0}, -5);
  return simulation;
}

const std::vector<Disc> pair_of_discs{{{0, 0}, 0.5}, {{2, 0}, 0.25}};

TEST_P(Impact, TwoDiscsReboundWithRestitutionEAtEveryPhaseOfTheStep)
{
  // Impacts head-on and oblique, of rough and spinning discs.
  Case rebound("H2", "separation over approach, less e"), momentum("H2", "relative error of p_n");
  for (const double mass : {1.0, 4.0, 1e-2, 1e6})
    for (const double e : restitutions)
      for (const double offset : {0.0, 0.6})
        for (int phase = 0; phase < 1000; ++phase) {
          auto world = world_of(pair_of_discs);
          world.material.restitution = e;
          const auto hit = encounter(two_discs(world, mass, offset, 1 + phase / 1000.0));
          const double approach = -hit.contact.n.dot(hit.u_before());
          const double separation = hit.contact.n.dot(hit.u_after());
          const double impulse = (1 + e) * approach / (1 + 1 / mass);
          rebound.at_most(std::abs(separation / approach - e), 1e-14);
          momentum.at_most(std::abs(hit.contact.n.dot(hit.contact.impulse) / impulse - 1), 1e-14);
        }
}

using EarlyImpact = UnderEveryLaw;
INSTANTIATE_TEST_SUITE_P(Laws, EarlyImpact, testing::ValuesIn(early_laws()), name_of);

TEST_P(EarlyImpact, TwoDiscsReboundHeadOnWithRestitutionEAtEveryPhaseOfTheStep)
{
  double largest_error = 0, largest_overlap = 0;
  Frame<2> frame;
  for (const double mass : {1.0, 1e-2, 1e6})
    for (const double e : restitutions)
      for (int phase = 0; phase < 1000; ++phase) {
        auto world = world_of(pair_of_discs);
        world.material = {0, e};  // friction would rotate the line of centres between two steps
        auto simulation = two_discs(world, mass, 0, 1 + phase / 1000.0);
        for (int step = 0; step < 6; ++step)
          largest_overlap = std::max(largest_overlap, simulation.advance(frame).largest_overlap);
        const double separation = simulation.velocity(1).x() - simulation.velocity(0).x();
        largest_error = std::max(largest_error, std::abs(separation / 3 - e));
      }
  EXPECT_LT(largest_error, 1e-12);
  const double unforeseen = 1 - world_of(pair_of_discs).law.forecast;  // steps
  EXPECT_LT(largest_overlap, (3.0001 * unforeseen + 1e-9) * 1e-3);
}

TEST_P(Impact, ASmoothImpactLosesOneMinusESquaredOfItsNormalEnergy)
{
  Case loss("H39", "energy lost in a smooth impact, (1 - e²) m_eff u_n²/2, J");
  for (const double mass : {1.0, 4.0, 1e-2})
    for (const double e : restitutions)
      for (const double offset : {0.0, 0.6}) {
        auto world = world_of(pair_of_discs);
        world.material = {0, e};
        const auto hit = encounter(two_discs(world, mass, offset, 1.3));
        const double approach = hit.contact.n.dot(hit.u_before());
        loss.near(hit.lost, (1 - e * e) / 2 / (1 + 1 / mass) * approach * approach, 1e-14);
      }
}

/// Checks a disc of velocity -n + slip t and rim speed `spin` that hits something fixed whose
/// surface at `target` has the normal n. It sticks iff |u_t| <= (1 + 2 kappa^2) mu (1 + e) |u_n|,
/// which is 3 mu (1 + e) |u_n| at a wall. Returns true if it stuck.
bool check_oblique_impact(const World<2>& world, const Vec2& target, const Vec2& n, double slip,
                          double spin, Case& tangential, Case& spinning)
{
  const Vec2 t{-n.y(), n.x()}, velocity = slip * t - n;
  Simulation<2> simulation(world, {target + 0.5 * n - 1.7 * world.step * velocity, {0, 0}});
  simulation.set_velocity(0, velocity, spin / world.grains.radius[0]);
  const auto hit = encounter(simulation);
  const auto& c = hit.contact;
  const double u_n = c.n.dot(hit.u_before()), u_t = c.t.dot(hit.u_before());
  const double share = 1 + 2 * c.kappa * c.kappa;
  const double most = world.material.friction * (1 + world.material.restitution) * std::abs(u_n);
  const bool sticks = std::abs(u_t) <= share * most;
  const double push = sticks ? -u_t / share : std::copysign(most, -u_t);  // impulse / mass
  tangential.near(c.t.dot(hit.after.velocity[0]), c.t.dot(hit.before.velocity[0]) + push, 1e-13);
  spinning.near(hit.after.rim_speed[0], hit.before.rim_speed[0] - 2 * c.kappa * push, 1e-13);
  EXPECT_NEAR(c.n.dot(hit.u_after()), -world.material.restitution * u_n, 1e-13);
  return sticks;
}

TEST_P(Impact, AnObliqueImpactSticksInsideTheConeAndSlidesOutside)
{
  // Impacts on a floor and on a fixed disc, with and without spin, sliding to either side.
  const double mu = 0.3;
  Case tangential("H3", "v_t after the impact, m/s"), spinning("H3", "rω after the impact, m/s");
  for (const double e : restitutions)
    for (const double spin : {0.0, 0.7, -2.0})
      for (const double part : {-4.0, -1.02, -0.98, -0.1, 0.1, 0.98, 1.02, 4.0}) {
        const double slip = part * 3 * mu * (1 + e) + spin;  // u_t = slip - spin
        auto floor = world_of({{{0, 0}, 0.5}, {{0, 0}, 0.25, true}});
        floor.material = {mu, e};
        auto disc = floor;
        floor.walls = {floor_at(5)};
        const Vec2 n{0.6, 0.8};
        const auto sticks = [&](const World<2>& world, const Vec2& target, const Vec2& normal) {
          return check_oblique_impact(world, target, normal, slip, spin, tangential, spinning);
        };
        EXPECT_EQ(sticks(floor, {0, 5}, {0, 1}), std::abs(part) < 1);
        EXPECT_EQ(sticks(disc, 0.25 * n, n), std::abs(part) < 1);
      }
}

/// A row of touching discs along x, one step after they were given these speeds.
Simulation<2> row_after_a_step(const World<2>& world, const std::vector<Disc>& discs,
                               const std::vector<double>& speeds)
{
  Simulation<2> row(world, positions_of(discs));
  for (std::size_t k = 0; k < speeds.size(); ++k) row.set_velocity(k, {speeds[k], 0});
  EXPECT_TRUE(row.advance().solver.converged);
  return row;
}

std::vector<Disc> row_of(std::size_t count)
{
  std::vector<Disc> discs;
  for (std::size_t k = 0; k < count; ++k) discs.push_back({{static_cast<double>(k), 0}, 0.5});
  return discs;
}

TEST_P(Impact, AHitRowOfTouchingDiscsSharesTheImpulseEqually)
{
  // Newton's law for simultaneous impacts, not Newton's cradle: contacts that do not approach do
  // not rebound, so all discs but the first move as one.
  const double v = 2;
  Case first("H7", "v₁, ((1 + e)/N − e) v, m/s"), others("H7", "all other speeds, m/s"),
      energy("H7", "energy kept, (1 + e²(N − 1))/N");
  for (const std::size_t count : {2u, 3u, 5u, 10u})
    for (const double e : restitutions) {
      const auto discs = row_of(count);
      auto world = world_of(discs);
      world.material.restitution = e;
      std::vector<double> speeds(count, 0.0);
      speeds[0] = v;
      const auto row = row_after_a_step(world, discs, speeds);
      const double n = static_cast<double>(count);
      first.near(row.velocity(0).x(), ((1 + e) / n - e) * v, 1e-9);
      for (std::size_t k = 1; k < count; ++k)
        others.near(row.velocity(k).x(), (1 + e) / n * v, 1e-9);
      const double before = world.grains.mass[0] * v * v / 2;
      energy.near(kinetic_energy(row) / before, (1 + e * e * (n - 1)) / n, 1e-9);
    }
}

TEST_P(Impact, AnElasticRowWithGapsWiderThanAStepHandsTheSpeedToItsLastDisc)
{
  Case last("H8", "speed of the last disc, m/s"), rest("H8", "all other speeds, m/s");
  const double v = 2;
  for (const double gap : {0.0041, 0.1}) {  // v h = 0.002
    auto discs = row_of(6);
    for (std::size_t k = 0; k < discs.size(); ++k)
      discs[k].position.x() += gap * static_cast<double>(k);
    auto world = world_of(discs);
    world.material.restitution = 1;
    Simulation<2> row(world, positions_of(discs));
    row.set_velocity(0, {v, 0});
    for (int step = 0; step < 400; ++step) row.advance();
    last.near(row.velocity(5).x(), v, 1e-13);
    for (std::size_t k = 0; k < 5; ++k) rest.near(row.velocity(k).x(), 0, 1e-13);
  }
}

TEST_P(Impact, ThreeInelasticDiscsCollapseAtFiniteCost)
{
  // With e < 7 - 4 sqrt 3 = 0.0718, discs that collide one after the other would touch infinitely
  // often before they stop. Once the time between two touches is shorter than a step, both contacts
  // act in one step, and each leaves e times its approach. So approaches end within a few steps,
  // and the discs part with at most e times the speed of their meeting.
  Case sweeps("H29", "most sweeps of a step"), parting("H29", "largest speed of parting, m/s");
  for (const double e : {0.0, 0.01, 0.05, 0.07})
    for (const double left : {0.3, 0.7, 1.0}) {
      auto discs = row_of(3);
      discs[0].position.x() -= 0.1;
      discs[2].position.x() += 0.05;
      auto world = world_of(discs);
      world.material = {0, e};
      world.solver = {1e-2, 500};
      Simulation<2> row(world, positions_of(discs));
      row.set_velocity(0, {left, 0});
      row.set_velocity(2, {-1, 0});
      for (int step = 0; step < 5000; ++step) sweeps.at_most(row.advance().solver.sweeps, 499);
      parting.at_most((row.velocity(2) - row.velocity(0)).norm(), (e + 1e-5) * (1 + left));
      EXPECT_NEAR(row.velocity(0).x() + row.velocity(1).x() + row.velocity(2).x(), left - 1, 1e-12);
    }
}

TEST_P(Impact, LoadsThatFadeNeedNoMoreSweepsThanRoundOffAllows)
{
  // The same collapse at the tightest tolerance. Changes relative to loads that go to 0 do not
  // become small, so sweeps end when changes are in the last digits of the velocities. Three
  // contacts halve the remaining error with every sweep or two at least: 64 sweeps are enough.
  Case sweeps("H29", "most sweeps of a step at a tolerance of 1e-12");
  for (const double e : {0.0, 0.05}) {
    auto discs = row_of(3);
    discs[0].position.x() -= 0.1;
    discs[2].position.x() += 0.05;
    auto world = world_of(discs);
    world.material = {0, e};
    world.solver = {1e-12, 500};
    Simulation<2> row(world, positions_of(discs));
    row.set_velocity(0, {0.7, 0});
    row.set_velocity(2, {-1, 0});
    for (int step = 0; step < 5000; ++step) {
      const auto report = row.advance().solver;
      sweeps.at_most(report.sweeps, 64);
      ASSERT_TRUE(report.converged);
    }
  }
}

TEST_P(Impact, SimultaneousElasticImpactsKeepTheirEnergy)
{
  // u = (-3, 1) becomes (3, -1): velocities (3, 0, 1) become (-1, 8, 5)/3. If the second pair, which
  // was parting, stayed in contact, they would be (-2, 7, 7)/3, with 17/3 for half the squares
  // instead of 5. The last disc overlaps by its way in a step, so that its contact acts.
  auto discs = row_of(3);
  discs[2].position.x() -= 1e-3;
  auto world = world_of(discs);
  world.material.restitution = 1;
  const auto row = row_after_a_step(world, discs, {3, 0, 1});
  Case("H39", "Σv²/2 after (3, 0, 1) at e = 1, before it was 5")
      .near(kinetic_energy(row) / world.grains.mass[0], 5, 1e-11);
  EXPECT_NEAR(row.velocity(0).x(), -1.0 / 3, 1e-11);
  EXPECT_NEAR(row.velocity(1).x(), 8.0 / 3, 1e-11);
  EXPECT_NEAR(row.velocity(2).x(), 5.0 / 3, 1e-11);
}

using ImpactAtOnce = UnderEveryLaw;
INSTANTIATE_TEST_SUITE_P(Laws, ImpactAtOnce, testing::ValuesIn(laws()), name_of);
INSTANTIATE_TEST_SUITE_P(EarlyLaws, ImpactAtOnce, testing::ValuesIn(early_laws()), name_of);

TEST_P(ImpactAtOnce, AStepOfManySmoothContactsLosesOneMinusEOverOnePlusEOfHalfPWp)
{
  // u' = u + W p and p (u' + e u) = 0, with one e, give p.(u + u')/2 = -(1 - e)/(1 + e) p.W p/2, and
  // p.W p is the sum of m |v' - v|^2. Pairs part and approach at random.
  Case lost("G19", "energy of a step of many contacts, J, from (1 - e)/(1 + e) pWp/2");
  std::vector<Disc> discs;
  for (int row = 0; row < 5; ++row)
    for (int k = 0; k < 5; ++k)
      discs.push_back({{0.98 * (k + 0.5 * (row % 2)), 0.98 * std::sqrt(0.75) * row}, 0.5});
  for (const double e : restitutions) {
    auto world = world_of(discs);
    world.material = {0, e};
    world.solver = {1e-13, 20000};
    for (std::size_t g = 0; g < discs.size(); ++g)
      world.grains.mass[g] = std::pow(10, std::sin(7.0 * static_cast<double>(g)));
    Simulation<2> simulation(world, positions_of(discs));
    for (std::size_t g = 0; g < discs.size(); ++g) {
      const auto phase = static_cast<double>(g);
      simulation.set_velocity(g, {std::sin(phase * phase), std::cos(3 * phase * phase)});
    }
    const Velocities before(simulation);
    const double energy = kinetic_energy(simulation);
    ASSERT_TRUE(simulation.advance().solver.converged);
    double p_w_p = 0;
    for (std::size_t g = 0; g < discs.size(); ++g)
      p_w_p += world.grains.mass[g] * (simulation.velocity(g) - before.velocity[g]).squaredNorm();
    ASSERT_GT(p_w_p, energy / 10);
    lost.near(kinetic_energy(simulation) - energy, -(1 - e) / (1 + e) * p_w_p / 2, 1e-9);
  }
}

TEST_P(ImpactAtOnce, ALightDiscThatRattlesBetweenHeavyOnesDoesNotDriveThemApart)
{
  // The disc has no space: in each step it hits one neighbour and parts from the other.
  auto discs = row_of(3);
  for (auto& disc : discs) disc.position.x() *= 0.99;
  auto world = world_of(discs);
  world.grains.mass = {1000, 1, 1000};
  world.material = {0, 0.9};
  world.solver = {1e-12, 1000};
  auto row = Simulation<2>(world, positions_of(discs));
  row.set_velocity(1, {1, 0});
  Case gain("G19", "energy of a light disc between heavy ones, over its first");
  const double first = kinetic_energy(row);
  for (int step = 0; step < 1000; ++step) {
    row.advance();
    gain.at_most(kinetic_energy(row) / first, 1 + 1e-9);
  }
}

}  // namespace
}  // namespace grseg::hard_cases
