// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/import/mercury/mercury_archive.hpp"

#include "formats/import/common/file_list.hpp"
#include "formats/import/mercury/mercury_blocks.hpp"
#include "formats/import/mercury/mercury_contacts.hpp"
#include "formats/import/mercury/mercury_grains.hpp"

#include <fmt/format.h>

#include <cmath>

namespace grseg {
namespace {

constexpr const char* info_is_species = "info=species";

/// Moments of one table that are missing in the other.
struct Unmatched {
  std::size_t count = 0;
  double first = 0;
  void add(double time)
  {
    if (count++ == 0) first = time;
  }
};

void require_later(const ArchiveMoment& moment, std::optional<double>& last)
{
  if (last && *moment.time <= *last)
    throw FormatError(fmt::format(
        "{}: time {:g} comes after time {:g}: times must increase; remove the duplicate moment "
        "(from a restart), or name the files in order of time",
        moment.place, *moment.time, *last));
  last = moment.time;
}

ArchiveFacts facts_of(const MercuryRestart* restart)
{
  ArchiveFacts facts;
  facts.tolerance = 1e-4;
  facts.tolerance_reason = "MercuryDPM writes ten digits";
  if (restart == nullptr) return facts;
  facts.step = restart->step;
  facts.gravity = restart->gravity;
  facts.discs = restart->discs();
  return facts;
}

/// Grains and forces of two tables.
class MercuryTables : public Archive {
 public:
  MercuryTables(std::unique_ptr<MercuryGrainsSource> grains, std::vector<std::string> fstat)
      : grains_(std::move(grains)), fstat_(std::move(fstat)), facts_(facts_of(grains_->restart()))
  {
  }
  const ArchiveFacts& facts() const override { return facts_; }
  bool next(ArchiveMoment& moment) override;
  std::vector<std::string> remarks() const override;

 private:
  bool next_of_both(ArchiveMoment& moment);
  bool same_time(double a, double b) const;

  std::unique_ptr<MercuryGrainsSource> grains_;
  MercuryFStat fstat_;
  ArchiveFacts facts_;
  MercuryForces forces_;
  std::optional<double> last_time_;
  Unmatched grains_alone_, forces_alone_;
  bool any_of_both_ = false;
};

/// Equal to the digits of the text, of which .data and .fstat have ten and old files eight or six.
bool MercuryTables::same_time(double a, double b) const
{
  return std::abs(a - b) <= 2e-6 * std::max(std::abs(a), std::abs(b));
}

/// Advances to the next time in both tables.
bool MercuryTables::next_of_both(ArchiveMoment& moment)
{
  bool more_grains = grains_->next(moment), more_forces = fstat_.next(forces_);
  while (more_grains && more_forces) {
    if (same_time(*moment.time, forces_.time)) return any_of_both_ = true;
    if (*moment.time < forces_.time) {
      grains_alone_.add(*moment.time);
      more_grains = grains_->next(moment);
    } else {
      forces_alone_.add(forces_.time);
      more_forces = fstat_.next(forces_);
    }
  }
  if (any_of_both_) return false;
  if (more_grains) grains_alone_.add(*moment.time);
  if (more_forces) forces_alone_.add(forces_.time);
  if (grains_alone_.count > 0 && forces_alone_.count > 0)
    throw FormatError(fmt::format(
        "no time is in both tables: those of the grains begin with {:.10g}, those of .fstat with {:.10g}; "
        "write both at the same times",
        grains_alone_.first, forces_alone_.first));
  return false;
}

bool MercuryTables::next(ArchiveMoment& moment)
{
  if (!next_of_both(moment)) return false;
  require_later(moment, last_time_);
  add_mercury_contacts(forces_, grains_->restart() != nullptr, moment);
  return true;
}

std::vector<std::string> MercuryTables::remarks() const
{
  std::vector<std::string> remarks;
  const auto add = [&](const Unmatched& alone, const char* has, const char* lacks) {
    if (alone.count > 0)
      remarks.push_back(
          fmt::format("{} moments are in {} but not in {} and are left out, the first at t = {:g}",
                      alone.count, has, lacks, alone.first));
  };
  add(grains_alone_, "the grains' files", ".fstat");
  add(forces_alone_, ".fstat", "the grains' files");
  return remarks;
}

/// .restart files, each with its contacts.
class MercuryRestarts : public Archive {
 public:
  explicit MercuryRestarts(std::vector<std::string> files)
      : grains_(std::move(files)), facts_(facts_of(grains_.restart()))
  {
    facts_.tolerance = 1e-9;
    facts_.tolerance_reason = "MercuryDPM writes fifteen digits into .restart";
  }
  const ArchiveFacts& facts() const override { return facts_; }
  bool next(ArchiveMoment& moment) override;

