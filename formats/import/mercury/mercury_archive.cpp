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

[[noreturn]] void fail_at(const MercuryFStat& rows, const MercuryContact& row,
                          const std::string& why)
{
  throw FormatError(fmt::format("{}, {} lines on: {}", rows.place, row.line - 1, why));
}

void add_row(const MercuryFStat& rows, const MercuryContact& row, bool period_is_known,
             ArchiveFrame& frame)
{
  const auto& grains = frame.grains;
  const auto i = static_cast<std::size_t>(row.i);
  const bool wall = row.j < 0;
  const auto j = wall ? i : static_cast<std::size_t>(row.j);
  const double side = wall ? -1 : 1;  // at walls MercuryDPM writes the opposite signs
  double reach = grains.radius[i] - row.overlap;
  if (!wall) {
    reach += grains.radius[j];
    const double distance = (grains.position[i] - grains.position[j]).norm();
    if (!period_is_known && distance > 1.1 * (grains.radius[i] + grains.radius[j]))
      fail_at(rows, row,
              fmt::format("grains {} and {} touch across a periodic boundary, or are from another "
                          "run; add --restart, which states the periodic directions",
                          row.i, row.j));
  }
  frame.contacts.add(grains.id[i], grains.id[j], wall ? static_cast<std::int32_t>(-row.j - 1) : -1,
                     side * (row.normal_force * row.normal + row.tangential_force * row.tangent),
                     side * reach * row.normal, row.overlap);
}

/// Branch of a contact with a wall: x - contact point, of length r - overlap.
Vec3 branch_to_wall(const ArchiveFrame& frame, const MercuryRestart& restart,
                    const MercuryRestart::Interaction& row, std::size_t g)
{
  const Vec3 x = frame.grains.position[g];
  const double radius = frame.grains.radius[g];
  if (row.point) {
    const Vec3 arm = frame.minimum_image(x - *row.point);  // its length is r - overlap/2
    return (2 - radius / arm.norm()) * arm;
  }
  const auto wall = restart.walls.find(row.j);
  if (wall == restart.walls.end()) throw FormatError("is with a wall that the file does not list");
  const auto& [kind, position, normal] = wall->second;
  if (!normal || kind != "InfiniteWall")
    throw FormatError(
        fmt::format("is with wall {} ({}), but has no contact point, as in restart files before "
                    "2016; without it the import can only read contacts with an InfiniteWall; "
                    "name the .data and .fstat of the run as well",
                    row.j, kind));
  return -normal->dot(position - x) * *normal;
}

void add_interaction(const MercuryRestart& restart, const MercuryRestart::Interaction& row,
                     const std::unordered_map<std::int64_t, std::size_t>& row_of,
                     ArchiveFrame& frame)
{
  const auto find = [&row_of](std::int64_t id) {
    const auto found = row_of.find(id);
    if (found == row_of.end())
      throw FormatError(fmt::format("names particle {}, which the file does not have", id));
    return found->second;
  };
  const auto& grains = frame.grains;
  const auto i = find(row.i), j = row.wall ? i : find(row.j);
  const Vec3 branch = row.wall ? branch_to_wall(frame, restart, row, i)
                               : frame.minimum_image(grains.position[i] - grains.position[j]);
  frame.contacts.add(row.i, row.wall ? row.i : row.j,
                     row.wall ? static_cast<std::int32_t>(row.j) : -1, row.force, branch,
                     grains.radius[i] + (row.wall ? 0 : grains.radius[j]) - branch.norm());
}

/// Adds the contacts of a block of .fstat, whose grain numbers are rows of `frame`:
/// * Force on i = fn n + ft t, with n from j to i; at a wall n and t have the opposite signs.
/// * Most pairs are in two rows, (i, j) and (j, i); pairs with a fixed grain or across a periodic
///   boundary are in one. Only the first row is used; it has the total force.
/// * Branch = n (r_i + r_j - delta), because x_i - x_j is wrong across a periodic boundary. The
///   contact point of a wall is on its normal through the grain's centre, at the distance r_i -
///   delta.
/// Throws FormatError naming the row if grains and contacts do not match. Unless `period_is_known`,
/// also for a pair that is too far apart to touch.
void add_mercury_contacts(const MercuryFStat& rows, bool period_is_known, ArchiveFrame& frame)
{
  std::set<std::pair<std::int64_t, std::int64_t>> known;
  const auto grains = static_cast<std::int64_t>(frame.grains.size());
  for (const auto& row : rows.contacts) {
    if (row.i < 0 || row.i >= grains || row.j >= grains || row.i == row.j)
      fail_at(rows, row,
              fmt::format("{} and {} are not two of {} grains; are the grains and .fstat from the "
                          "same run?",
                          row.i, row.j, grains));
    if (row.j >= 0 && !known.insert(std::minmax(row.i, row.j)).second) continue;
    add_row(rows, row, period_is_known, frame);
  }
}

/// Adds the contacts of the block Interactions, which names grains of `frame` by their ids.
/// Overlap and branch of two grains follow from their positions.
void add_mercury_contacts(const MercuryRestart& restart, ArchiveFrame& frame)
{
  const auto row_of = rows_by_id(frame.grains);
  for (std::size_t k = 0; k < restart.interactions.size(); ++k) {
    try {
      add_interaction(restart, restart.interactions[k], row_of, frame);
    } catch (const FormatError& error) {
      throw FormatError(fmt::format("{}: interaction {} {}", frame.place, k + 1, error.what()));
    }
  }
}

constexpr const char* info_is_species = "info=species";

