// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/import/common/text_source.hpp"

#include "formats/core/errors.hpp"
#include "formats/import/common/file_list.hpp"
#include "tests/formats/import/lammps_text.hpp"

#include <boost/iostreams/copy.hpp>
#include <boost/iostreams/device/array.hpp>
#include <boost/iostreams/device/back_inserter.hpp>
#include <boost/iostreams/filter/gzip.hpp>
#include <boost/iostreams/filter/zstd.hpp>
#include <boost/iostreams/filtering_stream.hpp>
#include <gtest/gtest.h>

namespace grseg {
namespace {

namespace io = boost::iostreams;
using lammps_text::mentions;

template <class Filter>
std::string packed(const std::string& text, const Filter& filter)
{
  std::string out;
  io::filtering_ostream to;
  to.push(filter);
  to.push(io::back_inserter(out));
  io::copy(io::array_source(text.data(), text.size()), to);
  return out;
}

std::vector<std::string> lines_of(std::vector<std::string> files)
{
  TextSource source(std::move(files));
  std::vector<std::string> lines;
  while (source.next()) lines.emplace_back(source.line());
  return lines;
}

std::string complaint_about(const std::string& file)
{
  try {
    lines_of({file});
  } catch (const ToolError& error) {
    return error.what();
  }
  return "no complaint";
}

class Text : public testing::Test {
 protected:
  lammps_text::Folder folder;
};

TEST_F(Text, IsTheSamePlainAndPacked)
{
  std::string text;
  std::vector<std::string> lines;
  for (int k = 0; k < 300000; ++k) {  // several buffers
    lines.push_back(fmt::format("{} {}", k, 1.0 / (k + 1)));
    text += lines.back() + "\n";
  }
  EXPECT_EQ(lines_of({folder.write("a", text)}), lines);
  EXPECT_EQ(lines_of({folder.write("a.gz", packed(text, io::gzip_compressor()))}), lines);
  EXPECT_EQ(lines_of({folder.write("a.zst", packed(text, io::zstd_compressor()))}), lines);
}

TEST_F(Text, OfConcatenatedPackedFilesIsReadToTheEnd)
{
  const std::vector<std::string> both{"first", "second"};
  const io::gzip_compressor gzip;
  const io::zstd_compressor zstd;
  EXPECT_EQ(lines_of({folder.write("a.gz", packed("first\n", gzip) + packed("second\n", gzip))}),
            both);
  EXPECT_EQ(lines_of({folder.write("a.zst", packed("first\n", zstd) + packed("second\n", zstd))}),
            both);
}

TEST_F(Text, KnowsItsFileAndLine)
{
  const auto a = folder.write("a", "1\r\n2\n"), b = folder.write("b", "3\n4");
  TextSource source({a, b});
  for (const char* line : {"1", "2", "3"}) {
    ASSERT_TRUE(source.next());
    EXPECT_EQ(source.line(), line);
    EXPECT_TRUE(source.line_is_whole());
  }
  EXPECT_EQ(source.place(), b + ", line 1");
  ASSERT_TRUE(source.next());
  EXPECT_EQ(source.line(), "4");
  EXPECT_FALSE(source.line_is_whole()) << "its end is missing";
  EXPECT_FALSE(source.next());
}

std::string with_damage(std::string bytes)
{
  for (std::size_t k = bytes.size() / 2; k < bytes.size() / 2 + 64; ++k) bytes[k] ^= '\x55';
  return bytes;
}

TEST_F(Text, ThatIsPackedAndTruncatedOrDamagedIsRefused)
{
  const std::string at = GRSEG_TEST_INPUTS "/lammps/";
  const auto gzip = lammps_text::read(at + "elastic-atoms.dump.gz");
  const auto zstd = lammps_text::read(at + "elastic-contacts.dump.zst");
  const std::string sentence = "damaged or truncated";
  const auto half = folder.write("a.gz", gzip.substr(0, gzip.size() / 2));
  EXPECT_TRUE(mentions(complaint_about(half), sentence));
  EXPECT_TRUE(mentions(complaint_about(folder.write("b.gz", with_damage(gzip))), sentence));
  EXPECT_TRUE(mentions(complaint_about(folder.write("b.zst", with_damage(zstd))), sentence));
}

// The filter for zstd is silent about a stream that ends early; the line tells.
TEST_F(Text, ThatIsPackedByZstdAndTruncatedEndsInsideALine)
{
  std::string text;
  for (int k = 0; k < 100000; ++k) text += fmt::format("{}\n", k * 31);
  const auto zstd = packed(text, io::zstd_compressor());
  TextSource source({folder.write("a.zst", zstd.substr(0, zstd.size() / 2))});
  std::size_t lines = 0;
  while (source.next()) ++lines;
  EXPECT_LT(lines, 100000u);
  EXPECT_FALSE(source.line_is_whole());
}

TEST_F(Text, WithoutLinesIsNoText)
{
  EXPECT_TRUE(mentions(complaint_about(folder.write("noise", std::string(3 << 20, 'x'))),
                       "line 1: is longer than a megabyte"));
}

TEST_F(Text, FilesThatMatchAStarAreInOrderOfTheirNumbers)
{
  for (const int step : {100, 20, 3}) folder.write(fmt::format("atoms.{}.dump", step), "");
  const std::vector<std::string> ordered{folder / "atoms.3.dump", folder / "atoms.20.dump",
                                         folder / "atoms.100.dump"};
  EXPECT_EQ(archive_files({folder / "atoms.*.dump"}, "--grains"), ordered);
  EXPECT_THROW(archive_files({folder / "contacts.*"}, "--contacts"), UsageError);
  EXPECT_TRUE(natural_less("a007", "a8"));
  EXPECT_FALSE(natural_less("a8", "a007"));
  EXPECT_TRUE(natural_less("a", "a1"));
}

TEST_F(Text, IsQuotedWithoutControlCharacters)
{
  EXPECT_EQ(in_quotes("a\x1b[2J\n"), "'a?[2J?'");
  EXPECT_EQ(in_quotes(std::string(50, 'x')), "'" + std::string(40, 'x') + "...'");
}

}  // namespace
}  // namespace grseg