 private:
  MercuryRestartGrains grains_;
  ArchiveFacts facts_;
  std::optional<double> last_time_;
};

bool MercuryRestarts::next(ArchiveMoment& moment)
{
  if (!grains_.next(moment)) return false;
  require_later(moment, last_time_);
  if (grains_.restart()->positional > 0)
    throw UsageError(fmt::format(
        "{}: a .restart of version {} has no contact forces; give it as --grains and the .fstat of "
        "the run as --contacts",
        grains_.path(), grains_.restart()->positional));
  add_mercury_contacts(*grains_.restart(), grains_.path(), moment);
  return true;
}

/// Files for each moment have numbers behind: run.data.0001.
FileRole role_of(const FileStart& start)
{
  constexpr std::pair<const char*, FileRole> endings[] = {
      {".data", FileRole::grains}, {".fstat", FileRole::contacts}, {".restart", FileRole::restart}};
  const auto name = start.name.substr(0, start.name.find_last_not_of(".0123456789") + 1);
  // Of versions 2 and 3 it stands for .data.
  const bool positional =
      !start.lines.empty() && (start.lines[0].starts_with("restart_version 2") ||
                               start.lines[0].starts_with("restart_version 3"));
  if (name.ends_with(".restart") && positional) return FileRole::grains;
  for (const auto& [ending, role] : endings)
    if (name.ends_with(ending)) return role;
  return FileRole::none;
}

}  // namespace

std::unique_ptr<Archive> open_mercury(const ArchiveFiles& files)
{
  if (!files.columns.empty() && files.columns != info_is_species)
    throw UsageError(
        fmt::format("--columns '{}': the columns of MercuryDPM are known; only {} is accepted",
                    files.columns, info_is_species));
  const bool only_restart = files.grains.empty() && files.contacts.empty();
  if (only_restart && !files.restart.empty())
    return std::make_unique<MercuryRestarts>(archive_files({files.restart}, "--restart"));
  const auto grains = archive_files(files.grains, "--grains");
  const bool of_restart = is_mercury_restart(grains[0]);
  if (of_restart && files.contacts.empty()) return std::make_unique<MercuryRestarts>(grains);

  const auto contacts = archive_files(files.contacts, "--contacts");
  if (of_restart)
    return std::make_unique<MercuryTables>(std::make_unique<MercuryRestartGrains>(grains),
                                           contacts);
  // Of many, the last lists all grains that were ever inserted.
  const auto restart =
      files.restart.empty() ? files.restart : archive_files({files.restart}, "--restart").back();
  return std::make_unique<MercuryTables>(
      std::make_unique<MercuryDataGrains>(grains, restart, files.columns == info_is_species),
      contacts);
}

const ArchiveFormat mercury_format{
    .name = "mercury",
    .open = open_mercury,
    .role = role_of,
    .takes_restart = true,
    .examples =
        "  grseg-import --format mercury --restart 'run.restart.*' --units si -o run.h5\n"
        "  grseg-import --format mercury --grains run.data --contacts run.fstat \\\n"
        "    --restart run.restart --units si -o run.h5\n",
    .notes =
        "  mercury: .restart holds step, gravity, masses, species and the base, and from version\n"
        "  1.0 on (2014) grains and contacts of its moment; the only --columns is info=species\n"};

}  // namespace grseg
