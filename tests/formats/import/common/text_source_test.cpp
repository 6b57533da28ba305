// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/import/common/text_source.hpp"

#include "formats/core/errors.hpp"
#include "formats/import/common/archive_files.hpp"
#include "tests/formats/import/lammps_text.hpp"

#include <boost/iostreams/copy.hpp>
#include <boost/iostreams/device/array.hpp>
#include <boost/iostreams/device/back_inserter.hpp>
#include <boost/iostreams/filter/bzip2.hpp>
#include <boost/iostreams/filter/gzip.hpp>
#include <boost/iostreams/filter/lzma.hpp>
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
  EXPECT_EQ(lines_of({folder.write("a.bz2", packed(text, io::bzip2_compressor()))}), lines);
  EXPECT_EQ(lines_of({folder.write("a.xz", packed(text, io::lzma_compressor()))}), lines);
  EXPECT_EQ(lines_of({folder.write("a.zst", packed(text, io::zstd_compressor()))}), lines);
}

TEST_F(Text, BeginsBehindAByteOrderMark)
{
  const auto a = folder.write("a",
                              "\xef\xbb\xbf"
                              "1\n2\n");
  EXPECT_EQ(lines_of({a, a}), (std::vector<std::string>{"1", "2", "1", "2"}));
}

TEST_F(Text, OfConcatenatedPackedFilesIsReadToTheEnd)
{
  const std::vector<std::string> both{"first", "second"};
  const auto lines_of_two = [&](const auto& filter) {
    return lines_of({folder.write("a", packed("first\n", filter) + packed("second\n", filter))});
  };
  EXPECT_EQ(lines_of_two(io::gzip_compressor()), both);
  EXPECT_EQ(lines_of_two(io::bzip2_compressor()), both);
  EXPECT_EQ(lines_of_two(io::lzma_compressor()), both);
  EXPECT_EQ(lines_of_two(io::zstd_compressor()), both);
  const std::string skipped("\x50\x2a\x4d\x18\x04\0\0\0size", 12);  // as pzstd writes it
  const auto in_frames = skipped + packed("first\n", io::zstd_compressor()) + skipped +
                         packed("second\n", io::zstd_compressor());
  EXPECT_EQ(lines_of({folder.write("a", in_frames)}), both);
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

TEST_F(Text, ThatIsPackedAndCutAnywhereIsRefused)
{
  std::string text;
  for (int k = 0; k < 30000; ++k) text += fmt::format("{}\n", 1.0 / (k + 1));
  const auto expect_refusals = [&](const auto& filter, const std::string& name) {
    const auto whole = packed(text, filter);
    for (const auto cut : {whole.size() / 100, whole.size() / 2, whole.size() - 1})
      EXPECT_TRUE(mentions(complaint_about(folder.write(name, whole.substr(0, cut))),
                           "the compressed data is damaged or truncated"))
          << name << ", " << cut << " of " << whole.size();
  };
  expect_refusals(io::gzip_compressor(), "a.gz");
  expect_refusals(io::bzip2_compressor(), "a.bz2");
  expect_refusals(io::lzma_compressor(), "a.xz");
  expect_refusals(io::zstd_compressor(), "a.zst");
}

TEST_F(Text, WithoutLinesIsNoText)
{
  EXPECT_TRUE(mentions(complaint_about(folder.write("noise", std::string(3 << 20, 'x'))),
                       "line 1: the line is longer than a megabyte"));
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
