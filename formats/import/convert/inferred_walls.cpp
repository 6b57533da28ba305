// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/import/convert/inferred_walls.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace grseg {
namespace {

std::size_t row(std::int32_t index)
{
  return static_cast<std::size_t>(index);
}

/// Numbers of text and of grains held in single precision are off by less, over their size.
constexpr double rounding = 1e-5;
/// Contacts of a grain with the same wall have branches that differ by less, over its radius.
constexpr double same_branch = 0.01;

}  // namespace

template <int D>
InferredWalls<D>::InferredWalls(const std::vector<WallPlane>& walls, const ImportedBed& bed,
                                const Vector<D>& gravity)
    : walls_(walls), bed_(bed), gravity_(gravity), contacts_of_(walls.size())
{
  for (const auto& wall : walls_) {
    for (const auto& period : bed_.periods)
      if (period.axis == wall.axis)
        throw UsageError(fmt::format(
            "--wall {} ({}): the cell is periodic along {}, where there can be no wall across; "
            "leave it out",
            wall.name, wall.place(), "xyz"[wall.axis]));
    const Vec3 direction = bed_.axes.components<3>(Vec3::Unit(wall.axis));
    if (D == 2 && std::abs(direction.z()) > 1e-6)
      throw UsageError(
          fmt::format("--wall {} ({}) is parallel to the plane of the flow, --axes; "
                      "leave it out",
                      wall.name, wall.place()));
    planes_.push_back({direction.head<D>(), wall.position + direction.dot(bed_.shift)});
  }
}

template <int D>
std::vector<Vector<D>> InferredWalls<D>::missing_forces(const Frame<D>& frame) const
{
  const auto& contacts = frame.contacts;
  std::vector<Vector<D>> missing = frame.force;
  for (std::size_t g = 0; g < missing.size(); ++g) missing[g] -= bed_.grains.mass[g] * gravity_;
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    missing[row(contacts.i[c])] -= contacts.force[c];
    if (contacts.j[c] >= 0) missing[row(contacts.j[c])] += contacts.force[c];
  }
  return missing;
}

/// Where rounding hides whether they touch, what is missing has to push.
template <int D>
auto InferredWalls<D>::touches(const Frame<D>& frame, std::size_t grain,
                               const Vector<D>& missing) const -> std::vector<Touch>
{
  std::vector<Touch> found;
  const auto& x = frame.position[grain];
  const double radius = bed_.grains.radius[grain];
  for (std::size_t w = 0; w < planes_.size(); ++w) {
    const auto& [direction, position] = planes_[w];
    const double height = direction.dot(x) - position;
    const Vector<D> normal = height < 0 ? Vector<D>(-direction) : direction;
    const double doubt =
        rounding * std::max({radius, std::abs(position), std::abs(walls_[w].position)});
    const double gap = std::abs(height) - radius;
    if (gap < -doubt || (gap < doubt && missing.dot(normal) > rounding * largest_force_))
      found.push_back({w, height * direction, normal});
  }
  return found;
}

template <int D>
void InferredWalls<D>::append(Frame<D>& frame, std::size_t grain, const Touch& touch,
                              const Vector<D>& force)
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

template <int D>
void InferredWalls<D>::add(Frame<D>& frame, std::size_t grain, std::vector<Touch> touches,
                           const Vector<D>& missing)
{
  const auto push = [&](const Touch& touch) { return missing.dot(touch.normal); };
  if (touches.size() > 1) ++at_two_;
  // Those that would pull get nothing as long as another pushes.
  std::sort(touches.begin(), touches.end(),
            [&](const Touch& a, const Touch& b) { return push(a) > push(b); });
  while (touches.size() > 1 && !(push(touches.back()) > 0)) touches.pop_back();
  if (touches.size() == 1) return append(frame, grain, touches.front(), missing);
  double pushes = 0;
  Vector<D> rest = missing;
  for (const auto& touch : touches) {
    pushes += push(touch);
    rest -= push(touch) * touch.normal;
  }
  for (const auto& touch : touches)
    append(frame, grain, touch, push(touch) * touch.normal + push(touch) / pushes * rest);
}

/// Contacts with walls that the frame already has, by grain.
template <int D>
auto InferredWalls<D>::renumber(ContactList<D>& contacts) const -> std::vector<GrainAtWall>
{
  std::vector<GrainAtWall> rows;
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    if (contacts.j[c] >= 0) continue;
    contacts.j[c] -= static_cast<std::int32_t>(planes_.size());
    rows.emplace_back(row(contacts.i[c]), c);
  }
  std::sort(rows.begin(), rows.end());
  return rows;
}

/// Of contacts and weights.
template <int D>
double InferredWalls<D>::largest_force(const Frame<D>& frame) const
{
  double largest = 0;
  for (const auto& force : frame.contacts.force) largest = std::max(largest, force.norm());
  for (std::size_t g = 0; g < bed_.grains.size(); ++g)
    if (is_mobile(bed_.grains, frame, g))
      largest = std::max(largest, bed_.grains.mass[g] * gravity_.norm());
  return largest;
}

template <int D>
void InferredWalls<D>::add_to(Frame<D>& frame)
{
  if (frame.force.empty())
    throw UsageError(
        "--wall: the archive has no forces on grains, from which those of walls could be inferred; "
        "dump them (fx fy fz), or the contacts with walls themselves (--wall-contacts)");
  const auto rows = renumber(frame.contacts);
  const auto already_there = [&](std::size_t grain, const Touch& touch) {
    const auto [from, to] =
        std::equal_range(rows.begin(), rows.end(), GrainAtWall{grain, 0},
                         [](const auto& a, const auto& b) { return a.first < b.first; });
    return std::any_of(from, to, [&](const auto& grain_at_wall) {
      return (frame.contacts.branch[grain_at_wall.second] - touch.branch).norm() <
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

template <int D>
std::string InferredWalls<D>::remark() const
{
  return fmt::format(
      "forces of {} are inferred from the balance of the grains that touch them, of which it is then "
      "no check",
      list_of(walls_));
}

template <int D>
std::vector<std::string> InferredWalls<D>::counts() const
{
  std::vector<std::string> remarks;
  if (contacts_ > 0)
    remarks.push_back(fmt::format("{} to {} grains touch these walls in a moment", fewest_, most_));
  if (at_two_ > 0)
    remarks.push_back(fmt::format(
        "of these {} contacts, {} times a grain touches more than one wall: their friction cannot be "
        "told apart and is shared in proportion to their normal forces",
        contacts_, at_two_));
  if (pulling_ > 0)
    remarks.push_back(fmt::format(
        "{} of these {} contacts pull, the most by {:.2g} of the largest force of its moment",
        pulling_, contacts_, largest_pull_));
  for (std::size_t w = 0; w < walls_.size(); ++w)
    if (contacts_of_[w] == 0)
      remarks.push_back(
          fmt::format("no grain ever touches the wall {} ({}), of which the archive "
                      "has no contacts either: is it there?",
                      walls_[w].name, walls_[w].place()));
  return remarks;
}

template class InferredWalls<2>;
template class InferredWalls<3>;

}  // namespace grseg
