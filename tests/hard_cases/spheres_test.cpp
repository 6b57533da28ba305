// SPDX-License-Identifier: GPL-3.0-or-later
#include "sim/step/energies.hpp"
#include "tests/hard_cases/case.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <random>
#include <tuple>

/// Spheres, whose friction is a vector of the tangent plane, against closed forms.
namespace grseg::hard_cases {
namespace {

constexpr double g = 9.8, r = 0.5, h = 1e-3;

/// Spheres of density 1 in empty space without gravity.
World<3> world_of(const std::vector<double>& radii)
{
  World<3> world;
  world.box = {100, 100, false, 3, 100, false};
  for (const double radius : radii) {
    world.grains.id.push_back(static_cast<std::int32_t>(world.grains.size()));
    world.grains.species.push_back(Species::small);
    world.grains.radius.push_back(radius);
    world.grains.mass.push_back(grain_volume<3>(radius));
    world.grains.fixed.push_back(0);
  }
  world.step = h;
  world.solver.tolerance = 1e-13;
  world.solver.max_sweeps = 100000;
  return world;
}

/// A sphere that touches a plane of slope angle `slope` (radians), which falls along x.
Simulation<3> on_a_plane(double slope, double friction, Precision precision = Precision::doubles)
{
  auto world = world_of({r});
  world.solver.precision = precision;
  if (precision == Precision::mixed) world.solver.tolerance = 1e-5;
  world.walls = {{Vec3::Zero(), Vec3::UnitY()}};
  world.material.friction = friction;
  world.gravity = {g * std::sin(slope), -g * std::cos(slope), 0};
  return {world, {{0, r, 0}}};
}

/// Velocity of the sphere's lowest point, m/s.
Vec3 slip(const Simulation<3>& s)
{
  const Vec3 surface = s.velocity(0) - r * s.angular_velocity(0).cross(Vec3::UnitY());
  return {surface.x(), 0, surface.z()};
}

TEST(SphereOnAWall, AnObliqueImpactSticksInsideTheConeAndSlidesOutside)
{
  Case sticks("S1", "slip after an impact that sticks, m/s"),
      slides("S1", "speed along the wall after an impact that slides, m/s"),
      rebound("S1", "speed away from the wall over e v_n");
  const Vec3 along(0.6, 0, 0.8);
  // The speculative law slows the sphere down in one step, and lets it rebound in the next.
  const auto speculative = law_parameters(ContactLaw::speculative, 0.75, h, g, 2 * r);
  for (const auto& [friction, e, law] : {std::tuple{0.1, 0.25, LawParameters()},
                                         {0.5, 0.8, LawParameters()},
                                         {0.1, 0.8, speculative},
                                         {0.5, 0.25, speculative}})
    for (const double ratio : {0.1, 0.9, 1.1, 5.0}) {  // over the largest one that sticks
      auto world = world_of({r});
      world.law = law;
      world.walls = {{Vec3::Zero(), Vec3::UnitY()}};
      world.material = {friction, e};
      Simulation<3> sphere(world, {{0, r + 0.0103, 0}});
      const double v_n = 2, v_t = ratio * 3.5 * friction * (1 + e) * v_n;
      sphere.set_velocity(0, Vec3(0, -v_n, 0) + v_t * along);
      for (int k = 0; k < 20; ++k) sphere.advance();
      const auto v = sphere.velocity(0);
      rebound.near(v.y() / (e * v_n), 1, 1e-13);
      const double expected = ratio < 1 ? v_t * 5 / 7 : v_t - friction * (1 + e) * v_n;
      slides.near(Vec3(v.x(), 0, v.z()).dot(along), expected, 1e-12);
      if (ratio < 1) sticks.near(slip(sphere).norm(), 0, 1e-12);
    }
}

TEST(SlidingSphere, RollsAfterTwoSeventhsOfVOverMuGAtFiveSeventhsOfItsSpeed)
{
  Case time("S2", "time 2v₀/(7μg) until it rolls, s"), way("S2", "way 12v₀²/(49μg) until then, m"),
      speed("S2", "speed over 5v₀/7"), energy("S2", "part of the energy that is lost");
  for (const double mu : {0.05, 0.2, 1.0})
    for (const double v : {0.3, 3.0}) {
      auto sphere = on_a_plane(0, mu);
      const Vec3 along(0.8, 0, -0.6);
      sphere.set_velocity(0, v * along);
      const double before = translational_energy(sphere) + rotational_energy(sphere);
      while (slip(sphere).norm() > 1e-12 && sphere.time() < 100) sphere.advance();
      const double expected = 2 * v / (7 * mu * g);
      time.near(sphere.time(), expected, h);
      const double late = sphere.time() - expected;
      way.near((sphere.position(0) - Vec3(0, r, 0)).dot(along) - late * 5 * v / 7,
               12 * v * v / (49 * mu * g), mu * g * h * h / 8 * (1 + 1e-6));
      for (int k = 0; k < 1000; ++k) sphere.advance();
      speed.near(sphere.velocity(0).dot(along) / (5 * v / 7), 1, 1e-12);
      energy.near(1 - (translational_energy(sphere) + rotational_energy(sphere)) / before, 2.0 / 7,
                  1e-12);
    }
}

TEST(SphereOnAnIncline, RollsIfTanIsAtMostSevenHalvesOfMuAndSlidesOtherwise)
{
  Case rolls("S3", "speed 5/7 g sin after 1 s, m/s"),
      slides("S3", "speed g (sin − μ cos) after 1 s, m/s"),
      single("S3", "the same in single precision, over that speed");
  for (const double mu : {0.1, 0.5})
    for (const double ratio : {0.5, 0.99, 1.01, 2.0}) {
      const double slope = std::atan(ratio * 3.5 * mu);
      auto sphere = on_a_plane(slope, mu);
      for (int k = 0; k < 1000; ++k) sphere.advance();
      const double speed = sphere.velocity(0).x();
      const double expected =
          ratio < 1 ? 5.0 / 7 * g * std::sin(slope) : g * (std::sin(slope) - mu * std::cos(slope));
      (ratio < 1 ? rolls : slides).near(speed, expected, 1e-10);
      // Roots have a relative error of 8e-7, increments of impulses one of 1e-7.
      auto in_single = on_a_plane(slope, mu, Precision::mixed);
      for (int k = 0; k < 1000; ++k) in_single.advance();
      single.near(in_single.velocity(0).x() / expected, 1, 1e-5);
    }
}

TEST(SpinningSphere, FollowsAParabolaUntilItRolls)
{
  // Friction opposes the slip u = v − rω×n, which keeps its direction, so the force is constant.
  Case direction("S4", "sine of the angle by which the slip turns"),
      time("S4", "time 2|u₀|/(7μg) until it rolls, s"), path("S4", "place where it rolls, m"),
      velocity("S4", "velocity v₀ − 2u₀/7 afterwards, m/s"), spin("S4", "change of ω·n, 1/s");
  const double mu = 0.3;
  for (const Vec3& omega : {Vec3(4, 5, -1), Vec3(-2, 0, 6), Vec3(0, -30, 9)}) {
    auto sphere = on_a_plane(0, mu);
    const Vec3 v0(1, 0, 0);
    sphere.set_velocity(0, v0, omega);
    const Vec3 u0 = slip(sphere), along = u0.normalized();
    const double until = 2 * u0.norm() / (7 * mu * g);
    while (slip(sphere).norm() > 1e-12 && sphere.time() < 100) {
      const Vec3 u = slip(sphere);
      if (u.norm() > 1e-6) direction.near(u.cross(along).norm() / u.norm(), 0, 1e-9);
      sphere.advance();
    }
    time.near(sphere.time(), until, h);
    const Vec3 v = v0 - 2.0 / 7 * u0;
    const Vec3 there = Vec3(0, r, 0) + until * v0 - mu * g * until * until / 2 * along;
    const Vec3 late = (sphere.time() - until) * v;
    path.near((sphere.position(0) - late - there).norm(), 0, mu * g * h * h / 8 * (1 + 1e-6));
    velocity.near((sphere.velocity(0) - v).norm(), 0, 1e-12);
    spin.near(sphere.angular_velocity(0).y() - omega.y(), 0, 1e-13 * omega.norm());
  }
}

TEST(SpinningSphere, AboutTheNormalOnlyNeitherMovesNorSlows)
{
  Case way("S5", "way in 1,000 steps, m"), spin("S5", "change of its spin, 1/s");
  auto sphere = on_a_plane(0, 0.5);
  sphere.set_velocity(0, Vec3::Zero(), {0, 7, 0});
  for (int k = 0; k < 1000; ++k) sphere.advance();
  way.near((sphere.position(0) - Vec3(0, r, 0)).norm(), 0, 1e-12);
  spin.near((sphere.angular_velocity(0) - Vec3(0, 7, 0)).norm(), 0, 1e-15);
}

/// Three touching spheres on a floor, and one on top of them.
Simulation<3> pyramid_of_four(double friction)
{
  auto world = world_of({r, r, r, r});
  world.walls = {{Vec3::Zero(), Vec3::UnitY()}};
  world.material = {friction, 0};
  world.gravity = {0, -g, 0};
  std::vector<Vec3> position;
  const double ring = 2 * r / std::sqrt(3.0);
  for (int k = 0; k < 3; ++k) {
    const double angle = 2 * std::numbers::pi * k / 3;
    position.emplace_back(ring * std::cos(angle), r, ring * std::sin(angle));
  }
  position.emplace_back(0, r + std::sqrt(8.0 / 3) * r, 0);
  return {world, position};
}

TEST(SphereOnASphere, LeavesItWhereTheCosineIsTenSeventeenthsOfThatAtTheStart)
{
  // Rolling without slip, N = m g (17 cos - 10 cos_0)/7. Friction is a vector in space, and the
  // tangent plane turns by 50 degrees under it.
  Case leaves("S15", "cosine of the angle from the vertical where a rolling sphere leaves");
  auto world = world_of({r, 4 * r});
  world.grains.fixed[1] = 1;
  world.material = {1000, 0};
  world.law = law_parameters(ContactLaw::speculative, 0.75, h, g, 2 * r);
  world.gravity = {0, -g, 0};
  const double start = 0.2, apart = 5 * r;
  const Vec3 centre(50, 50, 50), down(0.6, 0, 0.8);
  const auto at = [&](double angle) -> Vec3 {
    return centre + apart * (std::cos(angle) * Vec3::UnitY() + std::sin(angle) * down);
  };
  Simulation<3> simulation(world, {at(start), centre});
  double cosine = 1, speed = 0;
  while (cosine > 0) {
    const bool bears = simulation.advance().force_bearing > 0;
    const double now = (simulation.position(0) - centre).normalized().y();
    if (!bears && now < cosine - 0.01) break;
    if (bears) cosine = now;
    speed = simulation.velocity(0).norm();
  }
  leaves.near(cosine, 10 * std::cos(start) / 17, 2 * speed * h / apart);
}

TEST(PyramidOfFourSpheres, StandsIfFrictionIsAtLeastTheTangentOfHalfTheAngle)
{
  // The line of centres leans by alpha from the vertical, sin alpha = 1/sqrt(3). A sphere below is
  // pushed at two points, so both forces point along the line through them: alpha/2 from the normal.
  Case stands("S6", "sinking of the top in 1 s, diameters"),
      falls("S6", "sinking with less friction");
  const double limit = std::tan(std::asin(1 / std::sqrt(3.0)) / 2);
  for (const double part : {1.01, 2.0}) {
    auto pyramid = pyramid_of_four(part * limit);
    const double top = pyramid.position(3).y();
    for (int k = 0; k < 1000; ++k) pyramid.advance();
    stands.near((top - pyramid.position(3).y()) / (2 * r), 0, 1e-6);
  }
  auto pyramid = pyramid_of_four(0.5 * limit);
  const double top = pyramid.position(3).y();
  for (int k = 0; k < 1000; ++k) pyramid.advance();
  falls.between((top - pyramid.position(3).y()) / (2 * r), 0.1, 10);
}

TEST(ColumnOfSpheres, TheKthCarriesTheWeightOfThoseAbove)
{
  Case force("S7", "force under the k-th sphere over kmg"),
      still("S7", "all other velocities, m/s");
  constexpr int n = 10;
  auto world = world_of(std::vector<double>(n, r));
  world.walls = {{Vec3::Zero(), Vec3::UnitY()}};
  world.material = {0.5, 0};
  world.gravity = {0, -g, 0};
  std::vector<Vec3> position;
  for (int k = 0; k < n; ++k) position.emplace_back(0, (2 * k + 1) * r, 0);
  Simulation<3> column(world, position);
  Frame<3> frame;
  for (int k = 0; k < 200; ++k) column.advance(frame);
  const double weight = world.grains.mass[0] * g;
  for (std::size_t c = 0; c < frame.contacts.size(); ++c) {
    const auto upper = std::max(frame.contacts.i[c], frame.contacts.j[c]);
    force.near(frame.contacts.force[c].norm() / ((n - upper) * weight), 1, 1e-8);
  }
  EXPECT_EQ(frame.contacts.size(), static_cast<std::size_t>(n));
  for (const auto& v : frame.velocity) still.near(v.norm(), 0, 1e-9);
}

/// Sum of m v, and of m x × v + I ω.
std::pair<Vec3, Vec3> momenta(const Simulation<3>& s)
{
  Vec3 linear = Vec3::Zero(), angular = Vec3::Zero();
  const auto& grains = s.world().grains;
  for (std::size_t k = 0; k < grains.size(); ++k) {
    const double m = grains.mass[k], inertia = 0.4 * m * grains.radius[k] * grains.radius[k];
    linear += m * s.velocity(k);
    angular += m * s.position(k).cross(s.velocity(k)) + inertia * s.angular_velocity(k);
  }
  return {linear, angular};
}

TEST(ClusterOfSpheres, KeepsMomentumAndAllComponentsOfAngularMomentum)
{
  Case linear("S9", "change of momentum over the sum of its sizes"),
      angular("S9", "change of angular momentum over the sum of its sizes");
  for (const auto precision : {Precision::doubles, Precision::mixed}) {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> number(-1, 1);
    std::vector<double> radii;
    std::vector<Vec3> position;
    for (int k = 0; k < 64; ++k) {
      radii.push_back(0.3 + 0.15 * number(random));
      position.emplace_back(k % 4 - 1.5, k / 4 % 4 - 1.5, k / 16 - 1.5);
    }
    auto world = world_of(radii);
    world.material = {0.5, 0.5};
    world.law = law_parameters(ContactLaw::speculative, 0.75, h, g, 0.3);
    world.solver.precision = precision;
    world.solver.tolerance = precision == Precision::doubles ? 1e-12 : 1e-5;
    Simulation<3> cluster(world, position);
    double size = 0, turn = 0;
    for (std::size_t k = 0; k < position.size(); ++k) {
      const Vec3 v = -3 * position[k] + Vec3(number(random), number(random), number(random));
      cluster.set_velocity(k, v, 10 * Vec3(number(random), number(random), number(random)));
      size += world.grains.mass[k] * v.norm();
      turn += world.grains.mass[k] * v.norm() * position[k].norm();
    }
    const auto [p, l] = momenta(cluster);
    std::size_t contacts = 0;
    for (int k = 0; k < 1000; ++k) contacts += cluster.advance().force_bearing;
    EXPECT_GT(contacts, 500u);
    const auto [p_after, l_after] = momenta(cluster);
    linear.near((p_after - p).norm() / size, 0, 1e-13);
    angular.near((l_after - l).norm() / turn, 0, 1e-12);
  }
}

/// 125 spheres of two sizes in a cell periodic along x and z, above a rough floor; `x` and `z` are the
/// axes of their pattern.
Simulation<3> heap_along(int x, int z)
{
  std::mt19937 random(3);
  std::uniform_real_distribution<double> number(-0.1, 0.1);
  std::vector<double> radii;
  std::vector<Vec3> position;
  for (int k = 0; k < 125; ++k) {
    radii.push_back(k % 3 == 0 ? 0.45 : 0.3);
    Vec3 at;
    at[x] = k % 5 + 0.5 + number(random);
    at[1] = k / 25 + 0.7 + number(random);
    at[z] = k / 5 % 5 + 0.5 + number(random);
    position.push_back(at);
  }
  auto world = world_of(radii);
  world.box = {5, 100, true, 3, 5, true};
  world.walls = {{Vec3::Zero(), Vec3::UnitY()}};
  world.material = {0.5, 0.5};
  world.gravity = Vec3(0, -g * std::cos(0.5), 0);
  world.gravity[x] = g * std::sin(0.5);
  return {world, position};
}

TEST(FallingSpheres, MoveAlongZAsTheyMoveAlongX)
{
  // Exchanging x and z is a reflection: it exchanges the velocities and reverses all spins. The order
  // of contacts changes, so each solve differs by its tolerance, 1e-13 g h, and collisions let the
  // difference grow, tenfold in each of them.
  Case place("S10", "difference of places after 0.6 s between flows along x and along z, m");
  Simulation<3> a = heap_along(0, 2), b = heap_along(2, 0);
  std::size_t contacts = 0;
  for (int k = 0; k < 600; ++k) {
    contacts += a.advance().force_bearing;
    b.advance();
  }
  EXPECT_GT(contacts, 1000u);
  for (std::size_t k = 0; k < 125; ++k) {
    const Vec3 p = a.position(k), q = b.position(k);
    place.at_most((p - Vec3(q.z(), q.y(), q.x())).norm(), 1e-8);
  }
}

TEST(FallingSpheres, EveryPairThatOverlapsIsAContact)
{
  // Pairs of grains that cannot touch yet are not tested; no such pair may be missed.
  auto heap = heap_along(0, 2);
  for (std::size_t k = 0; k < 125; ++k) heap.set_velocity(k, 4 * (k % 2 ? 1 : -1) * Vec3(1, 0, 1));
  Case found("S14", "pairs that overlap and were not found");
  Frame<3> frame;
  std::size_t all = 0;
  for (int k = 0; k < 600; ++k) {
    const auto report = heap.advance(frame);
    std::size_t overlapping = 0;
    for (std::size_t i = 0; i < 125; ++i) {
      const double radius = heap.world().grains.radius[i];
      overlapping += frame.position[i].y() <= radius ? 1 : 0;
      for (std::size_t j = 0; j < i; ++j) {
        Vec3 apart = frame.position[i] - frame.position[j];
        for (const int axis : {0, 2}) apart[axis] -= 5 * std::round(apart[axis] / 5);
        overlapping += apart.norm() <= radius + heap.world().grains.radius[j] ? 1 : 0;
      }
    }
    found.near(static_cast<double>(report.touching), static_cast<double>(overlapping), 0);
    all += overlapping;
  }
  EXPECT_GT(all, 1000u);
  EXPECT_GT(heap.pair_list_renewals(), 10u);
}

/// A sphere (the last grain) on three frozen ones whose centres are 2 r `apart` from each other.
struct Pit {
  double apart, mu;
  double sine = apart / std::sqrt(3.0);  // of the contacts' angle from the vertical
  double cosine = std::sqrt(1 - sine * sine);
  Vec3 top{50, 50 + 2 * r* cosine, 50};

