// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/import/common/archive.hpp"
#include "formats/import/common/archive_files.hpp"
#include "formats/import/mercury/mercury_restart.hpp"
#include "formats/import/mercury/mercury_tables.hpp"

#include <fmt/format.h>

#include <cmath>
#include <memory>
#include <set>
#include <unordered_map>

namespace grseg {
namespace {

[[noreturn]] void fail_at(const MercuryForces& rows, const MercuryContact& row,
                          const std::string& why)
{
  throw FormatError(fmt::format("{}, {} lines on: {}", rows.place, row.line - 1, why));
}

void add_row(const MercuryForces& rows, const MercuryContact& row, bool period_is_known,
             ArchiveMoment& moment)
{
  const auto& grains = moment.grains;
  auto& contacts = moment.contacts;
  const auto i = static_cast<std::size_t>(row.i);
  const bool wall = row.j < 0;
  const auto j = wall ? i : static_cast<std::size_t>(row.j);
  const double side = wall ? -1 : 1;  // written the other way round
  double reach = grains.radius[i] - row.overlap;
  if (!wall) {
    reach += grains.radius[j];
    const double distance = (grains.position[i] - grains.position[j]).norm();
    if (!period_is_known && distance > 1.1 * (grains.radius[i] + grains.radius[j]))
      fail_at(rows, row,
              fmt::format("grains {} and {} touch across a periodic boundary, or are from another "
                          "run; give --restart, which says what is periodic",
                          row.i, row.j));
  }
  contacts.i.push_back(grains.id[i]);
  contacts.j.push_back(grains.id[j]);
  contacts.wall.push_back(wall ? static_cast<std::int32_t>(-row.j - 1) : -1);
  contacts.force.push_back(side *
                           (row.normal_force * row.normal + row.tangential_force * row.tangent));
  contacts.branch.push_back(side * reach * row.normal);
  contacts.overlap.push_back(row.overlap);
}

/// x - contact point, at a distance of r - overlap.
Vec3 branch_to_wall(const ArchiveMoment& moment, const MercuryRestart& restart,
                    const MercuryRestart::Interaction& row, std::size_t g)
{
  const Vec3 x = moment.grains.position[g];
  const double radius = moment.grains.radius[g];
  if (row.point) {
    const Vec3 arm = moment.minimum_image(x - *row.point);  // r - overlap/2
    return (2 - radius / arm.norm()) * arm;
  }
  const auto wall = restart.walls.find(row.j);
  if (wall == restart.walls.end()) throw FormatError("is with a wall that the file does not list");
  const auto& [kind, position, normal] = wall->second;
  if (!normal || kind != "InfiniteWall")
    throw FormatError(
        fmt::format("is with wall {} ({}), but does not name the contact point: restart files "
                    "before 2016 do not, and only that of an InfiniteWall follows from the file; "
                    "give the .data and .fstat of the run as well",
                    row.j, kind));
  return -normal->dot(position - x) * *normal;
}

void add_interaction(const MercuryRestart& restart, const MercuryRestart::Interaction& row,
                     const std::unordered_map<std::int64_t, std::size_t>& row_of,
                     ArchiveMoment& moment)
{
  const auto find = [&row_of](std::int64_t id) {
    const auto found = row_of.find(id);
    if (found == row_of.end())
      throw FormatError(fmt::format("names particle {}, which the file does not have", id));
    return found->second;
  };
  const auto& grains = moment.grains;
  const auto i = find(row.i), j = row.wall ? i : find(row.j);
  const Vec3 branch = row.wall ? branch_to_wall(moment, restart, row, i)
                               : moment.minimum_image(grains.position[i] - grains.position[j]);
  auto& contacts = moment.contacts;
  contacts.i.push_back(row.i);
  contacts.j.push_back(row.wall ? row.i : row.j);
  contacts.wall.push_back(row.wall ? static_cast<std::int32_t>(row.j) : -1);
  contacts.force.push_back(row.force);
  contacts.branch.push_back(branch);
  contacts.overlap.push_back(grains.radius[i] + (row.wall ? 0 : grains.radius[j]) - branch.norm());
}

/// The contacts of a block of .fstat, whose rows of grains are those of `moment`:
/// * Force on i = fn n + ft t, n from j to i; at a wall n and t have the opposite signs.
/// * Most pairs stand in two rows, (i, j) and (j, i), those with a fixed grain or across a periodic
///   boundary in one: the first row is used, with its whole force.
/// * Branch = n (r_i + r_j - delta): x_i - x_j is not the branch across a periodic boundary. A
///   wall's contact point is where it cuts its normal through the grain, at r_i - delta.
/// FormatError naming the row where the two do not belong together. Unless `period_is_known`, a
/// pair that is too far apart to touch is refused.
void add_mercury_contacts(const MercuryForces& rows, bool period_is_known, ArchiveMoment& moment)
{
  std::set<std::pair<std::int64_t, std::int64_t>> known;
  const auto grains = static_cast<std::int64_t>(moment.grains.size());
  for (const auto& row : rows.contacts) {
    if (row.i < 0 || row.i >= grains || row.j >= grains || row.i == row.j)
      fail_at(rows, row,
              fmt::format("{} and {} are not two of {} grains; are the grains and .fstat from the "
                          "same run?",
                          row.i, row.j, grains));
    if (row.j >= 0 && !known.insert(std::minmax(row.i, row.j)).second) continue;
    add_row(rows, row, period_is_known, moment);
  }
}

/// The contacts of the block Interactions, between grains of `moment` by their ids. Overlap and
/// branch of two grains are those of their positions. `path` is for sentences.
void add_mercury_contacts(const MercuryRestart& restart, const std::string& path,
                          ArchiveMoment& moment)
{
  std::unordered_map<std::int64_t, std::size_t> row_of;
  for (std::size_t g = 0; g < moment.grains.size(); ++g) row_of.emplace(moment.grains.id[g], g);
  for (std::size_t k = 0; k < restart.interactions.size(); ++k) {
    try {
      add_interaction(restart, restart.interactions[k], row_of, moment);
    } catch (const FormatError& error) {
      throw FormatError(fmt::format("{}: interaction {} {}", path, k + 1, error.what()));
    }
  }
}

constexpr const char* info_is_species = "info=species";

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

