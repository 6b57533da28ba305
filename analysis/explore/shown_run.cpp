// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/explore/shown_run.hpp"

#include "analysis/frames/contacts.hpp"
#include "formats/core/errors.hpp"
#include "formats/core/text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <utility>

namespace grseg {
namespace {

constexpr float nothing = std::numeric_limits<float>::quiet_NaN();
/// Smallest length of a unit vector's projection onto the plane; with a shorter projection the vector
/// counts as perpendicular to the plane.
constexpr double along_the_plane = 1e-3;

/// The slice of spheres that is shown: its middle and thickness along z, m.
struct Slice {
  double middle, thickness;
};

template <int D>
void show_grains(const Grains& grains, const Frame<D>& frame, const Slice& slice, ShownFrame& shown)
{
  for (auto* list : {&shown.x, &shown.y, &shown.z}) list->assign(grains.size(), nothing);
  for (std::size_t g = 0; g < grains.size(); ++g) {
    if (!is_present(frame, g)) continue;
    const double z = D == 2 ? 0 : frame.position[g][D - 1] - slice.middle;
    if (std::abs(z) > slice.thickness / 2) continue;
    shown.x[g] = static_cast<float>(frame.position[g].x());
    shown.y[g] = static_cast<float>(frame.position[g].y());
    shown.z[g] = static_cast<float>(z);
  }
}

/// Walls as lines in the plane z = `plane`, m, numbered from 0 in order of their first contact.
template <int D>
class WallsInPlane {
 public:
  explicit WallsInPlane(double plane) : plane_(plane) {}

  /// Adds the walls of one more frame, and returns all walls known so far.
  std::vector<ShownWall> with(const Frame<D>& frame)
  {
    walls_.add(frame);
    for (const auto& [number, wall] : walls_.all()) numbers_.try_emplace(number, numbers_.size());
    std::vector<ShownWall> lines(numbers_.size());
    for (const auto& [number, wall] : walls_.all()) lines[numbers_.at(number)] = line_of(wall);
    return lines;
  }
  /// Number j < 0 of a wall for the page, -1 minus the wall's number here; `j` is the number in the file.
  std::int32_t renumbered(std::int32_t j) const
  {
    return -1 - static_cast<std::int32_t>(numbers_.at(-1 - j));
  }

 private:
  ShownWall line_of(const typename Walls<D>::Wall& wall) const
  {
    const Vec2 in_plane = wall.normal.template head<2>();
    const double length = in_plane.norm();
    if (!(length > along_the_plane)) return {nothing, nothing, nothing};
    double offset = wall.normal.dot(wall.point);
    if constexpr (D == 3) offset -= wall.normal.z() * plane_;
    return {static_cast<float>(in_plane.x() / length), static_cast<float>(in_plane.y() / length),
            static_cast<float>(offset / length)};
  }

