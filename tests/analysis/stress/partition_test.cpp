// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/stress/partial_stress.hpp"
#include "analysis/stress/partition_rule.hpp"
#include "formats/core/errors.hpp"
#include "tests/analysis/synthetic_sums.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <string>
#include <vector>

namespace grseg {
namespace {

using synthetic::any_tensor;
using synthetic::neutral_sums;
using synthetic::stress_table;

/// A large grain of radius 2 presses on a small one of radius 1. They overlap by 0.3, so the
/// contact point is 2 - 0.15 from the large grain's centre, on a branch of 2.7.
ContactSums<2> one_mixed_contact()
{
  const Vec2 force{-0.5, 3}, branch{0, 2.7};
  ContactSums<2> sums;
  sums.volume = 10;
  sums.content[1] = 4;
  sums.content[0] = 1;
  sums.of(PairSum::whole, 0) = force * branch.transpose();
  sums.of(PairSum::by_size, 0) = 2.0 / 3 * sums.of(PairSum::whole, 0);
  sums.of(PairSum::up_to_contact, 0) = 1.85 / 2.7 * sums.of(PairSum::whole, 0);
  sums.of(PairSum::by_power, 0) = 4.0 / 5 * sums.of(PairSum::whole, 0);  // Q = 2
  return sums;
}

void expect_share_of_large(const std::string& rule, double share)
{
  const auto stress = partial_stress(one_mixed_contact(), parse_rule(rule));
  // sigma_yy = f_y l_y / V = 3 x 2.7 / 10, sigma_xy = f_x l_y / V.
  EXPECT_NEAR(stress.large()(1, 1), share * 0.81, 1e-15) << rule;
  EXPECT_NEAR(stress.small()(1, 1), (1 - share) * 0.81, 1e-15) << rule;
  EXPECT_NEAR(stress.large()(0, 1), share * -0.135, 1e-15) << rule;
  EXPECT_NEAR(stress.total(1, 1), 0.81, 1e-15) << rule;
}

std::string sentence_of(const std::string& rule)
{
  try {
    parse_rule(rule);
  } catch (const UsageError& error) {
    return error.what();
  }
  return "";
}

TEST(Partition, BySizeTheLargeGrainGetsItsPartOfTheRadii)
{
  expect_share_of_large("size", 2. / 3);
}

TEST(Partition, ByContactPointTheBranchIsCutWhereTheGrainsTouchAsInMercuryCG)
{
  expect_share_of_large("contact-point", 1.85 / 2.7);
}

TEST(Partition, HalfGivesBothTheSameAsStressPerAtomInLammps)
{
  expect_share_of_large("half", 0.5);
}

TEST(Partition, UniformGivesTheLargeGrainTheStatedShare)
{
  expect_share_of_large("uniform:0.8", 0.8);
  expect_share_of_large("uniform:0", 0);
  expect_share_of_large("uniform:1", 1);
}

TEST(Partition, PowerTwoSharesByTheAreasOfTheGrains)
{
  expect_share_of_large("power:2", 0.8);
}

TEST(Partition, DropLeavesMixedContactsToNobodyAsAGroupOfContinuumChunk)
{
  const auto stress = partial_stress(one_mixed_contact(), parse_rule("drop"));
  EXPECT_EQ(stress.large(), Tensor2::Zero());
  EXPECT_EQ(stress.small(), Tensor2::Zero());
  EXPECT_NEAR(stress.total(1, 1), 0.81, 1e-15);
}

TEST(Partition, BaseContactsGoToTheMobileGrainAsFarAsTheChosenBaseSays)
{
  ContactSums<2> sums;
  sums.volume = 1;
  sums.of(OwnSum::base, 0) = 2 * any_tensor();
  sums.of(OwnSum::whole_base, 0) = 6 * any_tensor();
  sums.of(OwnSum::base, 1) = 3 * any_tensor();
  sums.of(OwnSum::whole_base, 1) = 5 * any_tensor();
  const auto small = [&](BasePart base) { return partial_stress(sums, {}, base).small(); };
  const auto large = [&](BasePart base) { return partial_stress(sums, {}, base).large(); };
  EXPECT_EQ(small(BasePart::contact_point), 2 * any_tensor());
  EXPECT_EQ(large(BasePart::contact_point), 3 * any_tensor());
  EXPECT_EQ(small(BasePart::half), 3 * any_tensor());
  EXPECT_EQ(large(BasePart::half), 2.5 * any_tensor());
  EXPECT_EQ(small(BasePart::none), Tensor2::Zero());
  EXPECT_EQ(large(BasePart::none), Tensor2::Zero());
}

TEST(Partition, PartialStressesAddUpToTheStressForEveryRuleButDrop)
{
  ContactSums<2> sums = one_mixed_contact();
  sums.of(OwnSum::inside, 0) = 1.7 * any_tensor();
  sums.of(OwnSum::inside, 1) << 3.1, 0.2, -0.3, 4.4;
  sums.of(OwnSum::base, 0) = 0.9 * any_tensor().transpose();
  sums.of(OwnSum::base, 1) = 0.3 * any_tensor();
  sums.of(OwnSum::whole_base, 0) = 1.1 * any_tensor();
  sums.of(OwnSum::whole_base, 1) = 0.7 * any_tensor();
  const auto defect = [&](const char* rule, BasePart base) {
    const auto stress = partial_stress(sums, parse_rule(rule), base);
    return (stress.small() + stress.large() - stress.total).norm() / stress.total.norm();
  };
  for (const auto base : {BasePart::contact_point, BasePart::half, BasePart::none}) {
    for (const char* rule : {"size", "contact-point", "half", "uniform:0.37", "power:2"})
      EXPECT_LT(defect(rule, base), 1e-12) << rule;
    EXPECT_GT(defect("drop", base), 0.05);
  }
}

TEST(Partition, SharesOfPartsAtTheGrainsCentresAreTakenWhereEachGrainIs)
{
  ContactSums<2> sums = one_mixed_contact();
  sums.of(OwnSum::inside, 0) = sums.of(OwnSum::inside, 1) = 100 * any_tensor();
  sums.at_centres = true;
  sums.of(OwnSum::halves, 0) = 1.5 * any_tensor();
  sums.of(OwnSum::halves, 1) = 2.5 * any_tensor();
  sums.of(PairSum::at_larger, 0) = 10 * any_tensor();
  sums.of(PairSum::at_smaller, 0) = 20 * any_tensor();
  const auto stress = partial_stress(sums, parse_rule("uniform:0.8"), BasePart::none);
  EXPECT_LT((stress.large() - (2.5 + 8) / sums.volume * any_tensor()).norm(), 1e-14);
  EXPECT_LT((stress.small() - (1.5 + 4) / sums.volume * any_tensor()).norm(), 1e-14);
  EXPECT_LT((stress.total - stress.large() - stress.small()).norm(), 1e-14);
}

TEST(Partition, ATableOfGrainsWithoutTheirHalvesIsRefusedForEveryRule)
{
  auto table = stress_table({{0, 1, 1, one_mixed_contact()}});
  for (const char* name : {"ML", "MS"})
    for (const char* component : {"_xx[N m]", "_xy[N m]", "_yx[N m]", "_yy[N m]"}) {
      table.columns.push_back(std::string(name) + component);
      table.rows[0].push_back(1);
    }
  for (const char* rule : {"size", "half"}) try {
      const ContactSumsReader reader(table, {parse_rule(rule)});
      ADD_FAILURE() << "the table was read for " << rule;
    } catch (const FormatError& error) {
      EXPECT_STREQ(
          error.what(),
          "sums.tsv: a table of grseg-stress has no column 'HSS_xx'; make the table again with grseg-stress "
          "--assign grain");
    }
}

TEST(Partition, InTheVolumeOfTheGrainsStressIsLargerByOneOverTheSolidFraction)
{
  const auto sums = neutral_sums(0.3, 2, 0.8);
  const auto bulk = partial_stress(sums, {}, BasePart::none, StressVolume::bulk);
  const auto solid = partial_stress(sums, {}, BasePart::none, StressVolume::solid);
  EXPECT_NEAR(solid.total(1, 1) / bulk.total(1, 1), 1 / 0.8, 1e-14);
  EXPECT_NEAR(solid.small()(1, 1) / bulk.small()(1, 1), 1 / 0.8, 1e-14);
  EXPECT_NEAR(solid.large()(1, 1) / bulk.large()(1, 1), 1 / 0.8, 1e-14);
}

// Staron & Phillips (2015): if contacts ignore type, psi_L = phi_L, so nothing segregates.
TEST(Partition, NeutralContactsSharedBySizeLoadEachSpeciesByItsConcentration)
{
  for (const double r : {1.0, 2.0, 3.5})
    for (double phi = 0.02; phi < 1; phi += 0.07) {
      const auto stress = partial_stress(neutral_sums(phi, r), {});
      EXPECT_NEAR(stress.large()(1, 1) / stress.total(1, 1), phi, 1e-12);
      EXPECT_NEAR(stress.small()(0, 1) / stress.total(0, 1), 1 - phi, 1e-12);
      EXPECT_EQ(neutral_b({}, r, phi), 0);
    }
}

TEST(Partition, NeutralContactsSharedOtherwiseShowTheBOfTheClosedForm)
{
  for (const char* text : {"uniform:0.8", "uniform:0.6", "uniform:0.5", "half", "power:1"})
    for (double phi = 0.02; phi < 1; phi += 0.07) {
      auto sums = neutral_sums(phi, 2);
      sums.of(PairSum::by_power, 0) = sums.of(PairSum::by_size, 0);  // Q = 1
      const auto stress = partial_stress(sums, parse_rule(text));
      const double psi = stress.large()(1, 1) / stress.total(1, 1);
      EXPECT_NEAR(neutral_b(parse_rule(text), 2, phi), (psi - phi) / (phi * (1 - phi)), 1e-12)
          << text;
    }
}

// By hand for size ratio 2: (P - 2/3) 3/(1 + phi_S).
TEST(Partition, TheNeutralBOfFourFifthsIsThreeTenthsHalfWay)
{
  EXPECT_NEAR(neutral_b(parse_rule("uniform:0.8"), 2, 0.5), (0.8 - 2. / 3) * 2, 1e-15);
  EXPECT_NEAR(neutral_b(parse_rule("half"), 2, 1), (0.5 - 2. / 3) * 3, 1e-15);
  EXPECT_TRUE(std::isnan(neutral_b(parse_rule("drop"), 2, 0.5)));
}

TEST(PartitionRule, NamesAreWhatIsTyped)
{
  for (const char* text :
       {"size", "contact-point", "half", "drop", "uniform:0.66667", "power:-1.5"})
    EXPECT_EQ(parse_rule(text).name(), text);
  const auto rules = parse_rules({"size,uniform:0.8", "half"});
  ASSERT_EQ(rules.size(), 3u);
  EXPECT_EQ(rules[1].name(), "uniform:0.8");
  EXPECT_EQ(rules[2].name(), "half");
}

TEST(PartitionRule, StockStandsForThoseOfPublishedCodes)
{
  const auto rules = parse_rules({"stock,uniform:0.8"});
  ASSERT_EQ(rules.size(), 5u);
  for (std::size_t k = 0; k < 4; ++k) EXPECT_NE(rules[k].used_by(), "") << rules[k].name();
  EXPECT_EQ(rules[2].name(), "half");
  EXPECT_EQ(rules[0].used_by(), "grseg, Staron & Phillips 2015");
  EXPECT_EQ(rules[1].used_by(), "MercuryDPM coarse graining; YADE, PFC stress per body");
  EXPECT_EQ(rules[2].used_by(), "LAMMPS, LIGGGHTS compute stress/atom, also of a group");
  EXPECT_EQ(rules[3].used_by(),
            "sums over pairs within one species (contact lists filtered by type)");
  EXPECT_EQ(rules[4].used_by(), "");
}

// Every listed word can be typed, and the share of a rule at nominal sizes is the share of its contacts.
TEST(PartitionRule, TheListOfRulesIsWhatParsingKnows)
{
  EXPECT_EQ(list_of_rules("or"), "size, contact-point, half, drop, uniform:P or power:Q");
  for (const auto& definition : rule_definitions()) {
    const bool takes_number = *definition.number != '\0';
    const auto rule = parse_rule(std::string(definition.word) + (takes_number ? ":0.25" : ""));
    EXPECT_EQ(rule.kind, definition.kind) << definition.word;
    EXPECT_EQ(&rule.definition(), &definition) << definition.word;
    EXPECT_EQ(rule.adds_up(), definition.kind != PartitionRule::Kind::drop) << definition.word;
  }
}

// Radii 2 and 1; the contact point lies at 0.7 of the branch.
TEST(PartitionRule, TheShareOfAContactFollowsFromRadiiAndContactPoint)
{
  const auto share = [](const char* text) {
    const auto rule = parse_rule(text);
    return rule.definition().share({2, 1, 0.7}, rule.value);
  };
  EXPECT_NEAR(share("size"), 2. / 3, 1e-15);
  EXPECT_EQ(share("contact-point"), 0.7);
  EXPECT_EQ(share("half"), 0.5);
  EXPECT_EQ(share("uniform:0.8"), 0.8);
  EXPECT_NEAR(share("power:3"), 8. / 9, 1e-15);
  EXPECT_NEAR(share("power:-1"), 1. / 3, 1e-15);
  EXPECT_NEAR(share("power:0"), 1. / 2, 1e-15);
}

TEST(NeutralContacts, AllEndsAndNominalSharesAreThoseOfTheModel)
{
  EXPECT_NEAR(neutral_ends_of_large(0.5, 2), 1. / 3, 1e-15);
  EXPECT_NEAR(neutral_zero_share(2), 2. / 3, 1e-15);
  for (const char* text : {"size", "contact-point", "power:1"})
    EXPECT_NEAR(nominal_share(parse_rule(text), 3), 0.75, 1e-15) << text;
  EXPECT_TRUE(std::isnan(nominal_share(parse_rule("drop"), 3)));
}

TEST(PartitionRule, WrongTextIsAnsweredWithTheNearestRule)
{
  EXPECT_NE(sentence_of("siez").find("did you mean size?"), std::string::npos);
  EXPECT_NE(sentence_of("contactpoint").find("did you mean contact-point?"), std::string::npos);
  EXPECT_NE(sentence_of("uniform").find("takes a number"), std::string::npos);
  EXPECT_NE(sentence_of("half:0.5").find("takes no number"), std::string::npos);
  EXPECT_NE(sentence_of("uniform:1.2").find("between 0 and 1"), std::string::npos);
  EXPECT_NE(sentence_of("uniform:0,8").find("not a number"), std::string::npos);
  EXPECT_NE(sentence_of("power:nan").find("not a number"), std::string::npos);
  EXPECT_NE(sentence_of("uniform:").find("not a number"), std::string::npos);
  EXPECT_NE(sentence_of("").find("choose size"), std::string::npos);
  EXPECT_THROW(parse_rules({"size,,half"}), UsageError);
  EXPECT_THROW(choose("point", "--base-part", base_parts), UsageError);
}

/// Tables of two dimensions are read with zeros in z.
Tensor2 in_plane(const Tensor3& tensor)
{
  EXPECT_EQ(tensor.col(2).norm() + tensor.row(2).norm(), 0);
  return tensor.topLeftCorner<2, 2>();
}

TEST(ContactSumsReader, AStressIsTheSameThroughTheTableAndBack)
{
  ContactSums<2> sums = one_mixed_contact();
  sums.of(OwnSum::inside, 0) = any_tensor() / 3;
  sums.of(OwnSum::whole_base, 1) = any_tensor() / 7;
  sums.of(OwnSum::base, 1) = any_tensor() / 11;
  const auto table = Table::parse(stress_table({{0, 1, 25, sums}}).to_text(), "sums.tsv");
  const auto power = parse_rule("power:2");
  const auto back = ContactSumsReader(table, {power}).read(0);
  for (const char* text : {"size", "contact-point", "half", "drop", "uniform:0.3", "power:2"}) {
    const auto a = partial_stress(sums, parse_rule(text));
    const auto b = partial_stress(back, parse_rule(text));
    EXPECT_EQ(a.small(), in_plane(b.small())) << text;
    EXPECT_EQ(a.large(), in_plane(b.large())) << text;
    EXPECT_EQ(a.total, in_plane(b.total)) << text;
  }
  EXPECT_EQ(partial_stress(sums, power, BasePart::half, StressVolume::solid).large(),
            in_plane(partial_stress(back, power, BasePart::half, StressVolume::solid).large()));
}

std::string reader_sentence(const Table& table, const std::vector<PartitionRule>& rules)
{
  try {
    ContactSumsReader(table, rules).read(0);
  } catch (const FormatError& error) {
    return error.what();
  }
  return "";
}

// A fit by size also gives p*, for which the stress by uniform:p is needed.
TEST(ContactSumsReader, WhatIsReadDoesNotDependOnTheRules)
{
  auto table = stress_table({{0, 1, 1, one_mixed_contact()}});
  double number = 0;
  for (const char* name : {"HSS", "HLL", "ML", "MS"})
    for (const char* component : {"_xx[N m]", "_xy[N m]", "_yx[N m]", "_yy[N m]"}) {
      table.columns.push_back(std::string(name) + component);
      table.rows[0].push_back(++number);
    }
  const auto half = ContactSumsReader(table, {parse_rule("half")}).read(0);
  const auto size = ContactSumsReader(table, {parse_rule("size")}).read(0);
  EXPECT_TRUE(size.at_centres);
  EXPECT_EQ(size.of(PairSum::at_larger, 0)(1, 1), 12);
  EXPECT_EQ(partial_stress(size, parse_rule("uniform:0.3")).total,
            partial_stress(half, parse_rule("uniform:0.3")).total);
}

TEST(ContactSumsReader, AMissingColumnIsNamedTogetherWithItsRemedy)
{
  auto table = stress_table({{0, 1, 25, one_mixed_contact()}});
  EXPECT_EQ(reader_sentence(table, {parse_rule("power:2")}), "");
  EXPECT_NE(reader_sentence(table, {parse_rule("power:3")}).find("--partition power:3"),
            std::string::npos);
  for (auto& column : table.columns)
    if (column == "Mpower_xx[N m]") column = "other";
  EXPECT_EQ(reader_sentence(table, {parse_rule("size")}), "");
  const auto sentence = reader_sentence(table, {parse_rule("power:2")});
  EXPECT_NE(sentence.find("Mpower_xx"), std::string::npos);
  EXPECT_NE(sentence.find("grseg-stress --partition power:2"), std::string::npos);
  for (auto& column : table.columns)
    if (column == "Mcp_yy[N m]") column = "other";
  EXPECT_NE(reader_sentence(table, {}).find("Mcp_yy"), std::string::npos);
}

TEST(ContactSumsReader, ASumThatIsNotFiniteIsNamedByRowAndColumn)
{
  auto table = stress_table({{0, 1, 25, one_mixed_contact()}});
  table.rows[0][table.column("A_LL_yy")] = std::numeric_limits<double>::quiet_NaN();
  const auto sentence = reader_sentence(table, {});
  EXPECT_NE(sentence.find("row 1"), std::string::npos);
  EXPECT_NE(sentence.find("A_LL_yy"), std::string::npos);
}

}  // namespace
}  // namespace grseg
