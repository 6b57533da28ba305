// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/import/mercury/mercury_contacts.hpp"

#include <fmt/format.h>

#include <cmath>
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

Vec3 minimum_image(const ArchiveMoment& moment, Vec3 between)
{
  for (int axis = 0; axis < 3; ++axis) {
    if (!moment.periodic[static_cast<std::size_t>(axis)]) continue;
    const double length = moment.high[axis] - moment.low[axis];
    between[axis] -= length * std::round(between[axis] / length);
  }
  return between;
}

/// x - contact point, at a distance of r - overlap.
Vec3 branch_to_wall(const ArchiveMoment& moment, const MercuryRestart& restart,
                    const MercuryRestart::Interaction& row, std::size_t g)
{
  const Vec3 x = moment.grains.position[g];
  const double radius = moment.grains.radius[g];
  if (row.point) {
    const Vec3 arm = minimum_image(moment, x - *row.point);  // r - overlap/2
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
                               : minimum_image(moment, grains.position[i] - grains.position[j]);
  auto& contacts = moment.contacts;
  contacts.i.push_back(row.i);
  contacts.j.push_back(row.wall ? row.i : row.j);
  contacts.wall.push_back(row.wall ? static_cast<std::int32_t>(row.j) : -1);
  contacts.force.push_back(row.force);
  contacts.branch.push_back(branch);
  contacts.overlap.push_back(grains.radius[i] + (row.wall ? 0 : grains.radius[j]) - branch.norm());
}

}  // namespace

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

}  // namespace grseg
