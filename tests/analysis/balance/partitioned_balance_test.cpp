// SPDX-License-Identifier: GPL-3.0-or-later
// Effects of a partition rule on the forces on a species, and quantities that no rule changes.
#include "analysis/balance/driving_forces.hpp"
#include "analysis/balance/momentum_balance.hpp"
#include "tests/analysis/balance/random_balance.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

namespace grseg {
namespace {

/// Larger grain's share of a contact under a rule, computed independently.
double share_by_words(const std::string& rule, double r_large, double r_small, double gap)
{
  if (rule == "size") return r_large / (r_large + r_small);
  if (rule == "contact-point") return (r_large + gap / 2) / (r_large + r_small + gap);
  if (rule == "half") return 0.5;
  if (rule == "power:2") return r_large * r_large / (r_large * r_large + r_small * r_small);
  return std::stod(rule.substr(rule.find(':') + 1));
}

/// Part of a Gaussian centred at height y that lies above an edge.
double above_edge(double edge, double y)
{
  return std::erfc((edge - y) / kernel_width / std::numbers::sqrt2) / 2;
}

template <int D>
void expect_n_of_stored_forces(int species)
{
  const Kernel kernel(0.3);
  const auto count = static_cast<std::size_t>(species);
  const std::vector frames{random_contacts<D>(1, species), random_contacts<D>(2, species)};
  const auto balance = momentum_of<D>(frames, count, kernel);
  const auto contacts = contacts_of<D>(frames, all_rules, count, kernel);
  ASSERT_EQ(contacts.layers(), balance.layers());
  for (std::size_t n = 0; n < contacts.layers(); ++n)
    for (int k = 0; k < species; ++k) {
      const auto of = balance.mean(n, static_cast<Species>(k));
      const Vector<D> expected = of.force - of.gravity;
      for (std::size_t rule = 0; rule < all_rules.size(); ++rule)
        EXPECT_LT((contacts.mean(n, static_cast<Species>(k), rule).sum() - expected).norm(), 1e-13)
            << all_rules[rule].name() << ' ' << k;
      EXPECT_LT((contacts.contact_force(n, static_cast<Species>(k)) - expected).norm(), 1e-13);
      EXPECT_GT(contacts.mean(n, static_cast<Species>(k), 0).sum().norm(), 1e-5);
    }
}

// N = -div sigma + beta + base equals the stored forces on the grains minus their weight.
TEST(PartitionGauge, UnderEveryRuleTheContactForceOnASpeciesIsThatOfTheForcesOnItsGrains)
{
  expect_n_of_stored_forces<2>(2);
  expect_n_of_stored_forces<3>(2);
  expect_n_of_stored_forces<2>(3);
  expect_n_of_stored_forces<3>(4);
}

/// Force that the stress, cut by `rule`, carries upward through height y: stress times area.
template <int D>
Vector<D> flow(const PackingOf<D>& scene, double y, Species species, const std::string& rule)
{
  const auto& list = scene.frame.contacts;
  Vector<D> sum = Vector<D>::Zero();
  for (std::size_t k = 0; k < list.size(); ++k) {
    const auto i = static_cast<std::size_t>(list.i[k]);
    const double y_i = scene.frame.position[i].y(), r_i = scene.grains.radius[i];
    const bool wall = list.j[k] < 0;
    const auto j = wall ? i : static_cast<std::size_t>(list.j[k]);
    const double r_j = scene.grains.radius[j];
    const bool base = wall || scene.grains.species[j] == Species::boundary;
    const bool i_larger = scene.grains.species[i] > scene.grains.species[j];
    double part = wall ? 1 : share_by_words("contact-point", r_i, r_j, list.gap[k]);
    if (!base && scene.grains.species[i] != scene.grains.species[j]) {
      if (rule == "drop") continue;
      const double p =
          share_by_words(rule, i_larger ? r_i : r_j, i_larger ? r_j : r_i, list.gap[k]);
      part = i_larger ? p : 1 - p;
    }
    const double y_j = y_i - list.branch[k].y(), cut = y_i - part * list.branch[k].y();
    if (scene.grains.species[i] == species)
      sum += list.force[k] * (y_i - cut) * bell.along(y, y_i, cut);
    if (!base && scene.grains.species[j] == species)
      sum += list.force[k] * (cut - y_j) * bell.along(y, y_j, cut);
  }
  return sum;
}

template <int D>
void expect_divergence()
{
  const auto scene = random_contacts<D>(3);
  const auto contacts = contacts_of<D>({scene});
  const double volume = thin_layers<D>().volume(1);
  for (std::size_t rule = 0; rule < all_rules.size(); ++rule)
    for (const auto species : {Species::small, Species::large}) {
      const auto name = all_rules[rule].name();
      const Vector<D> gained =
          (flow<D>(scene, 1, species, name) - flow<D>(scene, 2, species, name)) / volume;
      EXPECT_LT((contacts.mean(1, species, rule).contact - gained).norm(), 1e-14) << name;
    }
}

// The line integrals of the stress at the layer's edges do not depend on where forces act.
TEST(PartitionGauge, UnderEveryRuleTheContactTermIsTheDivergenceOfThatRulesStress)
{
  expect_divergence<2>();
  expect_divergence<3>();
}

// A large grain above a small one that it touches: centres at 1.15 and 0.85, contact at 0.95. The rule
// half cuts at 1, which is the edge of the layers.
TEST(PartitionGauge, OfTwoGrainsAtDifferentHeightsHalfAndSizePushAsWorkedOutByHand)
{
  Packing scene;
  const auto large = scene.grain(Species::large, 0.2, {1, 1.15});
  const auto small = scene.grain(Species::small, 0.1, {1, 0.85});
  const Vec2 force(0.3, 2);
  scene.contact(large, small, force);
  const auto contacts = contacts_of<2>({scene}, parse_rules({"half,size,drop"}));
  const double volume = 10, at_large = above_edge(1, 1.15), at_small = above_edge(1, 0.85);
  const double at_contact = above_edge(1, 0.95);
  const auto expect = [&](std::size_t rule, Species species, const Vec2& contact, const Vec2& act) {
    const auto of = contacts.mean(1, species, rule);
    EXPECT_LT((of.contact - contact / volume).norm(), 1e-15) << rule;
    EXPECT_LT((of.interaction - act / volume).norm(), 1e-15) << rule;
    EXPECT_EQ(of.base, Vec2(0, 0));
  };
  expect(0, Species::large, (at_large - 0.5) * force, 0.5 * force);
  expect(0, Species::small, (0.5 - at_small) * force, -0.5 * force);
  expect(1, Species::large, (at_large - at_contact) * force, at_contact * force);
  expect(1, Species::small, (at_contact - at_small) * force, -at_contact * force);
  expect(2, Species::large, {0, 0}, at_large * force);
  expect(2, Species::small, {0, 0}, -at_small * force);
  // Sum over both layers of the share of force (x) branch, with branch = (0, 0.3).
  const auto stress = [&](std::size_t rule, Species species) -> Tensor2 {
    return volume *
           (contacts.mean(0, species, rule).stress + contacts.mean(1, species, rule).stress);
  };
  EXPECT_TRUE(same(stress(0, Species::large), force * Vec2(0, 0.15).transpose()));
  EXPECT_TRUE(same(stress(0, Species::small), force * Vec2(0, 0.15).transpose()));
  EXPECT_TRUE(same(stress(1, Species::large), force * Vec2(0, 0.2).transpose()));
  EXPECT_TRUE(same(stress(1, Species::small), force * Vec2(0, 0.1).transpose()));
  EXPECT_TRUE(same(stress(2, Species::large), Tensor2::Zero().eval()));
}

TEST(PartitionGauge, WhereAllContactsAreMixedDroppingThemLeavesNoStressAndNoPush)
{
  auto scene = random_contacts<2>(4);
  auto& list = scene.frame.contacts;
  const auto species = [&](std::int32_t g) {
    return g < 0 ? Species::boundary : scene.grains.species[static_cast<std::size_t>(g)];
  };
  for (std::size_t k = 0; k < list.size(); ++k)
    if (species(list.j[k]) == Species::boundary || species(list.i[k]) == species(list.j[k]))
      list.force[k] = {0, 0};
  const auto contacts = contacts_of<2>({scene}, parse_rules({"drop,size"}));
  for (std::size_t n = 0; n < 3; ++n)
    for (const auto one : {Species::small, Species::large}) {
      const auto of = contacts.mean(n, one, 0);
      EXPECT_EQ(of.contact, Vec2(0, 0));
      EXPECT_TRUE(same(of.stress, Tensor2::Zero().eval(), 0));
      EXPECT_EQ(of.interaction, contacts.contact_force(n, one));
      EXPECT_GT(contacts.mean(n, one, 1).contact.norm(), 1e-3);
    }
}

template <int D>
void expect_sums_over_species(int species)
{
  const auto contacts = contacts_of<D>({random_contacts<D>(5, species)}, all_rules,
                                       static_cast<std::size_t>(species));
  for (std::size_t n = 0; n < 3; ++n) {
    Vector<D> first = Vector<D>::Zero();
    Tensor<D> stress = contacts.mixed_stress(n);
    for (int k = 0; k < species; ++k) stress += contacts.unmixed_stress(n, static_cast<Species>(k));
    for (std::size_t rule = 0; rule < all_rules.size(); ++rule) {
      PartitionedForces<D> sum;
      for (int k = 0; k < species; ++k) {
        const auto of = contacts.mean(n, static_cast<Species>(k), rule);
        sum.contact += of.contact;
        sum.interaction += of.interaction;
        sum.stress += of.stress;
      }
      if (rule == 0) first = sum.contact;
      const bool adds_up = all_rules[rule].adds_up();
      EXPECT_EQ((sum.contact - first).norm() < 1e-14, adds_up) << all_rules[rule].name();
      EXPECT_EQ(sum.interaction.norm() < 1e-14, adds_up) << all_rules[rule].name();
      EXPECT_EQ((sum.stress - stress).norm() < 1e-14, adds_up) << all_rules[rule].name();
    }
  }
}

// A cut that gives more to one species takes equally from the others.
TEST(PartitionGauge, TheMixtureIsTheSameUnderAllRulesButDrop)
{
  expect_sums_over_species<2>(2);
  expect_sums_over_species<3>(3);
}

// The interaction depends on the cut. A test of N alone would also pass if rules had no effect.
TEST(PartitionGauge, EachRuleHasAnotherInteraction)
{
  const auto contacts = contacts_of<2>({random_contacts<2>(6)});
  for (std::size_t a = 0; a < all_rules.size(); ++a)
    for (std::size_t b = 0; b < a; ++b) {
      double most = 0;
      for (const auto species : {Species::small, Species::large})
        most = std::max(most, (contacts.mean(1, species, a).interaction -
                               contacts.mean(1, species, b).interaction)
                                  .norm());
      EXPECT_GT(most, 1e-4) << all_rules[a].name() << ' ' << all_rules[b].name();
    }
}

TEST(PartitionGauge, TheOrderInWhichAContactNamesItsGrainsDoesNotMatter)
{
  const auto scene = random_contacts<3>(7);
  auto other = scene;
  auto& list = other.frame.contacts;
  for (std::size_t k = 0; k < list.size(); ++k) {
    if (list.j[k] < 5) continue;
    std::swap(list.i[k], list.j[k]);
    list.force[k] *= -1;
    list.branch[k] *= -1;
  }
  const auto a = contacts_of<3>({scene}), b = contacts_of<3>({other});
  for (std::size_t rule = 0; rule < all_rules.size(); ++rule)
    for (const auto species : {Species::small, Species::large}) {
      const auto here = a.mean(1, species, rule), there = b.mean(1, species, rule);
      EXPECT_LT((here.contact - there.contact).norm(), 1e-14);
      EXPECT_LT((here.interaction - there.interaction).norm(), 1e-14);
      EXPECT_TRUE(same(here.stress, there.stress));
    }
}

TEST(PartitionGauge, AtTheContactPointTheTermsAreThoseOfTheBalance)
{
  const std::vector frames{random_contacts<3>(8)};
  const auto balance = momentum_of<3>(frames);
  const auto contacts = contacts_of<3>(frames, parse_rules({"contact-point"}));
  for (std::size_t n = 0; n < 3; ++n)
    for (const auto species : {Species::small, Species::large}) {
      const auto a = balance.mean(n, species);
      const auto b = contacts.mean(n, species, 0);
      EXPECT_LT((a.contact - b.contact).norm(), 1e-14);
      EXPECT_LT((a.interaction - b.interaction).norm(), 1e-14);
      EXPECT_LT((a.base - b.base).norm(), 1e-14);
      EXPECT_TRUE(same(a.contact_stress, b.stress));
    }
}

TEST(PartitionGauge, PartsMergeIntoTheWhole)
{
  std::vector<Packing> frames;
  for (unsigned k = 0; k < 4; ++k) frames.push_back(random_contacts<2>(10 + k));
  frames[1].frame.position[30].y() = 6.5;  // the bed of one frame is higher than that of the others
  const auto whole = contacts_of<2>(frames);
  auto parts = contacts_of<2>({});
  parts.merge(contacts_of<2>({frames[0]}));
  parts.merge(contacts_of<2>({frames[1], frames[2], frames[3]}));
  ASSERT_EQ(parts.layers(), whole.layers());
  for (std::size_t n = 0; n < whole.layers(); ++n)
    for (std::size_t rule = 0; rule < all_rules.size(); ++rule) {
      const auto a = whole.mean(n, Species::large, rule), b = parts.mean(n, Species::large, rule);
      EXPECT_LT((a.interaction - b.interaction).norm(), 1e-14);
      EXPECT_TRUE(same(a.stress, b.stress));
      EXPECT_TRUE(same(whole.mixed_stress(n), parts.mixed_stress(n)));
    }
}

// Push and spread follow from the stress under the rule, beta from its cuts, and drag closes the
// balance: only their sum does not depend on the rule.
TEST(PartitionGauge, UnderEveryRuleTheInteractionIsSpreadDragAndScatter)
{
  const auto frames = two_frames(9);
  const auto balance = momentum_of<2>(frames);
  const auto contacts = contacts_of<2>(frames);
  for (std::size_t n = 0; n < 3; ++n) {
    const auto forces = driving_forces(balance, n);
    for (std::size_t rule = 0; rule < all_rules.size(); ++rule) {
      const auto of = rule_forces(forces, contacts, n, rule);
      const double beta = contacts.mean(n, Species::large, rule).interaction.y();
      EXPECT_NEAR(of.spread + forces.spread_kinetic + of.drag + forces.scatter, beta, 1e-11)
          << all_rules[rule].name();
      EXPECT_NEAR(of.push + of.drag, forces.push + forces.drag, 1e-12);
      EXPECT_EQ(std::isnan(of.b), all_rules[rule] == parse_rule("drop"));
    }
    const auto at_contact = rule_forces(forces, contacts, n, 1);
    EXPECT_NEAR(at_contact.push, forces.push, 1e-12);
    EXPECT_NEAR(at_contact.spread, forces.spread, 1e-12);
    EXPECT_NEAR(at_contact.b, forces.b, 1e-11);
  }
}

// The share p of every mixed contact belongs to its large grain, so the push is linear in p and 0 at p*.
TEST(PartitionGauge, ThePushChangesItsSignAtPStar)
{
  const auto frames = two_frames(11);
  const auto balance = momentum_of<2>(frames);
  for (std::size_t n = 0; n < 3; ++n) {
    const auto forces = driving_forces(balance, n);
    const auto contacts = contacts_of<2>(frames);
    const auto over = push_over_share(forces, contacts, n);
    EXPECT_NEAR(rule_forces(forces, contacts, n, 4).push, over.none, 1e-12);  // uniform:0
    EXPECT_NEAR(rule_forces(forces, contacts, n, 6).push, over.all, 1e-12);   // uniform:1
    EXPECT_GT(std::abs(over.all - over.none), 1e-3);
    EXPECT_NEAR(over.none + over.zero() * (over.all - over.none), 0, 1e-13);
  }
}

// At rest, the contacts of every grain carry its weight: N is minus the weight under every rule, while the
// divergence of stress depends on the rule. The bed is a chain of touching grains, small and large in turn.
TEST(PartitionGauge, OfGrainsAtRestNIsMinusTheirWeightUnderEveryRule)
{
  Packing scene;
  const auto layers = thin_layers<2>();
  double height = 0;
  scene.grain(Species::boundary, 0.1, {2, -0.1});
  for (int n = 0; n < 12; ++n) {
    const bool large = n % 2 == 1;
    const double r = large ? 0.2 : 0.1;
    scene.grain(large ? Species::large : Species::small, r, {2, height + r});
    height += 2 * r;
  }
  double load = 0;
  for (int n = 12; n > 0; --n) {
    load += 9 * scene.grains.mass[static_cast<std::size_t>(n)];
    scene.contact(n, n - 1, {0, load});
  }
  scene.frame.force.assign(scene.grains.size(), {0, 0});
  MomentumBalance<2> balance(layers, bell, Vec2(0, -9), gauge_step);
  balance.add(scene.grains, scene.frame);
  const auto contacts = contacts_of<2>({scene});
  for (std::size_t n = 0; n < contacts.layers(); ++n)
    for (const auto species : {Species::small, Species::large})
      for (std::size_t rule = 0; rule < all_rules.size(); ++rule)
        EXPECT_NEAR(contacts.mean(n, species, rule).sum().y(),
                    -balance.mean(n, species).gravity.y(), 1e-12);
  EXPECT_GT(std::abs(contacts.mean(1, Species::large, 0).contact.y() -
                     contacts.mean(1, Species::large, 2).contact.y()),
            0.01);
}

}  // namespace
}  // namespace grseg
