// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/cli/table.hpp"

#include "formats/cli/readable_table.hpp"
#include "formats/core/errors.hpp"
#include "formats/core/version.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace grseg {
namespace {

Table sample()
{
  Table table;
  table.header = {{"program", "grseg-stress 0.1.0"}, {"layer", "0.02"}, {"history", "a: b"}};
  table.columns = {"t0[s]", "A_SS_xx[N m]", "n_SS"};
  table.rows = {{0, 1.0 / 3, 7}, {1.25, -1e-300, std::nan("")}};
  return table;
}

std::string complaint(const std::string& text)
{
  try {
    Table::parse(text, "t.tsv");
  } catch (const FormatError& error) {
    return error.what();
  }
  return "no complaint";
}

TEST(Table, AsJsonSeparatesSettingsInputsAndHistory)
{
  auto table = sample();
  table.header.insert(table.header.begin(), {{"input", "xxh3 1"}, {"history", "first \"word\""}});
  EXPECT_EQ(table.to_json(),
            "{\"columns\":[\"t0[s]\",\"A_SS_xx[N m]\",\"n_SS\"],"
            "\"rows\":[[0.0,0.3333333333333333,7.0],[1.25,-1e-300,null]],"
            "\"settings\":{\"program\":\"grseg-stress 0.1.0\",\"layer\":\"0.02\"},"
            "\"inputs\":[\"xxh3 1\"],\"history\":[\"first \\\"word\\\"\",\"a: b\"]}\n");
}

TEST(Table, ReadsBackEveryBitOfWhatItPrints)
{
  const auto read = Table::parse(sample().to_text(), "t.tsv");
  EXPECT_EQ(read.header, sample().header);
  EXPECT_EQ(read.columns, sample().columns);
  EXPECT_EQ(read.rows[0], sample().rows[0]);
  EXPECT_EQ(read.rows[1][1], -1e-300);
  EXPECT_TRUE(std::isnan(read.rows[1][2]));
  EXPECT_EQ(read.to_text(), sample().to_text());
}

TEST(Table, FindsColumnsByNameWithoutUnit)
{
  EXPECT_EQ(sample().column("A_SS_xx"), 1u);
  EXPECT_FALSE(sample().has_column("A_SS"));
  EXPECT_THROW(sample().column("A_SS"), FormatError);
}

TEST(Table, HeaderNumbersAreNumbers)
{
  EXPECT_EQ(sample().header_number("layer"), 0.02);
  EXPECT_THROW(sample().header_number("program"), FormatError);
  EXPECT_THROW(sample().header_text("slope"), FormatError);
}

/// Sample table as this version of grseg writes it.
Table own_sample()
{
  auto table = sample();
  table.header[0].second = "grseg-stress " + version();
  return table;
}

bool is_refused(const std::string& text)
{
  return complaint(text).starts_with("t.tsv: ");
}

TEST(Table, EndsWithTheNumberOfItsRowsAndAChecksumOfAllBytesBefore)
{
  Table table;
  table.header = {{"key", "value"}};
  table.columns = {"a", "b[m]"};
  table.rows = {{1, 2}};
  // `xxhsum -H3` prints the same digits for the lines before the last one.
  EXPECT_EQ(table.to_text(), "# key: value\na\tb[m]\n1\t2\n# end: 1 rows, xxh3 a0f2a9fc4c5d84f7\n");
  EXPECT_EQ(complaint(table.to_text()), "no complaint");
}

TEST(Table, ThatChangedInASingleBitIsRefused)
{
  const auto text = own_sample().to_text();
  ASSERT_EQ(complaint(text), "no complaint");
  for (std::size_t byte = 0; byte < text.size(); ++byte)
    for (int bit = 0; bit < 8; ++bit) {
      auto damaged = text;
      damaged[byte] = static_cast<char>(damaged[byte] ^ (1 << bit));
      EXPECT_TRUE(is_refused(damaged)) << "byte " << byte << ", bit " << bit;
    }
}

TEST(Table, ThatWasCutIsRefusedWhereverItWasCut)
{
  const auto text = own_sample().to_text();
  for (std::size_t length = 0; length < text.size(); ++length)
    EXPECT_TRUE(is_refused(text.substr(0, length))) << length;
  const auto end = text.find("# end: ");
  EXPECT_EQ(complaint(text.substr(0, end)),
            "t.tsv: does not end with the line '# end: N rows, xxh3 ...' of every table of "
            "grseg-stress " +
                version() +
                "; it is truncated or damaged, make it again (a table made by hand has no line "
                "'# program: ...')");
}

TEST(Table, InWhichLinesWereRepeatedOrRemovedIsRefused)
{
  const auto text = own_sample().to_text();
  const auto row = text.find("\n1.25") + 1, end = text.find("# end: ");
  const auto last_row = text.substr(row, end - row);
  EXPECT_EQ(complaint(text.substr(0, end) + last_row + text.substr(end)),
            "t.tsv: has 3 rows, but ends with '# end: 2 rows, xxh3 " +
                text.substr(text.size() - 17, 16) + "'; it is damaged, make it again");
  EXPECT_TRUE(is_refused(text.substr(0, row) + text.substr(end)));
  EXPECT_TRUE(is_refused(text + last_row));
  EXPECT_TRUE(is_refused(text + text.substr(end)));
  EXPECT_TRUE(is_refused(text + "\n"));
  EXPECT_TRUE(is_refused(text + text));
}

TEST(Table, MadeByHandNeedsNoEndButIsCheckedWhereItHasOne)
{
  const std::string text = "# a remark\n# layer: 0.02\nt0\tV[m^2]\n0\t1\n";
  const auto table = Table::parse(text, "t.tsv");
  EXPECT_TRUE(table.made_by_hand());
  EXPECT_EQ(table.header_text("verified"), "no, made by hand");
  EXPECT_EQ(complaint(text + end_line(text, 1) + "\n"), "no complaint");
  EXPECT_EQ(complaint(text + end_line("another", 1) + "\n"),
            "t.tsv: does not agree with the checksum in its last line: it was changed or damaged "
            "after it was written; make it again");
}

TEST(Table, OfAProgramNeedsAnEnd)
{
  for (const char* program : {"grseg-fit 0.1.0", "grseg-fit 1.0.0", "another"})
    EXPECT_EQ(complaint("# program: " + std::string(program) + "\nt0\n1\n"),
              "t.tsv: does not end with the line '# end: N rows, xxh3 ...' of every table of " +
                  std::string(program) +
                  "; it is truncated or damaged, make it again (a table made by hand has no line "
                  "'# program: ...')");
}

TEST(Table, OfWindowsIsRefusedWithTheRemedy)
{
  EXPECT_EQ(complaint("a\tb\r\n1\t2\r\n"),
            "t.tsv: its lines end as on Windows (CR LF); convert it with dos2unix");
  EXPECT_EQ(complaint("\xef\xbb\xbf"
                      "a\tb\n1\t2\n"),
            "t.tsv: begins with a byte order mark; save it as UTF-8 without BOM");
}

TEST(Table, HoldsPlainTextOnly)
{
  EXPECT_EQ(complaint(std::string("a\tb\n1\t\0\n", 8)),
            "t.tsv: line 2: '\\x00' is not plain text (UTF-8); the table is damaged");
  EXPECT_EQ(complaint("# key: \x1b[2J\na\n1\n"),
            "t.tsv: line 1: '# key: \\x1b[2J' is not plain text (UTF-8); the table is damaged");
  EXPECT_EQ(complaint("# key: \xcf\x86\na\n1\n"), "no complaint");
}

TEST(Table, NamesEachColumnOnce)
{
  EXPECT_EQ(complaint("a[m]\ta[s]\n1\t2\n"), "t.tsv: line 1: two columns are called 'a'");
  EXPECT_EQ(complaint("a\t\n1\t2\n"),
            "t.tsv: line 1: '' should be the name of a column, such as V[m^2]");
  for (const char* name : {"a[m", "a]", "a[m]x", "[m]"})
    EXPECT_TRUE(is_refused(std::string(name) + "\n1\n")) << name;
}

TEST(Table, OfAbsurdLinesIsRefusedWithAShortSentence)
{
  EXPECT_EQ(complaint(std::string(1 << 20, '\t') + "\n"),
            "t.tsv: line 1: 1048577 columns are too many");
  EXPECT_LT(complaint("a\n" + std::string(1 << 20, 'x') + "\n").size(), 120u);
}

TEST(Table, HoldsDecimalNumbersOnly)
{
  for (const char* number : {"0x10", " 1", "1 ", "1,5", "1e999", "NaN", "nan(1)", "-nan",
                             "infinity", "+1", "1_000", "", "1e", "--1", "."})
    EXPECT_TRUE(is_refused("a\tb\n1\t" + std::string(number) + "\n")) << number;
  for (const char* number :
       {"nan", "inf", "-inf", "1", "-0.5", ".5", "5.", "1e-300", "4.9406564584124654e-324"})
    EXPECT_EQ(complaint("a\tb\n1\t" + std::string(number) + "\n"), "no complaint") << number;
}

TEST(Table, AValueCannotPassForAnotherLine)
{
  auto table = own_sample();
  table.header[2].second = "chute\n# input: xxh3 forged\x1b[2J";
  const auto read = Table::parse(table.to_text(), "t.tsv");
  EXPECT_EQ(read.header.size(), 3u);
  EXPECT_EQ(read.header[2].second, "chute\\x0a# input: xxh3 forged\\x1b[2J");
}

TEST(Table, ThatIsTruncatedIsRefusedWithItsLine)
{
  const auto text = sample().to_text();
  EXPECT_EQ(complaint(text.substr(0, text.size() - 1)),
            "t.tsv: the last line is incomplete; the table is truncated");
  EXPECT_EQ(complaint("a\tb\n1\t2\n3\n"),
            "t.tsv: line 3: 1 columns, but the header names 2; is the table truncated?");
  EXPECT_EQ(complaint("a\tb\n1\tx2\n"), "t.tsv: line 2: 'x2' is not a number");
  EXPECT_EQ(complaint(""), "t.tsv: is empty, not a table");
  EXPECT_EQ(
      complaint("\x89HDF\r\n\x1a\n"),
      "t.tsv: is an HDF5 file, not a table; if it is a run, make its table with grseg-stress");
  EXPECT_EQ(complaint("# only: comments\n"),
            "t.tsv: has no line of column names, so it is not a table");
}

// A terminal is too narrow for all columns. It shows the columns that tell rows apart, then the usual ones.
TEST(ShortTable, ShowsWhichBinAndCellEachRowIs)
{
  for (const std::string names : {"t0\ty0\tx0\tx1\tn_SS\tn_LS", "t0\tx0\tx1\ty0\tphi_L\tu"}) {
    std::string text = names;
    for (int k = 0; k < 20; ++k) text += fmt::format("\tanother_column_{}", k);
    text += "\n0\t1\t2\t3\t4\t5" + std::string(20, '\t') + "\n";
    const auto shown = readable_table(text, 4);
    for (const char* key : {"t0", "x0", "y0"})
      EXPECT_NE(shown.find(key), std::string::npos) << shown;
    EXPECT_EQ(shown.find("another"), std::string::npos) << shown;
  }
}

}  // namespace
}  // namespace grseg
