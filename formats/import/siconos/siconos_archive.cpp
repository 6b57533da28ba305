// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/core/errors.hpp"
#include "formats/import/common/archive.hpp"
#include "formats/import/common/archive_files.hpp"
#include "formats/import/common/guarded_reading.hpp"
#include "formats/import/siconos/siconos_bodies.hpp"
#include "formats/import/siconos/siconos_table.hpp"
#include "formats/trajectory/hdf5.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

namespace grseg {
namespace {

/// The time steps of a Siconos run, which all have the same length.
struct SiconosSteps {
  double length = 0;       // length of a step, in the archive's unit of time
  std::int64_t every = 1;  // largest number of steps from one written step to the next
  bool has_start = true;   // true: the file contains the state before the first step
};

using namespace siconos;

/// Times of the written steps: the first column of /data/solv.
std::vector<double> solved_times(hid_t file, const std::string& path)
{
  const auto table = table_at(file, "/data/solv", path, written_by);
  table.require(1, 1, true);
  table.require(0, 1, true);
  const auto rows = table.dims()[0], columns = table.dims()[1];
  std::vector<float> values(rows * columns);
  table.read_all(H5T_NATIVE_FLOAT, values.data());
  std::vector<double> times;
  for (hsize_t k = 0; k < rows; ++k) times.push_back(static_cast<double>(values[k * columns]));
  return times;
}

/// The first time of /data/dynamic.
double first_time(hid_t file, const std::string& path)
{
  const auto time = Places(file, "/data/dynamic", path, written_by).time();
  if (!time) throw FormatError(fmt::format("{}: /data/dynamic has no rows; {}", path, written_by));
  return *time;
}

std::string why_not_later(double time, double before)
{
  if (same_time(time, before))
    return "has the time of the previous row: single precision no longer separates two steps; "
           "write fewer steps (output_frequency)";
  return "is not later than the previous row: the file is damaged, or contains two runs";
}

/// Finds the steps. /data/dynamic begins with the time before the first step. /data/solv has a row
/// per written step: the first step, and then every output_frequency-th. If the first rows of a run
/// were removed, so that both begin at the same time, the first two rows of /data/solv determine
/// the step. Throws FormatError if steps differ in length.
SiconosSteps read_siconos_steps(hid_t file, const std::string& path)
{
  const auto solved = solved_times(file, path);
  const double start = first_time(file, path);
  const auto fail = [&path](std::size_t row, const std::string& why) {
    throw FormatError(fmt::format("{}: row {} of /data/solv {}", path, row, why));
  };
  const bool has_start = start < solved[0] && !same_time(start, solved[0]);
  const std::size_t first = has_start ? 0 : 1;
  if (solved.size() <= first)
    fail(0, "is the only one, and the file has no earlier state: the length of a step is unknown");
  double before = has_start ? start : solved[0];
  const double begin = before, rough = solved[first] - begin;
  if (!(rough > 0) || !std::isfinite(rough)) fail(first, why_not_later(solved[first], before));
  const double steps = std::round((solved.back() - begin) / rough);
  SiconosSteps found{(solved.back() - begin) / std::max(1.0, steps), 1, has_start};
  for (std::size_t k = first; k < solved.size(); ++k) {
    const double apart = (solved[k] - before) / found.length, whole = std::round(apart);
    if (whole < 1) fail(k, why_not_later(solved[k], before));
    if (!(std::abs(solved[k] - before - whole * found.length) <
          0.1 * found.length + 2.4e-7 * std::abs(solved[k])))
      fail(k, fmt::format("is not at a multiple of {:.6g} s: the steps differ in length, "
                          "so forces cannot be computed from impulses",
                          found.length));
    found.every = std::max(found.every, static_cast<std::int64_t>(whole));
    before = solved[k];
  }
  return found;
}

using namespace hdf5;
using namespace siconos;

class SiconosArchive : public Archive {
 public:
  SiconosArchive(std::string path, File file)
      : path_(std::move(path)),
        file_(std::move(file)),
        steps_(read_siconos_steps(file_, path_)),
        bodies_(read_siconos_bodies(file_, path_)),
        places_(file_, "/data/dynamic", path_, written_by),
        velocities_(file_, "/data/velocities", path_, "make the run write it (output_velocities)"),
        points_(file_, "/data/cf", path_, "make the run write it (output_contact_forces)")
  {
    wall_.assign(bodies_.all.size(), -1);
    std::int32_t next_wall = 0;
    for (std::size_t b = bodies_.all.size(); b-- > 0;) {  // ids decrease in the order of creation
      const auto& body = bodies_.all[b];
      if (body.radius == 0) wall_[b] = next_wall++;
      if (body.mass > 0) static_mass_per_size_ = body.mass / size_of(body);
    }
    for (const auto& body : bodies_.all) previous_velocity_.push_back(body.velocity);
    facts_.step = steps_.length;
    facts_.discs = bodies_.discs;
    facts_.tolerance = 1e-4;
    facts_.lists_all = false;
    facts_.tolerance_reason =
        "Siconos writes single precision, and its solver stops at a tolerance of its own";
  }

