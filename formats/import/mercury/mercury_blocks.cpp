// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/import/mercury/mercury_blocks.hpp"

#include "formats/import/common/number_row.hpp"
#include "formats/import/common/text_source.hpp"

#include <fmt/format.h>

#include <cmath>

namespace grseg {
namespace {

/// Moments of the files behind this one must not be lost with --drop-incomplete.
[[noreturn]] void fail_truncated(TextSource& source, const char* what)
{
  const auto place = source.place();
  if (source.next())
    throw FormatError(
        fmt::format("{}: the file ends in {}, and {} goes on; copy it again, or cut the "
                    "incomplete moment off",
                    place, what, source.file()));
  throw TruncatedArchive(
      fmt::format("{}: the archive ends in {}; copy it again, or leave out the incomplete "
                  "moment with --drop-incomplete",
                  place, what));
}

Vec3 three(const std::vector<double>& numbers, std::size_t first)
{
  return {numbers[first], numbers[first + 1], numbers[first + 2]};
}

}  // namespace

void MercuryData::fail(const std::string& why) const
{
  throw FormatError(fmt::format("{}: {}", source_.place(), why));
}

bool MercuryData::next(MercuryGrains& block)
{
  do {
    if (!source_.next()) return false;
  } while (words_of(source_.line()).empty());
  block = {};
  block.place = source_.place();
  if (!source_.line_is_whole()) fail_truncated(source_, "a header");
  read_numbers(source_, numbers_);
  const auto& h = numbers_;
  plane_ = h.size() == 6;
  if (!plane_ && h.size() != 8)
    fail(fmt::format("{} numbers, but a block of .data begins with 6 (2D) or 8 (3D)", h.size()));
  if (h[0] < 0 || h[0] > 2147483647 || std::trunc(h[0]) != h[0])
    fail(fmt::format("{:g} is not a number of grains", h[0]));
  block.time = h[1];
  block.low = plane_ ? Vec3(h[2], h[3], 0) : three(h, 2);
  block.high = plane_ ? Vec3(h[4], h[5], 0) : three(h, 5);
  for (auto rows = static_cast<std::size_t>(h[0]); rows > 0; --rows) {
    if (!source_.next() || !source_.line_is_whole()) fail_truncated(source_, "a block of grains");
    read_row(block);
  }
  return true;
}

void MercuryData::read_row(MercuryGrains& block)
{
  read_numbers(source_, numbers_);
  const auto& row = numbers_;
  const auto columns = row.size();
  auto& grains = block.grains;
  const Vec3 no_spin = Vec3::Zero();
  const auto add = [&](const Vec3& x, const Vec3& v, double radius, const Vec3& spin, double info) {
    grains.id.push_back(static_cast<std::int64_t>(grains.id.size()));
    grains.position.push_back(x);
    grains.velocity.push_back(v);
    grains.angular_velocity.push_back(spin);
    grains.radius.push_back(radius);
    block.info.push_back(info);
  };
  if (plane_ && (columns == 8 || columns == 10))
    add({row[0], row[1], 0}, {row[2], row[3], 0}, row[4], {0, 0, -row[6]}, row[7]);
  else if (!plane_ && columns == 8)  // format 7: y and z change places
    add({row[0], row[2], row[1]}, {row[3], row[5], row[4]}, row[6], no_spin, row[7]);
  else if (!plane_ && (columns == 14 || columns == 16))
    add(three(row, 0), three(row, 3), row[6], three(row, 10), row[13]);
  else if (!plane_ && (columns == 15 || columns == 17))
    add(three(row, 0), three(row, 3), row[6], three(row, 10), row[14]);
  else
    fail(fmt::format("a row of {} numbers below a header of {}; .data has {}", columns,
                     plane_ ? 6 : 8, plane_ ? "8 or 10" : "8, or 14 to 17"));
}

void MercuryFStat::fail(const std::string& why) const
{
  throw FormatError(fmt::format("{}: {}", source_.place(), why));
}

bool MercuryFStat::next_line()
{
  while (source_.next())
    if (!words_of(source_.line()).empty()) return true;
  return false;
}

/// "# t 1" and two more comments; the second number says whether cx cy cz are the contact point (1)
/// or, in old files, the middle of the two centres (0). Neither is needed for anything.
double MercuryFStat::read_header()
{
  const auto words = words_of(source_.line());
  const std::string text(words.size() > 1 ? words[1] : "");
  char* end = nullptr;
  const double time = std::strtod(text.c_str(), &end);
  if (words.empty() || words[0] != "#" || text.empty() || *end != '\0' || !std::isfinite(time))
    fail(
        fmt::format("{}, but a block of .fstat begins with '# time 1'", in_quotes(source_.line())));
  for (int k = 0; k < 2; ++k) {
    if (!next_line() || !source_.line_is_whole()) fail_truncated(source_, "a header");
    if (!source_.line().starts_with('#'))
      fail("a row, but a block of .fstat begins with three lines of comments");
  }
  return time;
}

bool MercuryFStat::next(MercuryForces& block)
{
  if (!waiting_ && !next_line()) return false;
  waiting_ = false;
  block.contacts.clear();
  block.place = source_.place();
  if (!source_.line_is_whole()) fail_truncated(source_, "a header");
  block.time = read_header();
  for (std::size_t line = 4; next_line(); ++line) {
    if (source_.line().starts_with('#')) {
      waiting_ = true;
      return true;
    }
    if (!source_.line_is_whole()) fail_truncated(source_, "a row of forces");
    read_numbers(source_, numbers_);
    const auto& r = numbers_;
    if (r.size() != 16) fail(fmt::format("a row of {} numbers, but .fstat has 16", r.size()));
    if (std::trunc(r[1]) != r[1] || std::trunc(r[2]) != r[2] || std::abs(r[1]) > 2147483647 ||
        std::abs(r[2]) > 2147483647)
      fail("columns 2 and 3 are not numbers of particles");
    block.contacts.push_back({static_cast<std::int64_t>(r[1]), static_cast<std::int64_t>(r[2]),
                              three(r, 3), r[6], r[8], r[9], three(r, 10), three(r, 13), line});
  }
  return true;
}

}  // namespace grseg