  bool next(ArchiveMoment& moment) override
  {
    if (!next_of_both(moment)) return false;
    require_later(moment, last_time_);
    add_mercury_contacts(forces_, grains_->restart() != nullptr, moment);
    return true;
  }

  std::vector<std::string> remarks() const override
  {
    std::vector<std::string> remarks;
    const auto add = [&](const Unmatched& alone, const char* has, const char* lacks) {
      if (alone.count > 0)
        remarks.push_back(fmt::format(
            "{} moments are in {} but not in {} and are left out, the first at t = {:g}",
            alone.count, has, lacks, alone.first));
    };
    add(grains_alone_, "the grains' files", ".fstat");
    add(forces_alone_, ".fstat", "the grains' files");
    return remarks;
  }

 private:
  /// Advances to the next time in both tables.
  bool next_of_both(ArchiveMoment& moment)
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

  /// Equal to the digits of the text, of which .data and .fstat have ten and old files eight or six.
  bool same_time(double a, double b) const
  {
    return std::abs(a - b) <= 2e-6 * std::max(std::abs(a), std::abs(b));
  }

  std::unique_ptr<MercuryGrainsSource> grains_;
  MercuryFStat fstat_;
  ArchiveFacts facts_;
  MercuryForces forces_;
  std::optional<double> last_time_;
  Unmatched grains_alone_, forces_alone_;
  bool any_of_both_ = false;
};

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

  bool next(ArchiveMoment& moment) override
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

 private:
  MercuryRestartGrains grains_;
  ArchiveFacts facts_;
  std::optional<double> last_time_;
};

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

/// Runs of MercuryDPM as its source writes them (mercury_tables.hpp, mercury_restart.hpp), in one of
/// three sets of files:
/// * .data (`files.grains`), .fstat (`files.contacts`), and .restart, which states masses, species,
///   fixed grains, gravity, step, discs or spheres and periodic boundaries. Without it the command
///   line must give them. The info column is a species only where --columns says info=species. No
///   forces on grains.
/// * .restart files alone (`files.restart`, or `files.grains`), each a whole moment.
/// * .restart files of versions 3 and 2, which have no contacts, as `files.grains`, with .fstat.
/// Moments of two tables are matched by time; the two may be saved at different times.
///
/// Not in these files: units.
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

}  // namespace

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
