// SPDX-License-Identifier: GPL-3.0-or-later
#include "sim/solver/sweep.hpp"
#include "tests/hard_cases/case.hpp"
#include "tests/hard_cases/contact_problem.hpp"
#include "tests/hard_cases/flows.hpp"
#include "tests/sim/contact_list.hpp"
#include "tests/sim/small_chute.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <string>

/// The same run in other units and on other instruction sets.
namespace grseg::hard_cases {
namespace {

/// The same crowd with all lengths times `length` and all masses times `mass`, under the same
/// gravity, so that times scale with the square root of lengths.
Crowd scaled(Crowd c, double length, double mass)
{
  const double time = std::sqrt(length);
  for (auto& r : c.world.grains.radius) r *= length;
  for (auto& m : c.world.grains.mass) m *= mass;
  for (auto& wall : c.world.walls) wall.point *= length;
  c.world.box.length_x *= length;
  c.world.box.length_y *= length;
  c.world.step *= time;
  for (auto& x : c.position) x *= length;
  for (auto& v : c.velocity) v *= length / time;
  for (auto& w : c.spin) w /= time;
  return c;
}

TEST(Units, LengthsAThousandthAndMassesAMillionTimesGiveTheSameFlow)
{
  const auto original = flow(6, 6, 0.5);
  const double length = 1e-3, mass = 1e6, speed = std::sqrt(length);
  auto a = original.simulation(), b = scaled(original, length, mass).simulation();
  Frame<2> in_a, in_b;
  for (int step = 0; step < 1000; ++step) {
    a.advance(in_a);
    b.advance(in_b);
  }
  Case positions("H27", "positions in scaled units, m"), velocities("H27", "velocities, m/s"),
      forces("H27", "forces, of a weight");
  for (std::size_t g = 0; g < original.position.size(); ++g) {
    positions.at_most((b.position(g) / length - a.position(g)).norm(), 1e-10);
    velocities.at_most((b.velocity(g) / speed - a.velocity(g)).norm(), 1e-10);
  }
  EXPECT_GT(in_a.contacts.size(), 30u);
  ASSERT_EQ(in_a.contacts.i, in_b.contacts.i);
  ASSERT_EQ(in_a.contacts.j, in_b.contacts.j);
  const double weight = 9.8 * original.world.grains.mass[0];
  for (std::size_t c = 0; c < in_a.contacts.size(); ++c)
    forces.at_most((in_b.contacts.force[c] / mass - in_a.contacts.force[c]).norm() / weight, 1e-9);
}

TEST(Units, TwelveDecadesOfDiametersGiveTheSameFlow)
{
  // Powers of ten cause different rounding, and a flow forgets its initial state: 1000 steps.
  Case positions("G9", "positions in scaled units, lengths times 10⁻⁶ to 10⁶, m");
  const auto original = flow(6, 6, 0.5);
  auto a = original.simulation();
  for (int step = 0; step < 1000; ++step) a.advance();
  for (const double length : {1e-6, 1e-4, 1e-2, 1e2, 1e4, 1e6}) {
    auto b = scaled(original, length, length * length).simulation();
    std::size_t touching = 0;
    for (int step = 0; step < 1000; ++step) touching += b.advance().touching;
    EXPECT_GT(touching, 10000u);
    for (std::size_t g = 0; g < original.position.size(); ++g)
      positions.at_most((b.position(g) / length - a.position(g)).norm(), 1e-10);
  }
}

/// All results of a deposited and tilted chute of 50 grains after 200 steps, in units of 2^(2 k)
/// for lengths and 2^k for times.
std::vector<double> seen_of_a_chute(int k)
{
  const double length = std::ldexp(1, 2 * k), time = std::ldexp(1, k);
  const auto scene = small_chute::scene({"--small-diameter", fmt::format("{}m", 0.005 * length),
                                         "--frame-interval", fmt::format("{}", 0.05 * time)});
  auto simulation = small_chute::bed(scene);
  Frame<2> frame;
  std::size_t contacts = 0;
  for (int step = 0; step < 200; ++step) {
    simulation.advance(frame);
    contacts += frame.contacts.size();
  }
  EXPECT_GT(contacts, 200u * 30);
  std::vector<double> seen;
  for (std::size_t g = 0; g < frame.position.size(); ++g)
    for (const double x : {frame.position[g].x() / length, frame.position[g].y() / length,
                           frame.velocity[g].x() / time, frame.velocity[g].y() / time,
                           frame.angular_velocity[g] * time})
      seen.push_back(x);
  for (const auto& f : frame.contacts.force)
    for (const double x : {f.x(), f.y()}) seen.push_back(x / (length * length));
  return seen;
}

TEST(Units, DiametersFromNanometresToKilometresGiveTheSameSceneToTheLastBit)
{
  // Powers of two do not change rounding, so any difference comes from a number with a unit in the program.
  // The comparison covers everything from the scene's text to the forces, including deposition.
  Case same("G9", "a scene with d_S from 4.8 nm to 5.2 km is the same, bit for bit");
  const auto ours = seen_of_a_chute(0);
  for (const int k : {-10, -7, -3, 3, 7, 10}) same.holds(seen_of_a_chute(k) == ours);
}

/// Contact forces of the following step, with contacts in the order of ids: 50 sweeps without an initial
/// guess. The result of Gauss-Seidel depends on the order, which in a step is the order in space.
struct Forces {
  ContactList<2> list;
  std::vector<Vec2> impulse;  // kg m/s
  std::vector<Vec2> velocity;