class MercuryArchive : public Archive {
 public:
  /// Without .fstat the grains come from .restart files, which also contain the contacts.
  MercuryArchive(std::unique_ptr<MercuryGrains> grains, std::vector<std::string> fstat)
      : grains_(std::move(grains))
  {
    if (!fstat.empty()) forces_.emplace(std::move(fstat));
    facts_.tolerance = forces_ ? 1e-4 : 1e-9;
    facts_.tolerance_reason =
        forces_ ? "MercuryDPM writes ten digits" : "MercuryDPM writes fifteen digits into .restart";
    const auto* restart = grains_->restart();
    if (restart == nullptr) return;
    facts_.step = restart->step;
    facts_.gravity = restart->gravity;
    facts_.discs = restart->discs();
  }
  const ArchiveFacts& facts() const override { return facts_; }
  std::vector<std::string> remarks() const override { return matching_.remarks("t ="); }

  bool next(ArchiveFrame& frame) override
  {
    if (forces_ ? !next_of_both(frame) : !grains_->next(frame)) return false;
    if (last_time_ && *frame.time <= *last_time_)
      throw FormatError(fmt::format(
          "{}: time {:g} comes after time {:g}: times must increase; remove the duplicate frame "
          "(from a restart), or name the files in order of time",
          frame.place, *frame.time, *last_time_));
    last_time_ = frame.time;
    const auto* restart = grains_->restart();
    if (forces_)
      add_mercury_contacts(*forces_, restart != nullptr, frame);
    else if (restart->positional > 0)
      throw UsageError(fmt::format(
          "{}: a .restart of version {} has no contact forces; name it with --grains and the "
          ".fstat of the run with --contacts",
          frame.place, restart->positional));
    else
      add_mercury_contacts(*restart, frame);
    return true;
  }

 private:
  /// Advances to the next time that both tables have. Times are equal to within the digits of the
  /// text: ten in .data and .fstat, eight or six in old files.
  bool next_of_both(ArchiveFrame& frame)
  {
    const auto order = [&] {
      const double a = *frame.time, b = forces_->time;
      if (std::abs(a - b) <= 2e-6 * std::max(std::abs(a), std::abs(b))) return 0;
      return a < b ? -1 : 1;
    };
    const auto text = [](double time) { return fmt::format("{:.10g}", time); };
    return matching_.next({[&] { return grains_->next(frame); }, [&] { return text(*frame.time); }},
                          {[&] { return forces_->next(); }, [&] { return text(forces_->time); }},
                          order);
  }

  std::unique_ptr<MercuryGrains> grains_;
  std::optional<MercuryFStat> forces_;
  ArchiveFacts facts_;
  std::optional<double> last_time_;
  Matching matching_;
};

/// Role of a file by its ending. Files of single frames end in a number: run.data.0001.
FileRole role_of(const FileStart& start)
{
  constexpr std::pair<const char*, FileRole> endings[] = {
      {".data", FileRole::grains}, {".fstat", FileRole::contacts}, {".restart", FileRole::restart}};
  const auto name = start.name.substr(0, start.name.find_last_not_of(".0123456789") + 1);
  // A .restart of version 2 or 3 has no contacts, so it has the role of a .data.
  const bool positional =
      !start.lines.empty() && (start.lines[0].starts_with("restart_version 2") ||
                               start.lines[0].starts_with("restart_version 3"));
  if (name.ends_with(".restart") && positional) return FileRole::grains;
  for (const auto& [ending, role] : endings)
    if (name.ends_with(ending)) return role;
  return FileRole::none;
}

/// Opens a run of MercuryDPM (mercury_tables.hpp, mercury_restart.hpp). It consists of one of three
/// sets of files:
/// * .data (`files.grains`), .fstat (`files.contacts`), and .restart, which states masses, species,
///   fixed grains, gravity, step, discs or spheres and periodic boundaries. Without .restart the
///   command line must state them. The info column is a species only with --columns info=species.
///   There are no forces on grains.
/// * Only .restart files (`files.restart`, or `files.grains`), each of which is a complete frame.
/// * .restart files of versions 3 and 2, which have no contacts, as `files.grains`, and .fstat.
/// Frames of two tables are matched by time; the tables may have different times.
///
/// These files do not state units.
std::unique_ptr<Archive> open_mercury(const ArchiveFiles& files)
{
  if (!files.columns.empty() && files.columns != info_is_species)
    throw UsageError(
        fmt::format("--columns '{}': the format fixes the columns "
                    "of MercuryDPM; only {} is accepted",
                    files.columns, info_is_species));
  const auto archive_of = [](std::unique_ptr<MercuryGrains> grains,
                             std::vector<std::string> fstat) {
    return std::make_unique<MercuryArchive>(std::move(grains), std::move(fstat));
  };
  if (files.grains.empty() && files.contacts.empty() && !files.restart.empty())
    return archive_of(
        std::make_unique<MercuryRestarts>(archive_files({files.restart}, "--restart")), {});
  const auto grains = archive_files(files.grains, "--grains");
  const bool of_restart = is_mercury_restart(grains[0]);
  std::vector<std::string> contacts;
  if (!of_restart || !files.contacts.empty())
    contacts = archive_files(files.contacts, "--contacts");
  if (of_restart) return archive_of(std::make_unique<MercuryRestarts>(grains), contacts);
  // The last .restart lists all grains that were ever inserted.
  const auto restart =
      files.restart.empty() ? files.restart : archive_files({files.restart}, "--restart").back();
  return archive_of(
      std::make_unique<MercuryData>(grains, restart, files.columns == info_is_species), contacts);
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
        "  mercury: .restart files have step, gravity, masses, species and base; since version 1.0\n"
        "  (2014) also grains and contacts of one frame. --columns accepts only info=species\n"};

}  // namespace grseg