  double plane_;
  Walls<D> walls_;
  std::map<std::int32_t, std::size_t> numbers_;
};

/// Indices of the contacts, sorted by (i, j).
template <int D>
std::vector<std::size_t> in_order(const ContactList<D>& contacts)
{
  std::vector<std::size_t> order(contacts.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::sort(order, {},
                    [&](std::size_t k) { return std::pair(contacts.i[k], contacts.j[k]); });
  return order;
}

template <int D>
void show_contacts(const Frame<D>& frame, const WallsInPlane<D>& walls, ShownFrame& shown)
{
  const auto& contacts = frame.contacts;
  const auto is_shown = [&](std::int32_t g) {
    return g < 0 || !std::isnan(shown.x[static_cast<std::size_t>(g)]);
  };
  for (const auto k : in_order(contacts)) {
    if (contacts.force[k].isZero() || !is_shown(contacts.i[k]) || !is_shown(contacts.j[k]))
      continue;
    const Vec2 branch = contacts.branch[k].template head<2>();
    const Vec2 force = contacts.force[k].template head<2>();
    const double length = branch.norm();
    if (!(length > along_the_plane * contacts.branch[k].norm())) continue;  // across the plane
    const Vec2 along = branch / length, left(-along.y(), along.x());
    shown.i.push_back(contacts.i[k]);
    shown.j.push_back(contacts.j[k] < 0 ? walls.renumbered(contacts.j[k]) : contacts.j[k]);
    shown.along.push_back(static_cast<float>(force.dot(along)));
    shown.across.push_back(static_cast<float>(force.dot(left)));
  }
}

/// Largest difference, over mixed contacts, between the share under the rule contact-point and the share
/// under size. An overlap or a gap of the two grains causes this difference.
template <int D>
double contact_point_from_size(const Grains& grains, const ContactList<D>& contacts)
{
  double largest = 0;
  for (std::size_t k = 0; k < contacts.size(); ++k) {
    if (contacts.j[k] < 0) continue;
    const auto i = static_cast<std::size_t>(contacts.i[k]),
               j = static_cast<std::size_t>(contacts.j[k]);
    if (grains.species[i] == grains.species[j] || !is_mobile(grains, j)) continue;
    const double by_size = grains.radius[i] / (grains.radius[i] + grains.radius[j]);
    largest = std::max(largest, std::abs(share_of_first(grains, contacts, k) - by_size));
  }
  return largest;
}

/// Rows of the grains that at least one frame shows.
std::vector<std::uint32_t> rows_shown(const std::vector<ShownFrame>& frames, std::size_t grains)
{
  std::vector<std::uint32_t> rows;
  for (std::size_t g = 0; g < grains; ++g)
    if (!std::ranges::all_of(frames, [g](const auto& frame) { return std::isnan(frame.x[g]); }))
      rows.push_back(static_cast<std::uint32_t>(g));
  return rows;
}

/// Removes all grains but `rows`, which are in ascending order; `number` is the new number of each grain.
void renumber(ShownFrame& frame, const std::vector<std::uint32_t>& rows,
              const std::vector<std::int32_t>& number)
{
  for (auto* list : {&frame.x, &frame.y, &frame.z}) {
    for (std::size_t g = 0; g < rows.size(); ++g) (*list)[g] = (*list)[rows[g]];
    list->resize(rows.size());
  }
  for (auto* list : {&frame.i, &frame.j})
    for (auto& grain : *list)
      if (grain >= 0) grain = number[static_cast<std::size_t>(grain)];
}

}  // namespace

std::vector<std::size_t> evenly_spaced(const std::vector<std::size_t>& frames, std::size_t count)
{
  const std::size_t stride =
      std::max<std::size_t>(1, (frames.size() + count / 2) / std::max<std::size_t>(1, count));
  std::vector<std::size_t> some;
  some.reserve(frames.size() / stride + 1);
  for (std::size_t k = 0; k < frames.size(); k += stride) some.push_back(frames[k]);
  return some;
}

template <int D>
ShownRun show_run(const TrajectoryReader& run, const Grains& grains,
                  const std::vector<std::size_t>& frames)
{
  ShownRun all;
  const Slice slice{run.box().low_z + run.box().length_z / 2, run.large_diameter()};
  const auto gravity = run.gravity<D>();
  WallsInPlane<D> walls(slice.middle);
  Frame<D> frame;
  for (const auto index : frames) {
    run.read(index, frame, {.velocity = false, .contacts = true});
    auto& shown = all.frames.emplace_back();
    shown.step = frame.step;
    shown.time = frame.time;
    shown.gravity = gravity.at(frame.time).template head<2>();
    shown.walls = walls.with(frame);
    if (shown.walls.size() > most_walls)
      throw FormatError(fmt::format("{}: frame {} (t = {:g} s): there are more than {} walls",
                                    printable(run.path()), index, frame.time, most_walls));
    show_grains(grains, frame, slice, shown);
    show_contacts(frame, walls, shown);
    all.contact_point_from_size =
        std::max(all.contact_point_from_size, contact_point_from_size(grains, frame.contacts));
  }
  all.row = rows_shown(all.frames, grains.size());
  std::vector<std::int32_t> number(grains.size(), -1);
  for (std::size_t g = 0; g < all.row.size(); ++g)
    number[all.row[g]] = static_cast<std::int32_t>(g);
  for (auto& shown : all.frames) renumber(shown, all.row, number);
  for (const auto row : all.row) {
    all.radius.push_back(static_cast<float>(grains.radius[row]));
    all.species.push_back(is_mobile(grains, row) ? grains.species[row] : Species::boundary);
  }
  return all;
}

template ShownRun show_run<2>(const TrajectoryReader&, const Grains&,
                              const std::vector<std::size_t>&);
template ShownRun show_run<3>(const TrajectoryReader&, const Grains&,
                              const std::vector<std::size_t>&);

}  // namespace grseg
