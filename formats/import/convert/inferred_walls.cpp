// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/import/convert/inferred_walls.hpp"

#include "formats/import/common/frame_tools.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace grseg {
namespace {

/// Relative error of coordinates written as text or in single precision, at most.
constexpr double rounding = 1e-5;
/// Largest difference, over the radius, of the branches of two contacts that count as the same.
constexpr double same_branch = 0.01;

}  // namespace

InferredWalls::InferredWalls(const ImportedBed& bed) : bed_(bed), contacts_of_(bed.walls.size())
{
  for (const auto& wall : bed_.walls) {
    for (const auto& period : bed_.periods)
      if (period.axis == wall.axis)
        throw UsageError(fmt::format(
            "--wall {} ({}): the cell is periodic along {}, so no wall can cross this direction; "
            "leave it out",
            wall.name, wall.place(), "xyz"[wall.axis]));
    const Vec3 direction = bed_.axes.components(Vec3::Unit(wall.axis));
    if (bed_.box.dimension == 2 && std::abs(direction.z()) > 1e-6)
      throw UsageError(
          fmt::format("--wall {} ({}) is parallel to the plane of the flow, --axes; "
                      "leave it out",
                      wall.name, wall.place()));
    planes_.push_back(
        {bed_.components(Vec3::Unit(wall.axis)), wall.position + direction.dot(bed_.shift)});
  }
}

std::vector<Vec3> InferredWalls::missing_forces(const Frame<3>& frame) const
{
  const auto& contacts = frame.contacts;
  std::vector<Vec3> missing = frame.force;
  for (std::size_t g = 0; g < missing.size(); ++g) missing[g] -= bed_.grains.mass[g] * bed_.gravity;
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    missing[row(contacts.i[c])] -= contacts.force[c];
    if (contacts.j[c] >= 0) missing[row(contacts.j[c])] += contacts.force[c];
  }
  return missing;
}

/// The walls that a grain touches. If rounding leaves it open whether they touch, the missing force
/// decides: it must push the grain away from the wall.
auto InferredWalls::touches(const Frame<3>& frame, std::size_t grain, const Vec3& missing) const
    -> std::vector<Touch>
{
  std::vector<Touch> found;
  const auto& x = frame.position[grain];
  const double radius = bed_.grains.radius[grain];
  for (std::size_t w = 0; w < planes_.size(); ++w) {
    const auto& [direction, position] = planes_[w];
    const double height = direction.dot(x) - position;
    const Vec3 normal = height < 0 ? Vec3(-direction) : direction;
    const double doubt =
        rounding * std::max({radius, std::abs(position), std::abs(bed_.walls[w].position)});
    const double gap = std::abs(height) - radius;
    if (gap < -doubt || (gap < doubt && missing.dot(normal) > rounding * largest_force_))
      found.push_back({w, height * direction, normal});
  }
  return found;
}

void InferredWalls::append(Frame<3>& frame, std::size_t grain, const Touch& touch,
                           const Vec3& force)
{
  auto& contacts = frame.contacts;
  contacts.i.push_back(static_cast<std::int32_t>(grain));
  contacts.j.push_back(-static_cast<std::int32_t>(touch.wall) - 1);
  contacts.force.push_back(force);
  contacts.branch.push_back(touch.branch);
  contacts.gap.push_back(touch.branch.norm() - bed_.grains.radius[grain]);
  ++contacts_of_[touch.wall];
  ++contacts_;
  const double pull = -force.dot(touch.normal);
  if (!(pull > 0)) return;
  ++pulling_;
  largest_pull_ = std::max(largest_pull_, pull / largest_force_);
}

