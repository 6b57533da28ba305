// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/import/mercury/mercury_archive.hpp"

#include "formats/import/common/file_list.hpp"
#include "formats/import/mercury/mercury_blocks.hpp"
#include "formats/import/mercury/mercury_restart.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <set>

namespace grseg {
namespace {

constexpr const char* info_is_species = "info=species";

/// Blocks of one table that are missing in the other.
struct Unmatched {
  std::size_t count = 0;
  double first = 0;
  void add(double time)
  {
    if (count++ == 0) first = time;
  }
};

class MercuryArchive : public Archive {
 public:
  explicit MercuryArchive(const ArchiveFiles& files);
  const ArchiveFacts& facts() const override { return facts_; }
  bool next(ArchiveMoment& moment) override;
  std::vector<std::string> remarks() const override;

 private:
  bool next_of_both();
  void add_restart_facts(ArchiveGrains& grains) const;
  void fill_contacts(ArchiveMoment& moment) const;
  void add_contact(const MercuryContact& row, const ArchiveMoment& moment,
                   ArchiveContacts& contacts) const;
  [[noreturn]] void fail_at(const MercuryContact& row, const std::string& why) const;

  MercuryData data_;
  MercuryFStat fstat_;
  std::string restart_path_;
  std::optional<MercuryRestart> restart_;
  bool info_is_species_ = false;
  ArchiveFacts facts_;
  MercuryGrains grains_;
  MercuryForces forces_;
  std::optional<double> last_time_;
  Unmatched grains_alone_, forces_alone_;
};

MercuryArchive::MercuryArchive(const ArchiveFiles& files)
    : data_(archive_files(files.grains, "--grains")),
      fstat_(archive_files(files.contacts, "--contacts")),
      restart_path_(files.restart),
      info_is_species_(files.columns == info_is_species)
{
  if (!files.columns.empty() && !info_is_species_)
    throw UsageError(
        fmt::format("--columns '{}': the columns of MercuryDPM are known; only {} is accepted",
                    files.columns, info_is_species));
  facts_.tolerance = 1e-4;
  facts_.tolerance_reason = "MercuryDPM writes ten digits";
  if (restart_path_.empty()) return;
  restart_ = read_mercury_restart(restart_path_);
  facts_.step = restart_->step;
  facts_.gravity = restart_->gravity;
  facts_.discs = restart_->particle_dimensions == 2;
}

/// Advances to the next time in both tables, equal to the digits of the text.
bool MercuryArchive::next_of_both()
{
  bool more_grains = data_.next(grains_), more_forces = fstat_.next(forces_);
  while (more_grains && more_forces) {
    const double a = grains_.time, b = forces_.time;
    if (std::abs(a - b) <= 2e-6 * std::max(std::abs(a), std::abs(b))) return true;
    if (a < b) {
      grains_alone_.add(a);
      more_grains = data_.next(grains_);
    } else {
      forces_alone_.add(b);
      more_forces = fstat_.next(forces_);
    }
  }
  return false;
}

bool MercuryArchive::next(ArchiveMoment& moment)
{
  if (!next_of_both()) return false;
  if (last_time_ && grains_.time <= *last_time_)
    throw FormatError(fmt::format(
        "{}: time {:g} comes after time {:g}: times must increase; remove the duplicate moment "
        "(from a restart), or name the files in order of time",
        grains_.place, grains_.time, *last_time_));
  last_time_ = grains_.time;
  moment = ArchiveMoment{};
  moment.time = grains_.time;
  moment.place = grains_.place;
  moment.low = grains_.low;
  moment.high = grains_.high;
  moment.grains = std::move(grains_.grains);
  if (restart_) add_restart_facts(moment.grains);
  if (info_is_species_)
    for (const double info : grains_.info)
      moment.grains.type.push_back(static_cast<std::int32_t>(std::lround(info)));
  for (int axis = 0; restart_ && axis < 3; ++axis) {
    if (!restart_->periodic[static_cast<std::size_t>(axis)]) continue;
    moment.periodic[static_cast<std::size_t>(axis)] = true;
    moment.low[axis] = restart_->low[axis];
    moment.high[axis] = restart_->high[axis];
  }
  fill_contacts(moment);
  return true;
}

/// Adds what .restart states about the grains.
void MercuryArchive::add_restart_facts(ArchiveGrains& grains) const
{
  if (restart_->particles.size() != grains.size())
    throw FormatError(
        fmt::format("{}: {} grains, but {} in {}; the number of grains must not change",
                    grains_.place, grains.size(), restart_->particles.size(), restart_path_));
  for (std::size_t g = 0; g < grains.size(); ++g) {
    const auto& particle = restart_->particles[g];
    const double r = particle.radius;
    if (std::abs(r - grains.radius[g]) > 1e-5 * r)
      throw FormatError(fmt::format(
          "{}: grain {} has the radius {:g}, but {:g} in {}; are they from the same run?",
          grains_.place, g, grains.radius[g], r, restart_path_));
    const double content =
        *facts_.discs ? std::numbers::pi * r * r : 4 * std::numbers::pi / 3 * r * r * r;
    const bool fixed = particle.inverse_mass == 0;
    grains.fixed.push_back(fixed);
    grains.mass.push_back(fixed ? restart_->density[static_cast<std::size_t>(particle.species)] *
                                      content
                                : 1 / particle.inverse_mass);
    if (!info_is_species_) grains.type.push_back(particle.species);
  }
}

void MercuryArchive::fail_at(const MercuryContact& row, const std::string& why) const
{
  throw FormatError(fmt::format("{}, {} lines on: {}", forces_.place, row.line - 1, why));
}

void MercuryArchive::fill_contacts(ArchiveMoment& moment) const
{
  std::set<std::pair<std::int64_t, std::int64_t>> known;
  const auto grains = static_cast<std::int64_t>(moment.grains.size());
  for (const auto& row : forces_.contacts) {
    if (row.i < 0 || row.i >= grains || row.j >= grains || row.i == row.j)
      fail_at(row, fmt::format("{} and {} are not two of {} grains; are .data and .fstat from "
                               "the same run?",
                               row.i, row.j, grains));
    if (row.j >= 0 && !known.insert(std::minmax(row.i, row.j)).second) continue;
    add_contact(row, moment, moment.contacts);
  }
}

void MercuryArchive::add_contact(const MercuryContact& row, const ArchiveMoment& moment,
                                 ArchiveContacts& contacts) const
{
  const auto& grains = moment.grains;
  const auto i = static_cast<std::size_t>(row.i);
  const bool wall = row.j < 0;
  const double side = wall ? -1 : 1;  // written the other way round
  double reach = grains.radius[i] - row.overlap;
  if (!wall) {
    const auto j = static_cast<std::size_t>(row.j);
    reach += grains.radius[j];
    const double distance = (grains.position[i] - grains.position[j]).norm();
    if (!restart_ && distance > 1.1 * (grains.radius[i] + grains.radius[j]))
      fail_at(row, fmt::format("grains {} and {} touch across a periodic boundary, or are from "
                               "another run; give --restart, which says what is periodic",
                               row.i, row.j));
  }
  contacts.i.push_back(row.i);
  contacts.j.push_back(wall ? row.i : row.j);
  contacts.wall.push_back(wall ? static_cast<std::int32_t>(-row.j - 1) : -1);
  contacts.force.push_back(side *
                           (row.normal_force * row.normal + row.tangential_force * row.tangent));
  contacts.branch.push_back(side * reach * row.normal);
  contacts.overlap.push_back(row.overlap);
}

std::vector<std::string> MercuryArchive::remarks() const
{
  std::vector<std::string> remarks;
  const auto add = [&](const Unmatched& alone, const char* has, const char* lacks) {
    if (alone.count > 0)
      remarks.push_back(
          fmt::format("{} moments are in {} but not in {} and are left out, the first at t = {:g}",
                      alone.count, has, lacks, alone.first));
  };
  add(grains_alone_, ".data", ".fstat");
  add(forces_alone_, ".fstat", ".data");
  return remarks;
}

/// Files for each moment have numbers behind: run.data.0001.
FileRole role_of(const FileStart& start)
{
  constexpr std::pair<const char*, FileRole> endings[] = {
      {".data", FileRole::grains}, {".fstat", FileRole::contacts}, {".restart", FileRole::restart}};
  const auto name = start.name.substr(0, start.name.find_last_not_of(".0123456789") + 1);
  for (const auto& [ending, role] : endings)
    if (name.ends_with(ending)) return role;
  return FileRole::none;
}

}  // namespace

std::unique_ptr<Archive> open_mercury(const ArchiveFiles& files)
{
  return std::make_unique<MercuryArchive>(files);
}

const ArchiveFormat mercury_format{
    .name = "mercury",
    .open = open_mercury,
    .role = role_of,
    .takes_restart = true,
    .examples =
        "  grseg-import --format mercury --grains run.data --contacts run.fstat \\\n"
        "    --restart run.restart --units si -o run.h5\n",
    .notes =
        "  mercury: .restart holds step, gravity, masses, species and the base; the only\n"
        "  --columns is info=species\n"};

}  // namespace grseg
