// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/balance/momentum_balance.hpp"

#include "analysis/frames/grains_below.hpp"
#include "tests/analysis/grain_builder.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

namespace grseg {
namespace {

using std::numbers::pi;

constexpr double step = 1e-3;
const Vec2 gravity(3, -9), weightless(0, 0);
const Layers unit_layers(1, 10);
const Kernel gauss(0.2);

/// Sets the force on every grain to its weight plus its contact forces.
Packing moved_by(Packing scene, const Vec2& g)
{
  auto& force = scene.frame.force;
  force.clear();
  for (const double mass : scene.grains.mass) force.emplace_back(mass * g);
  const auto& list = scene.frame.contacts;
  for (std::size_t k = 0; k < list.size(); ++k) {
    force[static_cast<std::size_t>(list.i[k])] += list.force[k];
    if (list.j[k] >= 0) force[static_cast<std::size_t>(list.j[k])] -= list.force[k];
  }
  return scene;
}

/// Grains of both species and a base, joined by contacts with random forces.
Packing random_bed(unsigned seed)
{
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> place(0, 3), kick(-1, 1);
  Packing scene;
  for (int g = 0; g < 60; ++g) {
    const auto species = g < 5 ? Species::boundary : g % 3 == 0 ? Species::large : Species::small;
    scene.grain(species, g % 3 == 0 ? 0.2 : 0.1, {3 * place(random), g < 5 ? -0.1 : place(random)},
                {2 + kick(random), kick(random)}, kick(random));
  }
  std::uniform_int_distribution<std::int32_t> mobile(5, 59), any(0, 59);
  for (int k = 0; k < 150; ++k) {
    const auto i = mobile(random), j = any(random);
    if (i != j) scene.contact(i, j, {kick(random), kick(random)});
  }
  scene.wall_contact(7, 0, {0.3, 0.4}, {0.1, 0.15});
  return moved_by(scene, gravity);
}

MomentumBalance<2> balance_of(const std::vector<Packing>& frames, const Vec2& g = gravity,
                              const Kernel& kernel = gauss, const Layers& layers = unit_layers)
{
  MomentumBalance<2> balance(layers, kernel, g, step);
  for (const auto& scene : frames) balance.add(scene.grains, scene.frame);
  return balance;
}

double largest_residual(const MomentumBalance<2>& balance)
{
  double most = 0;
  for (std::size_t n = 0; n < balance.layers(); ++n)
    for (const auto species : {Species::small, Species::large})
      most = std::max(most, balance.mean(n, species).residual().cwiseAbs().maxCoeff());
  return most;
}

/// Part of a Gaussian of width 0.2 centred at height y that lies below an edge.
double below(double edge, double y)
{
  return std::erfc((y - edge) / 0.2 / std::numbers::sqrt2) / 2;
}

TEST(MomentumBalance, ClosesForEachSpeciesUnderAnyForces)
{
  const auto balance = balance_of({random_bed(1)}, gravity, Kernel(0.3));
  EXPECT_GT(balance.mean(1, Species::small).contact.norm(), 0.1);
  EXPECT_GT(balance.mean(1, Species::large).interaction.norm(), 0.1);
  EXPECT_GT(balance.mean(0, Species::small).base.norm(), 0.05);
  EXPECT_LT(largest_residual(balance), 1e-12);
}

// A grain below the base still pushes two grains of the bed. Its force is one of the base.
TEST(MomentumBalance, ClosesWhereGrainsHaveLeftTheBed)
{
  auto scene = random_bed(1);
  const auto left = scene.grain(Species::large, 0.2, {1, -3});
  scene.contact(20, left, {0.5, 2});
  scene.contact(left, 21, {-0.25, -1});
  scene = moved_by(scene, gravity);
  auto without = scene;
  remove_grains_below(scene.grains, scene.frame, ContactsAcross::kept);
  remove_grains_below(without.grains, without.frame, ContactsAcross::removed);
  const auto balance = balance_of({scene});
  EXPECT_LT(largest_residual(balance), 1e-12);
  Vec2 base(0, 0);
  for (std::size_t n = 0; n < balance.layers(); ++n)
    for (const auto species : {Species::small, Species::large})
      base += balance.mean(n, species).base - balance_of({without}).mean(n, species).base;
  EXPECT_LT((base * unit_layers.volume(0) - Vec2(0.75, 3)).norm(), 1e-12);
}

TEST(MomentumBalance, AForceWithoutAContactIsLeftAsResidualWhereItActs)
{
  auto scene = random_bed(1);
  scene.frame.position[20].y() = 1.1;
  scene = moved_by(scene, gravity);
  const Vec2 lost(0.5, -0.25);
  scene.frame.force[20] += lost;
  const auto balance = balance_of({scene});
  const Vec2 expected = lost * (below(2, 1.1) - below(1, 1.1)) / unit_layers.volume(0);
  const auto species = scene.grains.species[20];
  EXPECT_LT((balance.mean(1, species).residual() - expected).norm(), 1e-12);
}

// Two grains push each other across the edge y = 1 of two layers; the large one is above.
TEST(MomentumBalance, TheTermsOfAPairAreThoseWorkedOutByHand)
{
  Packing scene;
  const auto large = scene.grain(Species::large, 0.2, {1, 1.15});
  const auto small = scene.grain(Species::small, 0.1, {1, 0.85});
  const Vec2 force(0.3, 2);
  scene.contact(large, small, force);
  const auto balance = balance_of({moved_by(scene, weightless)}, weightless);
  const double volume = unit_layers.volume(0);
  const double at_large = 1 - below(1, 1.15), at_small = 1 - below(1, 0.85);
  const double at_contact = 1 - below(1, 0.95);  // share of the contact point in the upper layer

  const auto upper = balance.mean(1, Species::large), lower = balance.mean(1, Species::small);
  EXPECT_LT((upper.interaction - force * at_contact / volume).norm(), 1e-14);
  EXPECT_LT((lower.interaction + force * at_contact / volume).norm(), 1e-14);
  EXPECT_LT((upper.contact - force * (at_large - at_contact) / volume).norm(), 1e-14);
  EXPECT_LT((lower.contact + force * (at_small - at_contact) / volume).norm(), 1e-14);
  EXPECT_LT((upper.rate - force * at_large / volume).norm(), 1e-13);
  EXPECT_EQ(upper.base, Vec2(0, 0));
  // Sum over both layers of force (x) arm, cut at the contact point.
  const Tensor2 stress = upper.contact_stress + balance.mean(0, Species::large).contact_stress;
  EXPECT_TRUE(same(volume * stress, force * Vec2(0, 0.2).transpose()));
  const Tensor2 other = lower.contact_stress + balance.mean(0, Species::small).contact_stress;
  EXPECT_TRUE(same(volume * other, force * Vec2(0, 0.1).transpose()));
}

// The stress at the bottom of a layer flows in, the stress at its top flows out: f (x) (r_i - c),
// spread along the line from r_i to c.
TEST(MomentumBalance, TheContactTermIsTheDivergenceOfTheContactStress)
{
  const auto scene = random_bed(2);
  const auto& list = scene.frame.contacts;
  const auto flow = [&](double y, Species species) {
    Vec2 sum(0, 0);
    for (std::size_t k = 0; k < list.size(); ++k) {
      const auto i = static_cast<std::size_t>(list.i[k]);
      const double y_i = scene.frame.position[i].y();
      const double c = contact_point(scene.grains, scene.frame, k).y();
      if (scene.grains.species[i] == species)
        sum += list.force[k] * (y_i - c) * gauss.along(y, y_i, c);
      if (list.j[k] < 0) continue;
      const auto j = static_cast<std::size_t>(list.j[k]);
      const double y_j = scene.frame.position[j].y();
      if (scene.grains.species[j] == species)
        sum -= list.force[k] * (y_j - c) * gauss.along(y, y_j, c);
    }
    return sum;
  };
  const auto balance = balance_of({scene});
  for (const auto species : {Species::small, Species::large}) {
    const Vec2 gained = (flow(1, species) - flow(2, species)) / unit_layers.volume(0);
    EXPECT_LT((balance.mean(1, species).contact - gained).norm(), 1e-14);
  }
}

// Discs of radius 1/2 on a fixed one, named large and small in turn. Layers extend from contact to contact.
// With a kernel narrower than a radius, the mean stress of a layer is the weight above its middle.
TEST(MomentumBalance, AColumnCarriesItsWeight)
{
  constexpr int count = 6;
  const double mass = pi / 4, weight = 9 * mass;
  Packing scene;
  scene.grain(Species::boundary, 0.5, {5, -0.5});
  for (int n = 0; n < count; ++n)
    scene.grain(n % 2 == 0 ? Species::large : Species::small, 0.5, {5, n + 0.5});
  for (int n = 0; n < count; ++n) scene.contact(n + 1, n, {0, weight * (count - n)});
  for (const double m : scene.grains.mass) EXPECT_DOUBLE_EQ(m, mass);
  const auto balance = balance_of({moved_by(scene, {0, -9})}, {0, -9}, Kernel(0.05));
  ASSERT_EQ(balance.layers(), 6u);
  EXPECT_LT(largest_residual(balance), 1e-13);
  for (std::size_t n = 0; n < count; ++n) {
    const auto small = balance.mean(n, Species::small), large = balance.mean(n, Species::large);
    const Tensor2 stress = small.contact_stress + large.contact_stress;
    const double above = weight * (count - 0.5 - static_cast<double>(n));
    EXPECT_NEAR(stress(1, 1) * unit_layers.length(), above, 1e-12);
    EXPECT_NEAR((small.rate + large.rate).y(), 0, 1e-13);
    const double supported = n == 0 ? count * weight : 0;
    EXPECT_NEAR((small.base + large.base).y() * unit_layers.volume(0), supported, 1e-12);
    EXPECT_NEAR((small.gravity + large.gravity).y() * unit_layers.volume(0), -weight, 1e-12);
    EXPECT_LT((small.interaction + large.interaction).norm(), 1e-14);
  }
}

// In one step the centre falls from 1.05 to 1.05 - 2 h, and the part of the kernel below an edge
// grows.
TEST(MomentumBalance, AFallingGrainCarriesItsMomentumThroughAnEdge)
{
  Packing scene;
  scene.grain(Species::large, 0.5, {1, 1.05}, {4, -2});
  scene.grain(Species::small, 0.1, {1, 2.5});
  const double mass = pi / 4, volume = unit_layers.volume(0);
  const auto balance = balance_of({moved_by(scene, gravity)});
  const auto here = balance.mean(1, Species::large), beneath = balance.mean(0, Species::large);
  const auto through = [&](double edge) -> Vec2 {
    const double part = below(edge, 1.05 - 2 * step) - below(edge, 1.05);
    return mass * Vec2(4, -2) * part / step / volume;
  };
  const double share = below(2, 1.05) - below(1, 1.05);
  EXPECT_LT((here.kinetic + through(1) - through(2)).norm(), 1e-11);
  EXPECT_LT((beneath.kinetic - through(1)).norm(), 1e-11);
  EXPECT_LT((here.gravity - share * mass * gravity / volume).norm(), 1e-14);
  EXPECT_LT((here.rate - here.kinetic - here.gravity).norm(), 1e-12);
  EXPECT_LT((here.force - here.gravity).norm(), 1e-14);
  EXPECT_NEAR(here.density, share * mass / volume, 1e-15);
  EXPECT_NEAR(here.momentum_flux(0, 1), -8 * share * mass / volume, 1e-14);
}

// Frames of consecutive steps: grains fly straight between the impulses of two steps.
TEST(MomentumBalance, RatesOfConsecutiveStepsAddUpToTheChange)
{
  std::mt19937 random(5);
  std::normal_distribution<double> kick(0, 30);
  Packing scene = random_bed(3);
  scene.frame.contacts.clear();
  std::vector<Packing> frames;
  for (int k = 0; k < 8; ++k) {
    for (std::size_t g = 5; g < scene.grains.size(); ++g) {
      auto& velocity = scene.frame.velocity[g];
      scene.frame.position[g] += step * velocity;
      scene.frame.force[g] = scene.grains.mass[g] * Vec2(kick(random), kick(random));
      velocity += step * scene.frame.force[g] / scene.grains.mass[g];
    }
    scene.frame.time = step * k;
    frames.push_back(scene);
  }
  const auto all = balance_of(frames);
  frames.pop_back();
  const auto but_last = balance_of(frames);
  ASSERT_EQ(all.layers(), but_last.layers());
  for (std::size_t n = 0; n < all.layers(); ++n)
    for (const auto species : {Species::small, Species::large}) {
      const Vec2 rate = but_last.mean(n, species).rate;
      EXPECT_GT(rate.norm(), 1e-3);
      EXPECT_LT((all.change(n, species) - rate).norm(), 1e-11);
    }
}

TEST(MomentumBalance, OfTheWholeBedOnlyWeightAndBaseRemain)
{
  const auto scene = random_bed(4);
  const auto balance = balance_of({scene});
  Vec2 base(0, 0), weight(0, 0);
  const auto& list = scene.frame.contacts;
  for (std::size_t k = 0; k < list.size(); ++k)
    if (list.j[k] < 5) base += list.force[k];
  for (std::size_t g = 5; g < scene.grains.size(); ++g) weight += scene.grains.mass[g] * gravity;
  SpeciesMomentum<2> small, large;
  for (std::size_t n = 0; n < balance.layers(); ++n) {
    small += balance.mean(n, Species::small);
    large += balance.mean(n, Species::large);
    const Vec2 pair =
        balance.mean(n, Species::small).interaction + balance.mean(n, Species::large).interaction;
    EXPECT_LT(pair.norm(), 1e-13);
  }
  const double volume = unit_layers.volume(0);
  EXPECT_LT((volume * (small.base + large.base) - base).norm(), 1e-12);
  EXPECT_LT((volume * (small.gravity + large.gravity) - weight).norm(), 1e-12);
  EXPECT_LT((volume * (small.rate + large.rate) - base - weight).norm(), 1e-10);
  for (const auto* of : {&small, &large}) EXPECT_LT(of->kinetic.norm(), 1e-11);
}

TEST(MomentumBalance, NeitherAShiftAlongTheSlopeNorTheOrderOfAPairMatters)
{
  const auto scene = random_bed(6);
  Packing other = scene;
  for (auto& position : other.frame.position) position.x() = std::fmod(position.x() + 7, 10);
  auto& list = other.frame.contacts;
  for (std::size_t k = 0; k < list.size(); ++k) {
    if (list.j[k] < 5) continue;
    std::swap(list.i[k], list.j[k]);
    list.force[k] *= -1;
    list.branch[k] *= -1;
  }
  const auto a = balance_of({scene}), b = balance_of({other});
  for (const auto species : {Species::small, Species::large}) {
    const auto here = a.mean(1, species), there = b.mean(1, species);
    EXPECT_TRUE(same(here.contact_stress, there.contact_stress));
    EXPECT_LT((here.contact - there.contact).norm(), 1e-13);
    EXPECT_LT((here.interaction - there.interaction).norm(), 1e-13);
  }
}

TEST(MomentumBalance, PartsMergeIntoTheWhole)
{
  std::vector<Packing> frames;
  for (unsigned k = 0; k < 5; ++k) frames.push_back(random_bed(10 + k));
  for (std::size_t k = 0; k < frames.size(); ++k) frames[k].frame.time = static_cast<double>(k);
  frames[1].frame.position[30].y() = 6.5;  // the bed of one frame is higher than that of the others
  const auto whole = balance_of(frames);
  auto parts = balance_of({});
  parts.merge(balance_of({frames[0], frames[1]}));
  parts.merge(balance_of({frames[2], frames[3], frames[4]}));
  ASSERT_EQ(parts.layers(), whole.layers());
  for (std::size_t n = 0; n < whole.layers(); ++n)
    for (const auto species : {Species::small, Species::large}) {
      const auto a = whole.mean(n, species), b = parts.mean(n, species);
      EXPECT_LT((a.rate - b.rate).norm(), 1e-12);
      EXPECT_TRUE(same(a.contact_stress, b.contact_stress));
      EXPECT_NEAR(a.density, b.density, 1e-15);
      EXPECT_EQ(whole.change(n, species), parts.change(n, species));
    }
}

TEST(MomentumBalance, OfASingleFrameTheChangeIsUnknown)
{
  EXPECT_TRUE(std::isnan(balance_of({random_bed(1)}).change(0, Species::small).x()));
}

}  // namespace
}  // namespace grseg
