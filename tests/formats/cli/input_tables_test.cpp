// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/cli/input_tables.hpp"

#include "formats/core/errors.hpp"
#include "tests/folder.hpp"

#include <gtest/gtest.h>

namespace grseg {
namespace {

constexpr ToolInfo info{"grseg-fit", "", "", ""};

class InputTables : public TestInFolder {
 protected:
  std::string file(const std::string& name, const std::string& program) const
  {
    return put(name, program + "a\n1\n");
  }
};

/// What standard error says while the tables are read.
std::string remark(const std::vector<std::string>& paths, bool quiet = false)
{
  po::variables_map values;
  values.insert({"input", po::variable_value(boost::any(paths), false)});
  testing::internal::CaptureStderr();
  EXPECT_EQ(read_tables(info, values, quiet).size(), paths.size());
  return testing::internal::GetCapturedStderr();
}

TEST_F(InputTables, OfOlderVersionsGetOneRemark)
{
  const auto a = file("a.tsv", "# program: grseg-stress 0.1.0\n");
  const auto b = file("b.tsv", "# program: grseg-stress 0.1.0\n");
  EXPECT_EQ(remark({a, b}),
            "grseg-fit: 2 tables of grseg 0.1.0 carry no checksum; make them anew to have them "
            "verified\n");
  EXPECT_EQ(
      remark({a}),
      "grseg-fit: 1 table of grseg 0.1.0 carries no checksum; make it anew to have it verified\n");
  EXPECT_EQ(remark({a, b}, true), "");
}

TEST_F(InputTables, MadeByHandAreReadWithoutARemark)
{
  EXPECT_EQ(remark({file("c.tsv", "")}), "");
}

TEST_F(InputTables, StandardInputCanBeReadOnce)
{
  EXPECT_THROW(remark({"-", "-"}), UsageError);
  testing::internal::GetCapturedStderr();
}

Table with_header(const Header& header)
{
  Table table;
  table.header = header;
  return table;
}

TEST_F(InputTables, WhatIsMadeOfThemSaysOfEachOnceWhatWasNotVerified)
{
  const auto all = with_header({{"verified", "all"}});
  const auto some = with_header({{"verified", "frames only"}, {"incomplete", "run.h5.part"}});
  EXPECT_EQ(trust_of({all, all}), (Header{{"verified", "all"}}));
  EXPECT_EQ(trust_of({all, some, some}),
            (Header{{"verified", "frames only"}, {"incomplete", "run.h5.part"}}));
  EXPECT_EQ(trust_of({with_header({})}), Header{});
  const HeaderLine undecided{"undecided", "gravity: why"}, waived{"waived", "overlap: how deep"};
  EXPECT_EQ(trust_of({with_header({waived, undecided}), with_header({undecided})}),
            (Header{undecided, waived}));
}

}  // namespace
}  // namespace grseg