  explicit Forces(Simulation<2> simulation)
  {
    Frame<2> frame;
    simulation.advance(frame);
    list = frame.contacts;
    auto problem = contact_problem(simulation, frame);
    solve_contacts(problem.contacts, problem.motion, simulation.world().material.friction, {},
                   {0, 50}, 1);
    for (const auto& c : problem.contacts)
      impulse.push_back(c.impulse_n * Vec2(c.n[0], c.n[1]) +
                        c.impulse_t[0] * Vec2(-c.n[1], c.n[0]));
    for (std::size_t g = 0; g < simulation.world().grains.size(); ++g)
      velocity.push_back(simulation.velocity(g));
  }
};

/// The crowd after `steps` steps, as a new initial state.
Crowd after(Crowd c, int steps)
{
  auto simulation = c.simulation();
  for (int step = 0; step < steps; ++step) simulation.advance();
  for (std::size_t g = 0; g < c.position.size(); ++g) {
    c.position[g] = simulation.position(g);
    c.velocity[g] = simulation.velocity(g);
    c.spin[g] = simulation.angular_velocity(g);
  }
  return c;
}

void expect_same_forces(const Crowd& original, const Crowd& moved, const std::string& how)
{
  const Forces here(original.simulation()), there(moved.simulation());
  ASSERT_GT(here.list.size(), 20u);
  Case("H24", "the same contacts " + how)
      .holds(here.list.i == there.list.i && here.list.j == there.list.j);
  ASSERT_EQ(here.impulse.size(), there.impulse.size());
  Case forces("H24", "difference of a force over the largest, contacts in order of ids, " + how);
  double largest = 0;
  for (const auto& p : here.impulse) largest = std::max(largest, p.norm());
  ASSERT_GT(largest, 0);
  for (std::size_t c = 0; c < here.impulse.size(); ++c)
    forces.at_most((here.impulse[c] - there.impulse[c]).norm() / largest, 1e-12);
}

TEST(Period, AShiftAlongItChangesNoContactAndNoForce)
{
  const auto original = after(flow(8, 8, 0.5), 1500);
  for (const double shift : {0.3, 4.7, -3.1, 9.6}) {
    auto moved = original;
    for (auto& x : moved.position) x.x() += shift;
    expect_same_forces(original, moved, "after a shift");
  }
}

TEST(Period, AnObserverWhoMovesAlongSeesTheSameForces)
{
  // A crowd that is pressed together, seen from a moving frame of reference.
  auto original = crowd(8, 8, 1);
  const auto press = [&] {
    for (std::size_t g = 0; g < original.position.size(); ++g)
      original.velocity[g].y() -= 3 * (original.position[g].y() - 5);
  };
  press();
  original = after(original, 200);
  press();
  for (const double speed : {0.7, -5.0}) {
    auto moved = original;
    for (auto& v : moved.velocity) v.x() += speed;
    expect_same_forces(original, moved, "under a boost");
  }
}

/// All numbers of the last frame of a flow, as bits.
std::vector<std::uint64_t> bits_of_a_flow()
{
  auto c = flow(8, 8, 0.5);
  c.world.material.restitution = 0.25;
  auto simulation = c.simulation();
  Frame<2> frame;
  for (int step = 0; step < 1000; ++step) simulation.advance(frame);
  std::vector<std::uint64_t> bits;
  const auto add = [&](double x) { bits.push_back(std::bit_cast<std::uint64_t>(x)); };
  for (const auto* vectors : {&frame.position, &frame.velocity, &frame.contacts.force})
    for (const auto& v : *vectors) {
      add(v.x());
      add(v.y());
    }
  for (const double w : frame.angular_velocity) add(w);
  return bits;
}

TEST(InstructionSets, AFlowIsTheSameToTheLastBitOnEachOfThemAndInEveryRun)
{
  const auto best = bits_of_a_flow();
  EXPECT_GT(best.size(), 64u * 5 + 2 * 30);
  EXPECT_EQ(best, bits_of_a_flow());
  Case same("H38", "bits of 1000 steps on avx512, avx2, sse4, scalar are those of the best");
  for (const auto& set : instruction_sets()) {
    use_instruction_set(set);
    same.holds(best == bits_of_a_flow());
  }
  use_instruction_set("");
}

}  // namespace
}  // namespace grseg::hard_cases
