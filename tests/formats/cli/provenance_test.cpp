// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/cli/provenance.hpp"

#include "formats/core/version.hpp"
#include "formats/trajectory/digest.hpp"
#include "tests/folder.hpp"
#include "tests/three_grains.hpp"

#include <gtest/gtest.h>

namespace grseg {
namespace {

constexpr PresetOption presets[] = {{"layer", "4dS", "1dS"}};
constexpr ToolInfo with_presets{"grseg-a", "", "", "", presets};
constexpr ToolInfo without_presets{"grseg-b", "", "", ""};

class Provenance : public TestInFolder {
 protected:
  std::string three_grains_file() const
  {
    three_grains::write(path("run.h5"), 2);
    return path("run.h5");
  }
};

TEST_F(Provenance, ATableOfARunNamesProgramPresetCommandsAndTheDigestOfItsInput)
{
  const TrajectoryReader run(three_grains_file());
  const std::string digest = "xxh3 " + format_digest(run.digest());
  const Header expected{{"program", std::string("grseg-a ") + version()},
                        {"preset", "paper"},
                        {"history", "three grains by hand"},
                        {"history", "grseg-a x.h5"},
                        {"input", digest},
                        {"bed", "grains 3, sizes 2, crc32 e6b1d670"}};
  EXPECT_EQ(provenance(with_presets, "paper", run, "grseg-a x.h5"), expected);
}

TEST_F(Provenance, AToolWithoutPresetsHasNoLineOnThem)
{
  const TrajectoryReader run(three_grains_file());
  const auto header = provenance(without_presets, "none", run, "grseg-b x.h5");
  ASSERT_EQ(header.size(), 5u);
  EXPECT_EQ(header[0].second, std::string("grseg-b ") + version());
  EXPECT_EQ(header[1].first, "history");
}

Table with_header(const Header& header)
{
  Table table;
  table.header = header;
  return table;
}

TEST_F(Provenance, ValuesOfSeveralTablesAreListedOnceInTheirOrder)
{
  const auto a = with_header({{"input", "2"}, {"history", "first"}, {"input", "1"}});
  const auto b = with_header({{"input", "3"}, {"input", "2"}});
  EXPECT_EQ(header_values(a, "input"), (std::vector<std::string>{"2", "1"}));
  EXPECT_EQ(header_values(std::vector{a, b}, "input"), (std::vector<std::string>{"2", "1", "3"}));
  EXPECT_TRUE(header_values(std::vector{a, b}, "absent").empty());
  EXPECT_EQ(header_or(a, "input", "none"), "2");
  EXPECT_EQ(header_or(a, "absent", "none"), "none");
}

TEST_F(Provenance, SettingsAreWhatIsLeftWhenSourcesAreTakenAway)
{
  const auto table = with_header({{"program", "p"},
                                  {"preset", "none"},
                                  {"history", "h"},
                                  {"input", "i"},
                                  {"bed", "b"},
                                  {"doubt", "d"},
                                  {"verified", "all"},
                                  {"incomplete", "r"},
                                  {"layer", "1"},
                                  {"base", "half"}});
  EXPECT_EQ(settings_of(table), (Header{{"preset", "none"}, {"layer", "1"}, {"base", "half"}}));
}

// In floating point, 2.2 - 2 is 0.20000000000000018, and 1.4 times 5 mm are 0.0069999999999999993 m.
TEST(Setting, IsTheSameUpToRoundOff)
{
  EXPECT_TRUE(same_setting("0.20000000000000001", "0.20000000000000018"));
  EXPECT_TRUE(same_setting("0.0069999999999999993", "0.0070000000000000001"));
  EXPECT_TRUE(same_setting("radius 0.1 0.30000000000000004", "radius 0.1 0.3"));
  EXPECT_TRUE(same_setting("SE 3e-06, AM 1.2e-05", "SE 3.0000000000000001e-06, AM 1.2e-05"));
  EXPECT_TRUE(same_setting("contact-point", "contact-point"));
  EXPECT_FALSE(same_setting("1.25", "1.2500004"));
  EXPECT_FALSE(same_setting("size", "half"));
  EXPECT_FALSE(same_setting("radius 0.1", "radius 0.1 0.3"));
  EXPECT_FALSE(same_setting("radius 0.1 0.3", "radius 0.1"));
  EXPECT_FALSE(same_setting("", "0"));
  EXPECT_FALSE(same_setting("unknown", "0.5"));
  EXPECT_FALSE(same_setting("nan", "0.5"));
  EXPECT_TRUE(same_setting("radius nan 0.3", "radius nan 0.3"));
}

class InputTables : public TestInFolder {};

std::size_t number_of_tables(const std::vector<std::string>& paths)
{
  po::variables_map values;
  values.insert({"input", po::variable_value(boost::any(paths), false)});
  return read_tables(values, {{""}, ""}).size();
}

TEST_F(InputTables, AreThoseThatTheCommandLineNames)
{
  EXPECT_EQ(number_of_tables({put("a.tsv", "a\n1\n"), put("b.tsv", "a\n2\n")}), 2u);
}

TEST_F(InputTables, StandardInputCanBeReadOnce)
{
  EXPECT_THROW(number_of_tables({"-", "-"}), UsageError);
}

TEST_F(InputTables, WhatIsMadeOfThemSaysOfEachOnceWhatWasNotVerified)
{
  const auto all = with_header({{"verified", "all"}});
  const auto some = with_header({{"verified", "no (--trust)"}, {"incomplete", "run.h5.part"}});
  EXPECT_EQ(trust_of({all, all}), (Header{{"verified", "all"}}));
  EXPECT_EQ(trust_of({all, some, some}),
            (Header{{"verified", "no (--trust)"}, {"incomplete", "run.h5.part"}}));
  EXPECT_EQ(trust_of({with_header({})}), Header{});
  const HeaderLine undecided{"undecided", "gravity: why"}, waived{"waived", "overlap: how deep"};
  EXPECT_EQ(trust_of({with_header({waived, undecided}), with_header({undecided})}),
            (Header{undecided, waived}));
}

}  // namespace
}  // namespace grseg
