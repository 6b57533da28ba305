// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/stress/partial_contact_stress.hpp"

#include "analysis/frames/composition.hpp"
#include "analysis/stress/partial_stress.hpp"
#include "formats/core/errors.hpp"
#include "tests/analysis/contact_packings.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace grseg {
namespace {

TEST(PartialContactStress, PushingGrainsApartIsPositiveWhoeverComesFirst)
{
  Packing packing = large_on_small();
  EXPECT_GT(stress_of(packing, Assignment::contact_point).mean(1).sums.of(PairSum::whole, 0)(1, 1),
            0);
  std::swap(packing.frame.contacts.i[0], packing.frame.contacts.j[0]);
  packing.frame.contacts.force[0] *= -1;
  packing.frame.contacts.branch[0] *= -1;
  for (const auto assignment : all_assignments) {
    const auto here = stress_of(packing, assignment),
               there = stress_of(large_on_small(), assignment);
    for (std::size_t n = 0; n < here.layers(); ++n) {
      EXPECT_TRUE(
          same(here.mean(n).sums.of(PairSum::whole, 0), there.mean(n).sums.of(PairSum::whole, 0)));
      EXPECT_TRUE(same(here.mean(n).sums.of(PairSum::by_size, 0),
                       there.mean(n).sums.of(PairSum::by_size, 0)));
      EXPECT_TRUE(same(here.mean(n).sums.of(PairSum::up_to_contact, 0),
                       there.mean(n).sums.of(PairSum::up_to_contact, 0)));
      EXPECT_TRUE(same(here.mean(n).sums.of(PairSum::at_larger, 0),
                       there.mean(n).sums.of(PairSum::at_larger, 0)));
    }
  }
}

TEST(PartialContactStress, AContactCountsWholeWhereItTouches)
{
  const auto stress = stress_of(large_on_small(), Assignment::contact_point);
  ASSERT_EQ(stress.layers(), 4u);
  EXPECT_TRUE(same(stress.mean(1).sums.of(PairSum::whole, 0), mixed));
  EXPECT_TRUE(same(stress.mean(1).sums.of(PairSum::by_size, 0), mixed * 2 / 3));
  EXPECT_TRUE(same(stress.mean(1).sums.of(PairSum::up_to_contact, 0), mixed * 2 / 3));
  EXPECT_EQ(stress.mean(1).contacts, (std::vector<double>{0, 1, 0, 0, 0}));
  for (const std::size_t n : {0U, 2U, 3U})
    EXPECT_TRUE(same(stress.mean(n).sums.of(PairSum::whole, 0), mixed * 0));
}

// The branch runs from 1.25 to 2.75: half is in layer 1, half in layer 2. The large grain's part is
// 1.75 to 2.75: 0.25 of 1.5 in layer 1 and 0.75 of 1.5 in layer 2.
TEST(PartialContactStress, AlongTheBranchEveryLayerGetsItsLength)
{
  const auto stress = stress_of(large_on_small(), Assignment::branch, 0);
  EXPECT_TRUE(same(stress.mean(1).sums.of(PairSum::whole, 0), mixed / 2));
  EXPECT_TRUE(same(stress.mean(2).sums.of(PairSum::whole, 0), mixed / 2));
  EXPECT_TRUE(same(stress.mean(1).sums.of(PairSum::by_size, 0), mixed / 6));
  EXPECT_TRUE(same(stress.mean(2).sums.of(PairSum::by_size, 0), mixed / 2));
  EXPECT_TRUE(same(stress.mean(1).sums.of(PairSum::up_to_contact, 0), mixed / 6));
  EXPECT_TRUE(same(stress.mean(2).sums.of(PairSum::up_to_contact, 0), mixed / 2));
  // power:0 is a weight, not a cut: it takes one half of the stress in the layer.
  EXPECT_TRUE(same(stress.mean(1).sums.of(PairSum::by_power, 0), mixed / 4));
  EXPECT_TRUE(same(stress.mean(2).sums.of(PairSum::by_power, 0), mixed / 4));
}

TEST(PartialContactStress, EachGrainsPartCountsAtItsOwnCentre)
{
  const auto stress = stress_of(large_on_small(), Assignment::grain);
  EXPECT_TRUE(same(stress.mean(2).sums.of(PairSum::by_size, 0), mixed * 2 / 3));
  EXPECT_TRUE(same(stress.mean(2).sums.of(PairSum::up_to_contact, 0), mixed * 2 / 3));
  EXPECT_TRUE(same(stress.mean(2).sums.of(PairSum::whole, 0), mixed * 2 / 3));
  EXPECT_TRUE(same(stress.mean(1).sums.of(PairSum::whole, 0), mixed / 3));
  EXPECT_TRUE(same(stress.mean(2).sums.of(PairSum::at_larger, 0), mixed));
  EXPECT_TRUE(same(stress.mean(1).sums.of(PairSum::at_larger, 0), mixed * 0));
  EXPECT_TRUE(same(stress.mean(1).sums.of(PairSum::at_smaller, 0), mixed));
  EXPECT_TRUE(same(stress.mean(2).sums.of(PairSum::at_smaller, 0), mixed * 0));
}

// `compute stress/atom` of LAMMPS: every grain gets half of force (x) branch of each of its
// contacts, whatever the other grain is; summed by species and layer.
TEST(PartialContactStress, HalvesAtTheGrainsCentresAreTheStressPerGrainOfLammps)
{
  const Packing packing = heap();
  const auto stress = stress_of(packing, Assignment::grain);
  std::vector<std::array<Tensor2, 2>> by_hand(stress.layers(), {Tensor2::Zero(), Tensor2::Zero()});
  const auto& list = packing.frame.contacts;
  const auto give = [&](std::int32_t grain, std::size_t contact) {
    const auto g = static_cast<std::size_t>(grain);
    if (packing.grains.species[g] == Species::boundary) return;
    by_hand[unit_layers.at(unit_layers.height(packing.frame.position[g]))]
           [static_cast<std::size_t>(packing.grains.species[g])] +=
        0.5 * dyad(list.force[contact], list.branch[contact]);
  };
  for (std::size_t c = 0; c < list.size(); ++c) {
    give(list.i[c], c);
    give(list.j[c], c);
  }
  for (std::size_t n = 0; n < stress.layers(); ++n) {
    auto sums = stress.mean(n).sums;
    sums.volume = 1;
    for (const char* rule : {"half", "uniform:0.5"}) {
      const auto ours = partial_stress(sums, parse_rule(rule), BasePart::half);
      EXPECT_TRUE(same(ours.small(), by_hand[n][0], 1e-12)) << rule;
      EXPECT_TRUE(same(ours.large(), by_hand[n][1], 1e-12)) << rule;
      EXPECT_TRUE(same(ours.total, by_hand[n][0] + by_hand[n][1], 1e-12)) << rule;
    }
  }
}

// Radii 1 and 0.5 overlap by 0.3: the contact point halves the overlap, 0.85 from the large centre
// and 0.35 from the small one, while under size the shares are still two to one.
TEST(PartialContactStress, OverlapMovesTheContactPointButNotTheShareBySize)
{
  Packing packing = large_on_small();
  packing.frame.position[1].y() = 1.55;
  packing.frame.contacts = {};
  packing.contact(0, 1, push);
  const Tensor2 whole = dyad(push, {0, 1.2});
  const auto sums = stress_of(packing, Assignment::contact_point).mean(1).sums;
  EXPECT_TRUE(same(sums.of(PairSum::whole, 0), whole));
  EXPECT_TRUE(same(sums.of(PairSum::by_size, 0), whole * 2 / 3));
  EXPECT_TRUE(same(sums.of(PairSum::up_to_contact, 0), whole * 0.85 / 1.2));
}

TEST(PartialContactStress, APowerOfTwoGivesTheLargeGrainFourFifths)
{
  const auto stress = stress_of(large_on_small(), Assignment::contact_point, 2);
  EXPECT_TRUE(same(stress.mean(1).sums.of(PairSum::by_power, 0), mixed * 0.8));
}

TEST(PartialContactStress, EqualGrainsAreKeptApartBySpecies)
{
  for (const auto species : {Species::small, Species::large}) {
    Packing packing;
    const auto a = packing.grain(species, 0.5, {5, 1.25}), b = packing.grain(species, 1, {5, 2.75});
    packing.contact(b, a, push);
    const bool small = species == Species::small;
    const auto own = [&](const PartialContactStress<2>& stress, std::size_t n) {
      return small ? stress.mean(n).sums.of(OwnSum::inside, 0)
                   : stress.mean(n).sums.of(OwnSum::inside, 1);
    };
    EXPECT_TRUE(same(own(stress_of(packing, Assignment::contact_point), 1), mixed));
    EXPECT_TRUE(same(own(stress_of(packing, Assignment::branch), 1), mixed / 2));
    EXPECT_TRUE(same(own(stress_of(packing, Assignment::branch), 2), mixed / 2));
    EXPECT_TRUE(same(own(stress_of(packing, Assignment::grain), 1), mixed / 3));
    EXPECT_TRUE(same(own(stress_of(packing, Assignment::grain), 2), mixed * 2 / 3));
    const auto at_grains = stress_of(packing, Assignment::grain).mean(2).sums;
    EXPECT_TRUE(
        same(small ? at_grains.of(OwnSum::halves, 0) : at_grains.of(OwnSum::halves, 1), mixed / 2));
    EXPECT_TRUE(
        same(small ? at_grains.of(OwnSum::halves, 1) : at_grains.of(OwnSum::halves, 0), mixed * 0));
    const auto counts = stress_of(packing, Assignment::contact_point).mean(1).contacts;
    EXPECT_EQ(counts[small ? 0 : 2], 1);
    EXPECT_EQ(stress_of(packing, Assignment::branch).mean(1).contacts, counts);
  }
}

TEST(PartialContactStress, TheBaseBranchIsCutAtTheContactPointAndAlsoGivenWhole)
{
  const Packing packing = small_on_base();
  const auto at_point = stress_of(packing, Assignment::contact_point);
  EXPECT_TRUE(same(at_point.mean(0).sums.of(OwnSum::base, 0), mixed / 3));
  EXPECT_TRUE(same(at_point.mean(0).sums.of(OwnSum::whole_base, 0), mixed));
  EXPECT_EQ(at_point.mean(0).contacts, (std::vector<double>{0, 0, 0, 1, 0}));

  const auto along = stress_of(packing, Assignment::branch);
  EXPECT_TRUE(same(along.mean(0).sums.of(OwnSum::base, 0), mixed / 6));
  EXPECT_TRUE(same(along.mean(1).sums.of(OwnSum::base, 0), mixed / 6));
  EXPECT_TRUE(same(along.mean(0).sums.of(OwnSum::whole_base, 0), mixed * 1.25 / 1.5));
  EXPECT_TRUE(same(along.mean(1).sums.of(OwnSum::whole_base, 0), mixed * 0.25 / 1.5));

  const auto at_centre = stress_of(packing, Assignment::grain);
  EXPECT_TRUE(same(at_centre.mean(1).sums.of(OwnSum::base, 0), mixed / 3));
  EXPECT_TRUE(same(at_centre.mean(1).sums.of(OwnSum::whole_base, 0), mixed));
}

TEST(PartialContactStress, AtAStraightWallBothBasePartsAreTheSame)
{
  Packing packing;
  const auto large = packing.grain(Species::large, 1, {5, 1});
  packing.wall_contact(large, 0, push, {0, 1});
  for (const auto assignment : all_assignments) {
    const auto stress = stress_of(packing, assignment);
    Tensor2 cut = Tensor2::Zero(), whole = Tensor2::Zero();
    for (std::size_t n = 0; n < stress.layers(); ++n) {
      cut += stress.mean(n).sums.of(OwnSum::base, 1);
      whole += stress.mean(n).sums.of(OwnSum::whole_base, 1);
    }
    EXPECT_TRUE(same(cut, dyad(push, {0, 1})));
    EXPECT_TRUE(same(whole, cut));
  }
}

TEST(PartialContactStress, ContactsWithoutForceDoNotCount)
{
  Packing packing = large_on_small();
  packing.frame.contacts.force[0] = {0, 0};
  EXPECT_EQ(stress_of(packing, Assignment::contact_point).mean(1).contacts[1], 0);
}

TEST(PartialContactStress, ResultsAreMeansPerFrame)
{
  const Packing packing = large_on_small();
  Packing idle = packing;
  idle.frame.contacts = {};
  PartialContactStress<2> stress(unit_layers, Assignment::contact_point);
  stress.add(packing.grains, packing.frame);
  stress.add(idle.grains, idle.frame);
  EXPECT_TRUE(same(stress.mean(1).sums.of(PairSum::whole, 0), mixed / 2));
  EXPECT_EQ(stress.mean(1).contacts[1], 0.5);
}

TEST(PartialContactStress, ABoundaryGrainNamedFirstIsRefused)
{
  Packing packing;
  const auto base = packing.grain(Species::boundary, 1, {5, 0});
  const auto small = packing.grain(Species::small, 0.5, {5, 1.5});
  packing.contact(base, small, push);
  EXPECT_THROW(stress_of(packing, Assignment::contact_point), FormatError);
}

TEST(PartialContactStress, TheTotalDoesNotDependOnWhereAContactCounts)
{
  const Packing packing = heap();
  const auto at_points = total(stress_of(packing, Assignment::contact_point));
  const auto along = total(stress_of(packing, Assignment::branch));
  const auto at_centres = total(stress_of(packing, Assignment::grain));
  for (std::size_t c = 0; c < at_points.size(); ++c) {
    EXPECT_NEAR(along[c], at_points[c], 1e-12);
    EXPECT_NEAR(at_centres[c], at_points[c], 1e-12);
  }
}

TEST(PartialContactStress, SpeciesAddUpToTheWholeUnderEveryAssignmentAndRule)
{
  const Packing packing = heap();
  for (const auto assignment : all_assignments) {
    const auto stress = stress_of(packing, assignment, 2);
    for (std::size_t n = 0; n < stress.layers(); ++n) {
      auto sums = stress.mean(n).sums;
      sums.volume = unit_layers.volume(0);
      for (const auto& rule :
           parse_rules({"size", "contact-point", "half", "uniform:0.8", "power:2"}))
        for (const auto base : {BasePart::contact_point, BasePart::half, BasePart::none}) {
          const auto partial = partial_stress(sums, rule, base);
          EXPECT_TRUE(same(partial.small() + partial.large(), partial.total));
        }
    }
  }
}

TEST(PartialContactStress, TheTotalIsTheSumOverContacts)
{
  const Packing packing = heap();
  Tensor2 direct = Tensor2::Zero(), sums = Tensor2::Zero();
  for (std::size_t k = 0; k < packing.frame.contacts.size(); ++k)
    direct += dyad(packing.frame.contacts.force[k], packing.frame.contacts.branch[k]);
  const auto stress = stress_of(packing, Assignment::branch);
  for (std::size_t n = 0; n < stress.layers(); ++n) {
    const auto& s = stress.mean(n).sums;
    sums += s.of(OwnSum::inside, 0) + s.of(OwnSum::inside, 1) + s.of(PairSum::whole, 0) +
            s.of(OwnSum::whole_base, 0) + s.of(OwnSum::whole_base, 1);
  }
  EXPECT_TRUE(same(sums, direct, 1e-12));
}

// Momentum balance: the momentum flux down through a level is the net contact force on everything
// above, and the sum over a layer is h times its mean over the levels in the layer.
TEST(PartialContactStress, AlongTheBranchTheSumIsTheForceThroughTheLayer)
{
  const Packing packing = heap();
  const auto net = net_forces(packing);
  const auto stress = stress_of(packing, Assignment::branch);
  for (std::size_t n = 0; n + 1 < stress.layers(); ++n) {
    Vec2 through = Vec2::Zero();
    for (std::size_t g = 0; g < net.size(); ++g)
      through +=
          net[g] * std::clamp(packing.frame.position[g].y() - unit_layers.bottom(n), 0.0, 1.0);
    const auto s = stress.mean(n).sums;
    const Tensor2 sum = s.of(OwnSum::inside, 0) + s.of(OwnSum::inside, 1) +
                        s.of(PairSum::whole, 0) + s.of(OwnSum::whole_base, 0) +
                        s.of(OwnSum::whole_base, 1);
    EXPECT_NEAR(sum(0, 1), through.x(), 1e-12);
    EXPECT_NEAR(sum(1, 1), through.y(), 1e-12);
  }
}

TEST(PartialContactStress, MovingTheBedAlongThePeriodChangesNothing)
{
  const Packing packing = heap();
  Packing moved = packing;
  for (auto& position : moved.frame.position)
    position.x() = std::fmod(position.x() + 3.7, 10.0);  // branches are as before
  for (const auto assignment : all_assignments) {
    const auto here = stress_of(packing, assignment), there = stress_of(moved, assignment);
    for (std::size_t n = 0; n < here.layers(); ++n) EXPECT_EQ(here.row(n), there.row(n));
  }
}

TEST(PartialContactStress, MovingTheBedByAWholeLayerMovesTheRows)
{
  const Packing packing = heap();
  Packing moved = packing;
  for (auto& position : moved.frame.position) position.y() += 1;
  for (const auto assignment : all_assignments) {
    const auto here = stress_of(packing, assignment), there = stress_of(moved, assignment);
    ASSERT_EQ(there.layers(), here.layers() + 1);
    for (std::size_t n = 1; n < here.layers(); ++n)
      for (std::size_t c = 0; c < here.row(n).size(); ++c)
        EXPECT_NEAR(there.row(n + 1)[c], here.row(n)[c], 1e-12);
  }
}

/// The same grains and contacts with other numbers; every second contact has its grains exchanged.
Packing relabelled(const Packing& packing)
{
  const auto count = static_cast<std::int32_t>(packing.grains.size());
  const auto number = [&](std::int32_t g) { return (7 * g + 3) % count; };
  const auto old = [&](std::int32_t g) {
    std::int32_t from = 0;
    while (number(from) != g) ++from;
    return static_cast<std::size_t>(from);
  };
  Packing other;
  for (std::int32_t g = 0; g < count; ++g)
    other.grain(packing.grains.species[old(g)], packing.grains.radius[old(g)],
                packing.frame.position[old(g)]);
  const auto& list = packing.frame.contacts;
  for (std::size_t k = list.size(); k-- > 0;) {
    const auto i = number(list.i[k]), j = number(list.j[k]);
    if (k % 2 == 0 && other.grains.fixed[static_cast<std::size_t>(j)] == 0)
      other.contact(j, i, -list.force[k]);
    else
      other.contact(i, j, list.force[k]);
  }
  return other;
}

TEST(PartialContactStress, NamesAndOrderOfGrainsChangeNothing)
{
  const Packing packing = heap(), other = relabelled(packing);
  for (const auto assignment : all_assignments) {
    const auto here = stress_of(packing, assignment, 2), there = stress_of(other, assignment, 2);
    ASSERT_EQ(there.layers(), here.layers());
    for (std::size_t n = 0; n < here.layers(); ++n)
      for (std::size_t c = 0; c < here.row(n).size(); ++c)
        EXPECT_NEAR(there.row(n)[c], here.row(n)[c], 1e-12);
  }
  for (const auto rule : {GrainArea::clipped, GrainArea::centre, GrainArea::kernel}) {
    Composition<2> here(unit_layers, rule, smooth), there = here;
    here.add(packing.grains, packing.frame);
    there.add(other.grains, other.frame);
    for (std::size_t n = 0; n < here.layers(); ++n) {
      EXPECT_NEAR(there.mean(n)[0], here.mean(n)[0], 1e-13);
      EXPECT_NEAR(there.mean(n)[1], here.mean(n)[1], 1e-13);
    }
  }
}

// A flat heap reaches fewer layers; the part of a kernel above them belongs to its own highest layer.
TEST(PartialContactStress, FramesCanBeAddedApartAndInAnyOrder)
{
  const Packing packing = heap();
  Packing flat = packing;
  for (auto& position : flat.frame.position) position.y() *= 0.5;
  for (const auto assignment : all_assignments) {
    auto together = stress_of(packing, assignment, 2);
    together.add(flat.grains, flat.frame);
    auto apart = stress_of(flat, assignment, 2);
    ASSERT_LT(apart.layers(), together.layers());
    apart.merge(stress_of(packing, assignment, 2));
    ASSERT_EQ(apart.layers(), together.layers());
    for (std::size_t n = 0; n < apart.layers(); ++n)
      for (std::size_t c = 0; c < apart.row(n).size(); ++c)
        EXPECT_NEAR(apart.row(n)[c], together.row(n)[c], 1e-12);
  }
  for (const auto rule : {GrainArea::clipped, GrainArea::centre, GrainArea::kernel}) {
    Composition<2> together(unit_layers, rule, smooth), apart = together, other = together;
    together.add(packing.grains, packing.frame);
    together.add(flat.grains, flat.frame);
    apart.add(flat.grains, flat.frame);
    other.add(packing.grains, packing.frame);
    apart.merge(other);
    for (std::size_t n = 0; n < together.layers(); ++n) {
      EXPECT_NEAR(apart.mean(n)[0], together.mean(n)[0], 1e-13);
      EXPECT_NEAR(apart.mean(n)[1], together.mean(n)[1], 1e-13);
    }
  }
}

TEST(PartialContactStress, ColumnsAndNumbersAgreeInCount)
{
  const Packing packing = large_on_small();
  for (const auto assignment : all_assignments)
    for (const auto power : {std::optional<double>{}, std::optional<double>{2}}) {
      const auto stress = stress_of(packing, assignment, power);
      EXPECT_EQ(stress.columns(two_sizes(1, 2)).size(), stress.row(0).size());
    }
  EXPECT_EQ(stress_of(packing, Assignment::branch).columns(two_sizes(1, 2)).front(), "n_SS");
  EXPECT_EQ(stress_of(packing, Assignment::branch).columns(two_sizes(1, 2)).back(), "F_Lb_yy[N m]");
  EXPECT_EQ(stress_of(packing, Assignment::grain).columns(two_sizes(1, 2)).back(), "MS_yy[N m]");
}

// Stress from sums and rules, compared with stress added up contact by contact.
TEST(PartialContactStress, RecombinedSumsAreTheDirectPartition)
{
  const Packing packing = heap();
  const auto stress = stress_of(packing, Assignment::contact_point, 3);
  for (const auto& rule :
       parse_rules({"size", "contact-point", "half", "drop", "uniform:0.8", "power:3"})) {
    std::vector<Tensor2> large(stress.layers(), Tensor2::Zero()), small = large;
    const auto& list = packing.frame.contacts;
    for (std::size_t k = 0; k < list.size(); ++k) {
      const auto i = static_cast<std::size_t>(list.i[k]), j = static_cast<std::size_t>(list.j[k]);
      const double r_i = packing.grains.radius[i], r_j = packing.grains.radius[j];
      const double point = share_of_first(packing.grains, list, k);
      const Tensor2 t = dyad(list.force[k], list.branch[k]);
      const std::size_t n = std::min(
          unit_layers.at(contact_point(packing.grains, packing.frame, k).y()), stress.layers() - 1);
      auto& own = packing.grains.species[i] == Species::large ? large[n] : small[n];
      auto& other = packing.grains.species[j] == Species::large ? large[n] : small[n];
      double share = 1;
      if (packing.grains.species[j] == Species::boundary) {
        own += point * t;
        continue;
      }
      using Kind = PartitionRule::Kind;
      const bool is_mixed = packing.grains.species[i] != packing.grains.species[j];
      const bool i_large = packing.grains.species[i] == Species::large;
      if (rule.kind == Kind::drop && is_mixed) continue;
      if (rule.kind == Kind::size) share = r_i / (r_i + r_j);
      if (rule.kind == Kind::contact_point) share = point;
      if (rule.kind == Kind::half) share = 0.5;
      if (rule.kind == Kind::uniform) share = i_large ? 0.8 : 1 - 0.8;
      if (rule.kind == Kind::power)
        share = std::pow(r_i, 3) / (std::pow(r_i, 3) + std::pow(r_j, 3));
      own += share * t;
      other += (1 - share) * t;
    }
    for (std::size_t n = 0; n < stress.layers(); ++n) {
      auto sums = stress.mean(n).sums;
      sums.volume = unit_layers.volume(0);
      const auto partial = partial_stress(sums, rule);
      EXPECT_TRUE(same(partial.large(), large[n] / 10, 1e-12)) << rule.name();
      EXPECT_TRUE(same(partial.small(), small[n] / 10, 1e-12)) << rule.name();
    }
  }
}

TEST(Composition, AreasAreClippedOrSpreadOrWholeAtCentresAndAddUpToTheGrains)
{
  Packing packing;
  packing.grain(Species::large, 1, {5, 1.5});
  packing.grain(Species::small, 0.25, {5, 0.5});
  packing.grain(Species::boundary, 1, {5, 0});
  const double pi = std::numbers::pi;

  Composition<2> clipped(unit_layers, GrainArea::clipped);
  clipped.add(packing.grains, packing.frame);
  const double cap = pi / 3 - std::sqrt(3) / 4;
  EXPECT_NEAR(clipped.mean(0)[1], cap, 1e-14);
  EXPECT_NEAR(clipped.mean(1)[1], pi - 2 * cap, 1e-14);
  EXPECT_NEAR(clipped.mean(0)[0], pi / 16, 1e-14);
  EXPECT_NEAR(clipped.mean()[1], pi, 1e-14);
  EXPECT_NEAR(phi_large(clipped.mean()), 16.0 / 17, 1e-14);

  Composition<2> spread(unit_layers, GrainArea::kernel, smooth);
  spread.add(packing.grains, packing.frame);
  const double below = smooth.below(1 - 1.5);
  EXPECT_NEAR(spread.mean(0)[1], pi * below, 1e-14);
  EXPECT_NEAR(spread.mean(2)[1], pi * below, 1e-14);
  EXPECT_NEAR(spread.mean(0)[0], pi / 16 * smooth.below(0.5), 1e-14);
  EXPECT_NEAR(spread.mean()[1], pi, 1e-14);

  Composition<2> whole(unit_layers, GrainArea::centre);
  whole.add(packing.grains, packing.frame);
  whole.add(packing.grains, packing.frame);
  EXPECT_NEAR(whole.mean(1)[1], pi, 1e-14);
  EXPECT_EQ(whole.mean(0)[1], 0);
  EXPECT_TRUE(std::isnan(phi_large(whole.mean(2))));
}

}  // namespace
}  // namespace grseg
