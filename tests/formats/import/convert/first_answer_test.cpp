// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/formats/import/lammps_text.hpp"

#include <gtest/gtest.h>

/// The import asks all questions at once, including questions whose answers depend on others.
namespace grseg {
namespace {

using namespace lammps_text;

/// Two discs of one size, none at rest; the lowest point of both is at y = -0.02.
class FirstAnswer : public testing::Test {
 protected:
  Folder folder;

  ImportSettings moving_discs() const
  {
    auto s = settings(
        folder,
        block("ATOMS", 0, grain_columns,
              {"1 1 1 0.005 0.05 -0.015 1 0 0 0 -10", "2 1 1 0.005 0.05 -0.005 1.1 0 0 0 -10"}),
        block("ENTRIES", 0, "index i j fx fy", {"1 1 2 0 0"}));
    s.species.boundary.reset();
    s.slope = 0;
    return s;
  }
};

// One frame in which all grains are at rest does not show which grains stay at rest later.
TEST_F(FirstAnswer, SaysWhereAFlowWithoutABaseBegins)
{
  auto s = moving_discs();
  folder.write("atoms.dump", block("ATOMS", 0, grain_columns,
                                   {"1 1 1 0.005 0.05 -0.015 0 0 0 0 -10",
                                    "2 1 1 0.005 0.05 -0.005 0 0 0 0 -10"}));
  EXPECT_TRUE(mentions(refusal(s).sentence,
                       "which grains are the base: --boundary TYPES  (or --boundary none --origin "
                       "-0.02; type 1: 2 grains"));
}

TEST_F(FirstAnswer, AsksForTheOriginBesideTheSpecies)
{
  auto s = moving_discs();
  s.species.boundary = "none";
  const auto asked = refusal(s).sentence;
  EXPECT_TRUE(mentions(asked, "how species differ"));
  EXPECT_TRUE(mentions(asked, "y = 0: --origin -0.02"));
}

TEST_F(FirstAnswer, AsksForTheStepUnlessTheTimeBetweenFramesIsTold)
{
  auto s = moving_discs();
  s.step.reset();
  EXPECT_TRUE(mentions(refusal(s).sentence, "--step DT"));
  s.interval = 0.01;
  EXPECT_FALSE(mentions(refusal(s).sentence, "--step"));
}

}  // namespace
}  // namespace grseg