  const ArchiveFacts& facts() const override { return facts_; }

  bool next(ArchiveFrame& frame) override
  {
    while (const auto time = places_.time()) {
      const auto place = places_.rows_of(*time, place_rows_);
      const auto velocity = velocities_.rows_of(*time, velocity_rows_);
      const auto point = points_.rows_of(*time, point_rows_);
      const bool whole = !velocity_rows_.empty();
      const bool follows = knows_state_;
      knows_state_ = follows || whole || steps_.has_start;
      if (whole) {
        frame = ArchiveFrame{};
        frame.time = *time;
        frame.step = std::llround(*time / steps_.length);
        frame.place = fmt::format("{}, t = {:.6g}", path_, *time);
        fill_places(place, frame.grains);
        fill_velocities(*time, velocity, frame.grains);
        fill_contacts(*time, point, frame.grains, frame.contacts);
        enclose_grains(frame);
      }
      previous_time_ = *time;
      if (whole && follows) return true;
    }
    return false;
  }

  std::vector<std::string> remarks() const override
  {
    std::vector<std::string> remarks;
    if (!steps_.has_start)
      remarks.push_back(fmt::format(
          "{}: the first step is left out, because the file does not have the state before it",
          path_));
    if (steps_.every > 1)
      remarks.push_back(fmt::format(
          "{}: only one of up to {} steps was written (output_frequency), so contacts that had "
          "opened in the previous step cannot be recognised: their rows, with an impulse that "
          "acted on no body, are included",
          path_, steps_.every));
    else if (left_out_ > 0)
      remarks.push_back(fmt::format(
          "{}: {} rows of /data/cf repeat a contact that had opened in the previous step, with "
          "an impulse that acted on no body; they are left out",
          path_, left_out_));
    return remarks;
  }

 private:
  double size_of(const SiconosBody& body) const
  {
    return bodies_.discs ? body.radius * body.radius : std::pow(body.radius, 3);
  }

  std::int64_t id_of(std::size_t body) const
  {
    const auto id = bodies_.all[body].id;
    return id > 0 ? id : bodies_.all.back().id - id;
  }

  std::size_t body_of(std::int64_t id, const char* table, hsize_t row) const
  {
    const auto at = std::lower_bound(bodies_.all.begin(), bodies_.all.end(), id,
                                     [](const SiconosBody& b, std::int64_t k) { return b.id < k; });
    if (at == bodies_.all.end() || at->id != id || at->mass == 0)
      throw FormatError(
          fmt::format("{}: row {} of {} names body {}, which is not a mobile body of /data/input",
                      path_, row, table, id));
    return static_cast<std::size_t>(at - bodies_.all.begin());
  }

  bool follows_previous(double time) const
  {
    return std::abs(time - previous_time_ - steps_.length) <
           0.25 * steps_.length + 2.4e-7 * std::abs(time);
  }

  void add_grain(std::size_t body, const Vec3& position, ArchiveGrains& grains)
  {
    const auto& of = bodies_.all[body];
    grain_of_[body] = grains.size();
    grains.id.push_back(id_of(body));
    grains.radius.push_back(of.radius);
    grains.mass.push_back(of.mass > 0 ? of.mass : static_mass_per_size_ * size_of(of));
    grains.fixed.push_back(of.mass == 0);
    grains.position.push_back(position);
    grains.velocity.emplace_back(0, 0, 0);
    grains.angular_velocity.emplace_back(0, 0, 0);
  }

