// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/import/mercury/mercury_tables.hpp"

#include "formats/cli/words.hpp"
#include "formats/import/common/text_values.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <utility>

namespace grseg {
namespace {

constexpr double most = std::numeric_limits<std::int32_t>::max();  // largest number of grains
constexpr const char* removed =
    "MercuryDPM moves the last row to the place of a grain that it removes, so rows no longer "
    "identify grains; import the .restart files instead, which have ids "
    "(restartFile.setFileType(FileType::MULTIPLE_FILES); --restart 'run.restart.*')";

void add_period(const MercuryRestart& restart, ArchiveFrame& frame)
{
  for (int axis = 0; axis < 3; ++axis) {
    if (!restart.periodic[static_cast<std::size_t>(axis)]) continue;
    frame.periodic[static_cast<std::size_t>(axis)] = true;
    frame.low[axis] = restart.low[axis];
    frame.high[axis] = restart.high[axis];
  }
}

}  // namespace

MercuryData::MercuryData(std::vector<std::string> files, std::string restart_path,
                         bool info_is_species)
    : source_(std::move(files)),
      restart_path_(std::move(restart_path)),
      info_is_species_(info_is_species)
{
  if (!restart_path_.empty())
    restart_ = read_mercury_restart(restart_path_, MercuryBlocks::up_to_particles);
}

bool MercuryData::next(ArchiveFrame& frame)
{
  do {
    if (!source_.next()) return false;
  } while (words_of(source_.line()).empty());
  ArchiveFrame now;
  now.place = source_.place();
  if (!source_.line_is_whole()) source_.fail_at_end("a header");
  read_numbers(source_, numbers_);
  const auto h = numbers_;
  plane_ = h.size() == 6;
  if (!plane_ && h.size() != 8)
    source_.fail(
        fmt::format("{} numbers, but a block of .data begins with 6 (2D) or 8 (3D)", h.size()));
  if (h[0] < 0 || !is_whole(h[0], most))
    source_.fail(fmt::format("{:g} is not the number of grains", h[0]));
  now.time = h[1];
  now.low = plane_ ? Vec3(h[2], h[3], 0) : three(h, 2);
  now.high = plane_ ? Vec3(h[4], h[5], 0) : three(h, 5);
  for (auto rows = static_cast<std::size_t>(h[0]); rows > 0; --rows) {
    if (!source_.next() || !source_.line_is_whole()) source_.fail_at_end("a block of grains");
    read_row(now.grains);
  }
  require_rows_that_name_grains(now);
  last_radius_ = now.grains.radius;
  if (restart_) {
    add_restart_facts(now.place, now.grains);
    add_period(*restart_, now);
  }
  frame = std::move(now);
  return true;
}

void MercuryData::read_row(ArchiveGrains& grains)
{
  read_numbers(source_, numbers_);
  const auto& row = numbers_;
  const auto columns = row.size();
  const Vec3 no_spin = Vec3::Zero();
  const auto add = [&](const Vec3& x, const Vec3& v, double radius, const Vec3& spin, double info) {
    grains.id.push_back(static_cast<std::int64_t>(grains.id.size()));
    grains.position.push_back(x);
    grains.velocity.push_back(v);
    grains.angular_velocity.push_back(spin);
    grains.radius.push_back(radius);
    if (info_is_species_) grains.type.push_back(static_cast<std::int32_t>(std::lround(info)));
  };
  if (plane_ && (columns == 8 || columns == 10))
    add({row[0], row[1], 0}, {row[2], row[3], 0}, row[4], {0, 0, -row[6]}, row[7]);
  else if (!plane_ && columns == 8)  // format 7: y and z are exchanged
    add({row[0], row[2], row[1]}, {row[3], row[5], row[4]}, row[6], no_spin, row[7]);
  else if (!plane_ && columns >= 14 && columns <= 17)
    add(three(row, 0), three(row, 3), row[6], three(row, 10), row[columns % 2 == 0 ? 13 : 14]);
  else
    source_.fail(fmt::format("a row of {} numbers below a header of {}; .data has {}", columns,
                             plane_ ? 6 : 8, plane_ ? "8 or 10" : "8, or 14 to 17"));
}

void MercuryData::require_rows_that_name_grains(const ArchiveFrame& frame) const
{
  const auto fail = [&](const std::string& why) {
    throw FormatError(fmt::format("{}: {}: {}", frame.place, why, removed));
  };
  const auto& radius = frame.grains.radius;
  const auto now = radius.size(), before = last_radius_.size();
  if (now < before) fail(fmt::format("{}, but {} before", counted(now, "grain"), before));
  for (std::size_t g = 0; g < before; ++g)
    if (std::abs(radius[g] - last_radius_[g]) > 1e-5 * last_radius_[g])
      fail(fmt::format("row {} has the radius {:g}, but {:g} before", g, radius[g],
                       last_radius_[g]));
  if (!restart_ || restart_->ids_are_rows()) return;
  if (restart_->removes_grains || now != restart_->particles.size() ||
      (before > 0 && now != before))
    fail(fmt::format("grains were removed, as the ids in {} show", restart_path_));
}

void MercuryData::add_restart_facts(const std::string& place, ArchiveGrains& grains) const
{
  if (restart_->particles.size() < grains.size())
    throw FormatError(fmt::format("{}: {}, but only {} in {}; name the last .restart of the run",
                                  place, counted(grains.size(), "grain"),
                                  restart_->particles.size(), restart_path_));
  for (std::size_t g = 0; g < grains.size(); ++g) {
    const auto& particle = restart_->particles[g];
    if (std::abs(particle.radius - grains.radius[g]) > 1e-5 * particle.radius)
      throw FormatError(fmt::format(
          "{}: grain {} has the radius {:g}, but {:g} in {}; are they from the same run?", place, g,
          grains.radius[g], particle.radius, restart_path_));
    grains.fixed.push_back(particle.inverse_mass == 0);
    grains.mass.push_back(restart_->mass_of(particle));
    if (!info_is_species_) grains.type.push_back(particle.species);
  }
}

bool MercuryFStat::next_line()
{
  while (source_.next())
    if (!words_of(source_.line()).empty()) return true;
  return false;
}

/// Reads the header: "# t 1" and two more comments. The number behind the time t is not used: 1 if
/// cx cy cz are the contact point, 0 (old files) if they are the middle of the two centres.
void MercuryFStat::read_header()
{
  const auto words = words_of(source_.line());
  const std::string text(words.size() > 1 ? words[1] : "");
  char* end = nullptr;
  time = std::strtod(text.c_str(), &end);
  if (words.empty() || words[0] != "#" || text.empty() || *end != '\0' || !std::isfinite(time))
    source_.fail(
        fmt::format("{}, but a block of .fstat begins with '# time 1'", in_quotes(source_.line())));
  for (int k = 0; k < 2; ++k) {
    if (!next_line() || !source_.line_is_whole()) source_.fail_at_end("a header");
    if (!source_.line().starts_with('#'))
      source_.fail("a row, but a block of .fstat begins with three lines of comments");
  }
}

bool MercuryFStat::next()
{
  if (!waiting_ && !next_line()) return false;
  waiting_ = false;
  contacts.clear();
  place = source_.place();
  if (!source_.line_is_whole()) source_.fail_at_end("a header");
  read_header();
  for (std::size_t line = 4; next_line(); ++line) {
    if (source_.line().starts_with('#')) {
      waiting_ = true;
      return true;
    }
    if (!source_.line_is_whole()) source_.fail_at_end("a row of forces");
    read_numbers(source_, numbers_);
    const auto& r = numbers_;
    if (r.size() != 16)
      source_.fail(fmt::format("a row of {} numbers, but .fstat has 16", r.size()));
    if (!is_whole(r[1], most) || !is_whole(r[2], most))
      source_.fail("columns 2 and 3 are not numbers of particles");
    contacts.push_back({static_cast<std::int64_t>(r[1]), static_cast<std::int64_t>(r[2]), r[6],
                        r[8], r[9], three(r, 10), three(r, 13), line});
  }
  return true;
}

MercuryRestarts::MercuryRestarts(std::vector<std::string> files)
    : files_(std::move(files)), restart_(read_mercury_restart(files_[0], MercuryBlocks::all))
{
}

bool MercuryRestarts::next(ArchiveFrame& frame)
{
  if (at_ == files_.size()) return false;
  const Vec3 gravity = restart_.gravity;
  if (at_ > 0) restart_ = read_mercury_restart(files_[at_], MercuryBlocks::all);
  ++at_;
  if (!(restart_.gravity - gravity).isZero(1e-12 * gravity.norm()))
    throw FormatError(
        fmt::format("{}: gravity is ({:g} {:g} {:g}), but ({:g} {:g} {:g}) in the previous file; "
                    "import the files of each gravity separately",
                    files_[at_ - 1], restart_.gravity.x(), restart_.gravity.y(),
                    restart_.gravity.z(), gravity.x(), gravity.y(), gravity.z()));
  frame = ArchiveFrame{};
  frame.time = restart_.time;
  frame.place = files_[at_ - 1];
  frame.low = restart_.domain_low;
  frame.high = restart_.domain_high;
  add_period(restart_, frame);
  auto& grains = frame.grains;
  for (const auto& particle : restart_.particles) {
    grains.id.push_back(particle.id);
    grains.type.push_back(particle.species);
    grains.radius.push_back(particle.radius);
    grains.mass.push_back(restart_.mass_of(particle));
    grains.fixed.push_back(particle.inverse_mass == 0);
    grains.position.push_back(particle.position);
    grains.velocity.push_back(particle.velocity);
    grains.angular_velocity.push_back(particle.angular_velocity);
    if (restart_.positional == 0) grains.force.push_back(particle.force);
  }
  return true;
}

}  // namespace grseg