  Simulation<3> simulation(Precision precision) const
  {
    auto world = world_of({r, r, r, r});
    for (std::size_t k = 0; k < 3; ++k) world.grains.fixed[k] = 1;
    world.material = {mu, 0};
    world.gravity = {0, -g, 0};
    world.solver.precision = precision;
    if (precision == Precision::mixed) world.solver.tolerance = 1e-5;
    std::vector<Vec3> position;
    for (int k = 0; k < 3; ++k) {
      const double angle = 2 * std::numbers::pi * k / 3, ring = 2 * r * sine;
      position.emplace_back(50 + ring * std::cos(angle), 50, 50 + ring * std::sin(angle));
    }
    position.push_back(top);
    return {world, position};
  }
};

TEST(SphereInAPit, RestsWithForcesThatStaticsAllows)
{
  // Three frozen spheres carry the weight: sum of N cos alpha + T sin alpha = m g, |T| <= mu N, where
  // alpha is the angle of the contacts from the vertical.
  Case rests("S12", "way in 1 s, m"), forces("S12", "sum of normal forces over m g");
  for (const double mu : {0.1, 0.5})
    for (const double apart : {1.1, 1.6}) {
      const Pit scene{apart, mu};
      auto pit = scene.simulation(Precision::doubles);
      Frame<3> frame;
      for (int k = 0; k < 1000; ++k) pit.advance(frame);
      rests.near((pit.position(3) - scene.top).norm(), 0, 1e-9);
      double normal = 0;
      for (std::size_t c = 0; c < frame.contacts.size(); ++c)
        normal += frame.contacts.force[c].dot(frame.contacts.branch[c].normalized());
      normal /= pit.world().grains.mass[3] * g;
      const double least = scene.cosine - mu * scene.sine, most = least > 0 ? 1 / least : 1e3;
      forces.between(normal, 1 / (scene.cosine + mu * scene.sine) * (1 - 1e-9), most * (1 + 1e-9));
    }
}

TEST(SphereInAPit, ThatSpinsSlidesAlikeInBothPrecisions)
{
  // Friction of one contact changes the normal forces of the others. Single precision leaves 1e-5 of
  // the load's velocity, g h, in each of the 50 steps.
  Case alike("S12", "difference of velocities of the surface between the precisions over g h");
  const Pit scene{1.1, 0.1};
  auto exact = scene.simulation(Precision::doubles), single = scene.simulation(Precision::mixed);
  for (auto* pit : {&exact, &single}) {
    pit->set_velocity(3, Vec3::Zero(), Vec3(3, 20, -10));
    for (int k = 0; k < 50; ++k) pit->advance();
  }
  EXPECT_GT(exact.angular_velocity(3).norm(), 5);
  const Vec3 turn = exact.angular_velocity(3) - single.angular_velocity(3);
  alike.at_most(((exact.velocity(3) - single.velocity(3)).norm() + r * turn.norm()) / (g * h),
                50 * 1e-5 * 10);
}

}  // namespace
}  // namespace grseg::hard_cases