  void fill_places(hsize_t first_row, ArchiveGrains& grains)
  {
    grain_of_.assign(bodies_.all.size(), std::nullopt);
    turned_.assign(bodies_.all.size(), Eigen::Quaterniond::Identity());
    for (std::size_t b = 0; b < bodies_.all.size(); ++b)
      if (bodies_.all[b].mass == 0 && wall_[b] < 0) add_grain(b, bodies_.all[b].position, grains);
    for (std::size_t k = 0; k < place_rows_.size(); ++k) {
      const auto& row = place_rows_[k];
      const auto b = body_of(id_at(row, 1), "/data/dynamic", first_row + k);
      const Vec3 position = vector_at(row, 2);
      if (grain_of_[b]) {  // a continued run writes its initial state again
        if (grains.position[*grain_of_[b]] == position) continue;
        throw FormatError(
            fmt::format("{}: row {} of /data/dynamic: single precision no longer "
                        "separates the times of two steps; write fewer steps",
                        path_, first_row + k));
      }
      add_grain(b, position, grains);
      const auto q = [&row](std::size_t c) { return static_cast<double>(row[5 + c]); };
      turned_[b] = Eigen::Quaterniond(q(0), q(1), q(2), q(3)).normalized();
    }
  }

  void fill_velocities(double time, hsize_t first_row, ArchiveGrains& grains)
  {
    std::vector<Vec3> velocity(bodies_.all.size(), Vec3::Zero());
    for (std::size_t k = 0; k < velocity_rows_.size(); ++k) {
      const auto& row = velocity_rows_[k];
      const auto b = body_of(id_at(row, 1), "/data/velocities", first_row + k);
      velocity[b] = vector_at(row, 2);
      if (!grain_of_[b]) continue;
      grains.velocity[*grain_of_[b]] = velocity[b];
      // Siconos writes angular velocities in the body's own axes.
      grains.angular_velocity[*grain_of_[b]] = turned_[b] * vector_at(row, 5);
    }
    if (steps_.every == 1 && follows_previous(time)) {
      grains.force.assign(grains.size(), Vec3::Zero());
      for (std::size_t b = 0; b < bodies_.all.size(); ++b)
        if (grain_of_[b])
          grains.force[*grain_of_[b]] =
              bodies_.all[b].mass * (velocity[b] - previous_velocity_[b]) / steps_.length;
    }
    previous_velocity_ = std::move(velocity);
  }

  void fill_contacts(double time, hsize_t first_row, const ArchiveGrains& grains,
                     ArchiveContacts& contacts)
  {
    const bool follows = follows_previous(time);
    std::map<std::pair<std::size_t, std::size_t>, std::size_t> known;  // two bodies -> contact
    for (std::size_t k = 0; k < point_rows_.size(); ++k) {
      const auto& row = point_rows_[k];
      const auto first = body_of(id_at(row, first_at), "/data/cf", first_row + k);
      const double radius = bodies_.all[first].radius;
      if (follows && has_opened(row, radius)) {
        ++left_out_;
        continue;
      }
      const auto second = second_body(row, first_row + k, radius);
      if (!grain_of_[first] || (wall_[second] < 0 && !grain_of_[second]))
        throw FormatError(fmt::format(
            "{}: row {} of /data/cf names a body that /data/dynamic does not have at t = {:.6g}",
            path_, first_row + k, time));
      const Vec3 force = vector_at(row, impulse_at) / steps_.length;
      const auto [at, is_new] = known.try_emplace({first, second}, contacts.size());
      if (!is_new) {
        contacts.force[at->second] += force;
        continue;
      }
      const Vec3 x = grains.position[*grain_of_[first]];
      const Vec3 normal = vector_at(row, normal_at).normalized();
      const Vec3 branch = wall_[second] < 0
                              ? Vec3(x - grains.position[*grain_of_[second]])
                              : Vec3(normal * normal.dot(x - vector_at(row, second_point_at)));
      contacts.add(id_of(first), id_of(second), wall_[second], force, branch,
                   radius + bodies_.all[second].radius - branch.norm());
    }
    previous_points_.clear();
    for (const auto& row : point_rows_) previous_points_.emplace(id_at(row, interaction_at), row);
  }

  bool has_opened(const Points::Row& row, double radius) const
  {
    const auto before = previous_points_.find(id_at(row, interaction_at));
    if (before == previous_points_.end()) return false;
    const auto& old = before->second;
    const bool same =
        std::equal(row.begin() + 2, row.begin() + impulse_at, old.begin() + 2) &&
        std::equal(row.begin() + gap_at, row.begin() + reaction_at, old.begin() + gap_at);
    // A row of a contact at rest is also equal to the previous one; so the contact must be moving.
    return same && vector_at(row, velocity_at).norm() * steps_.length > 1e-5 * radius;
  }

