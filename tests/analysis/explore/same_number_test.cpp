// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/explore/settings.hpp"

#include <gtest/gtest.h>

namespace grseg {
namespace {

TEST(CommandsOf, DefaultsAreLeftOut)
{
  ExploreSettings settings;
  settings.partition.filters.heights = "inside";
  const auto commands = commands_of("run.h5", nullptr, settings, 0);
  EXPECT_EQ(commands["sums"], "grseg-stress run.h5");
  EXPECT_EQ(commands["file"], "sums.tsv");
  EXPECT_EQ(commands["fit"], "");
}

TEST(CommandsOf, EveryOptionThatChangesTheNumberIsPassedToTheToolThatUsesIt)
{
  ExploreSettings settings;
  settings.frames.layer = "2dS";
  settings.frames.windows = {2.5, 1.0, 9.5, 3};
  settings.frames.grouping = {{"S=1", "L=2,3"}, 0, ""};
  settings.frames.trust.trust = true;
  settings.partition.filters.heights = "4dS:";
  settings.component = "pressure";
  settings.base = "half";
  const auto made = commands_of("my run.h5", nullptr, settings, 2);
  EXPECT_EQ(made["sums"],
            "grseg-stress 'my run.h5' --layer 2dS --window 2.5 --begin 1 --end 9.5 --stride 3 "
            "--group S=1 --group L=2,3 --trust");
  EXPECT_EQ(made["file"], "sums-2.tsv");
  EXPECT_EQ(made["fit"], " --heights 4dS: --component pressure --base-part half");
  Table given;
  given.name = "kept.tsv";
  const auto of_table = commands_of("my run.h5", &given, settings, 1);
  EXPECT_EQ(of_table["sums"], "");
  EXPECT_EQ(of_table["file"], "kept.tsv");
  EXPECT_EQ(of_table["fit"],
            " --begin 1 --end 9.5 --heights 4dS: --component pressure --base-part half");
}

}  // namespace
}  // namespace grseg