void InferredWalls::add(Frame<3>& frame, std::size_t grain, std::vector<Touch> touches,
                        const Vec3& missing)
{
  const auto push = [&](const Touch& touch) { return missing.dot(touch.normal); };
  if (touches.size() > 1) ++at_two_;
  // A wall that would pull exerts no force if another wall pushes.
  std::sort(touches.begin(), touches.end(),
            [&](const Touch& a, const Touch& b) { return push(a) > push(b); });
  while (touches.size() > 1 && !(push(touches.back()) > 0)) touches.pop_back();
  if (touches.size() == 1) return append(frame, grain, touches.front(), missing);
  double pushes = 0;
  Vec3 rest = missing;
  for (const auto& touch : touches) {
    pushes += push(touch);
    rest -= push(touch) * touch.normal;
  }
  for (const auto& touch : touches)
    append(frame, grain, touch, push(touch) * touch.normal + push(touch) / pushes * rest);
}

/// The largest magnitude of a contact force or weight in the frame.
double InferredWalls::largest_force(const Frame<3>& frame) const
{
  double largest = 0;
  for (const auto& force : frame.contacts.force) largest = std::max(largest, force.norm());
  for (std::size_t g = 0; g < bed_.grains.size(); ++g)
    if (is_mobile(bed_.grains, frame, g))
      largest = std::max(largest, bed_.grains.mass[g] * bed_.gravity.norm());
  return largest;
}

void InferredWalls::add_to(Frame<3>& frame)
{
  if (frame.force.empty())
    throw UsageError(
        "--wall: the archive has no forces on grains, from which wall forces could be inferred; "
        "dump them (fx fy fz), or the contacts with walls themselves (--wall-contacts)");
  auto& contacts = frame.contacts;
  std::multimap<std::size_t, std::size_t> already;  // grain -> the archive's contacts with walls
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    if (contacts.j[c] >= 0) continue;
    contacts.j[c] -= static_cast<std::int32_t>(planes_.size());
    already.emplace(row(contacts.i[c]), c);
  }
  const auto already_there = [&](std::size_t grain, const Touch& touch) {
    const auto [from, to] = already.equal_range(grain);
    return std::any_of(from, to, [&](const auto& grain_at_wall) {
      return (contacts.branch[grain_at_wall.second] - touch.branch).norm() <
             same_branch * bed_.grains.radius[grain];
    });
  };
  const auto missing = missing_forces(frame);
  largest_force_ = largest_force(frame);
  inferred_.assign(bed_.grains.size(), 0);
  std::size_t here = 0;
  for (std::size_t g = 0; g < bed_.grains.size(); ++g) {
    if (!is_mobile(bed_.grains, frame, g)) continue;
    auto found = touches(frame, g, missing[g]);
    std::erase_if(found, [&](const Touch& touch) { return already_there(g, touch); });
    if (found.empty()) continue;
    add(frame, g, std::move(found), missing[g]);
    inferred_[g] = 1;
    ++here;
  }
  fewest_ = frames_ == 0 ? here : std::min(fewest_, here);
  most_ = std::max(most_, here);
  ++frames_;
}

std::vector<std::string> InferredWalls::remarks() const
{
  std::vector<std::string> remarks{
      fmt::format("forces of {} are inferred from the force balance of the grains "
                  "that touch them, so this balance checks nothing",
                  list_of(bed_.walls))};
  if (contacts_ > 0)
    remarks.push_back(fmt::format("number of grains that touch these walls in a frame: {} to {}",
                                  fewest_, most_));
  if (at_two_ > 0)
    remarks.push_back(fmt::format(
        "{1} times a grain touches more than one of these walls ({0} contacts in all): the "
        "friction of each wall is unknown and is divided in proportion to the normal forces",
        contacts_, at_two_));
  if (pulling_ > 0)
    remarks.push_back(fmt::format(
        "{} of these {} contacts pull, the strongest by {:.2g} of the largest force of its frame",
        pulling_, contacts_, largest_pull_));
  for (std::size_t w = 0; w < bed_.walls.size(); ++w)
    if (contacts_of_[w] == 0)
      remarks.push_back(
          fmt::format("no grain ever touches the wall {} ({}), and the archive has no "
                      "contacts with it either: is its position correct?",
                      bed_.walls[w].name, bed_.walls[w].place()));
  return remarks;
}

}  // namespace grseg