  /// The second body of a contact. If a row names one body twice, its partner is the static body on
  /// whose surface the second point lies.
  std::size_t second_body(const Points::Row& row, hsize_t number, double radius) const
  {
    const auto second = id_at(row, second_at);
    if (id_at(row, first_at) != second) return body_of(second, "/data/cf", number);
    const auto found = static_body_at(bodies_, vector_at(row, second_point_at), 0.1 * radius);
    if (!found)
      throw FormatError(fmt::format(
          "{}: row {} of /data/cf is a contact with a static body, but its second point lies on no "
          "static body of /data/input",
          path_, number));
    return *found;
  }

  std::string path_;
  File file_;
  SiconosSteps steps_;
  SiconosBodies bodies_;
  std::vector<std::int32_t> wall_;  // number of the wall, by body; -1: the body is a grain
  double static_mass_per_size_ = 0;
  Places places_;
  Velocities velocities_;
  Points points_;
  ArchiveFacts facts_;

  // The state before the next step, if the file contains it.
  bool knows_state_ = false;
  double previous_time_ = -HUGE_VAL;
  std::vector<Vec3> previous_velocity_;  // velocity by body
  std::unordered_map<std::int64_t, Points::Row> previous_points_;
  std::size_t left_out_ = 0;

  // Rows of the current frame.
  std::vector<Places::Row> place_rows_;
  std::vector<Velocities::Row> velocity_rows_;
  std::vector<Points::Row> point_rows_;
  std::vector<std::optional<std::size_t>> grain_of_;  // row in the frame's grains, by body
  std::vector<Eigen::Quaterniond> turned_;
};

FileRole role_of(const FileStart& start)
{
  return start.groups == std::vector<std::string>{"data"} ? FileRole::grains : FileRole::none;
}

/// Opens the HDF5 file of a run of discs or spheres by Siconos, a contact-dynamics program
/// (siconos.io.mechanics_run 4.4, output_contact_forces). Rows of /data/dynamic, /data/velocities
/// and /data/cf are found by their times, in single precision. `files.grains` names the file.
///
/// * Forces: /data/cf contains impulses of a step on body ds1, so force = impulse / step. The
///   length of a step is not in the file; it follows from /data/solv, which has a row per written
///   step.
/// * Frames: the times of /data/dynamic except the first. A step was solved at each of these times;
///   the initial state has no contacts. If the initial state was removed, the first step is left
///   out instead, and remarks() reports this.
/// * Partners: ds1 == ds2 means that the partner is static: the static disc, box or convex hull on
///   whose surface the row's second point lies. Static discs are grains with `fixed` set. They get
///   the density of the first mobile grain; their negative ids become numbers after the last mobile
///   id. Boxes and hulls are walls, numbered in the order in which they were added.
/// * Points: a sphere and a box may touch at several points; their impulses are added.
/// * Opened contacts: a contact that has just opened is in the table for one more step, with the
///   geometry and relative velocity of the previous step and an impulse that acted on no body. Such
///   rows can be recognised, and are left out, only if every step was written (output_frequency 1).
///   Otherwise they are included, and remarks() reports this.
/// * Force of a grain: m (v - v of the previous step) / step, if every step was written.
///
/// The file does not contain gravity, which is a Python function, nor the units, usually SI.
std::unique_ptr<Archive> open_siconos(const ArchiveFiles& files)
{
  const auto names = archive_files(files.grains, "--grains");
  if (names.size() != 1) throw UsageError("--grains: a Siconos run is one HDF5 file");
  silence();
  return open_guarded(names[0], [&] {
    return std::make_unique<SiconosArchive>(names[0], open_for_reading(names[0]));
  });
}

}  // namespace

const ArchiveFormat siconos_format{
    .name = "siconos",
    .open = open_siconos,
    .role = role_of,
    .takes_contacts = false,
    .takes_columns = false,
    .examples =
        "  grseg-import --format siconos --grains run.hdf5 --units si --gravity 9.81 \\\n"
        "    --slope 10 --cell x:-0.1:0.9 -o run.h5\n",
    .notes = "  siconos: the file of the grains also contains the contacts\n"};

}  // namespace grseg
