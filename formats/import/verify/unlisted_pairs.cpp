// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/import/verify/unlisted_pairs.hpp"

#include "formats/import/common/minimum_image.hpp"

#include <gsl/gsl_statistics_double.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <set>

namespace grseg {
namespace {

/// Surfaces of one rigid body may be this far apart, over the smaller radius.
constexpr double widest = 0.05;
/// Relative difference of two motions that are the same: six digits of velocities, of which the
/// rotation is a hundredth.
constexpr double same_motion = 1e-4;

constexpr double errors = 3, part_of_median = 0.25;

Vec2 cross(double spin, const Vec2& b)
{
  return {-spin * b.y(), spin * b.x()};
}

Vec3 cross(const Vec3& spin, const Vec3& b)
{
  return spin.cross(b);
}

double size(double spin)
{
  return std::abs(spin);
}

double size(const Vec3& spin)
{
  return spin.norm();
}

/// Whether two grains move as one body: with the same spin and with the velocities that it makes.
/// Without any spin, if they are `joined`: whether they move, but not along their branch.
template <int D>
bool moves_as_one(const Box& box, const Frame<D>& frame, const NearPair& pair, bool joined)
{
  const auto i = static_cast<std::size_t>(pair.i), j = static_cast<std::size_t>(pair.j);
  const double spin = size(frame.angular_velocity[i]);
  const Spin<D> other = frame.angular_velocity[i] - frame.angular_velocity[j];
  const double differing = size(other);
  if (differing > same_motion * spin) return false;
  const Vector<D> branch = minimum_image<D>(box, frame.position[i] - frame.position[j]);
  const Vector<D> relative = frame.velocity[i] - frame.velocity[j];
  if (spin == 0)
    return joined && std::abs(relative.dot(branch)) < same_motion * relative.norm() * branch.norm();
  const Vector<D> turning = cross(frame.angular_velocity[i], branch);
  return (relative - turning).norm() <= same_motion * spin * branch.norm();
}

/// Whether normal forces grow with overlaps, as a rank correlation. Per moment it was 0.79 to 1 in
/// archives of soft grains (LAMMPS, LIGGGHTS, YADE) and 0.04 to 0.66 in runs of contact dynamics,
/// where overlaps are what earlier steps have left; 100 contacts know it to 0.1.
template <int D>
bool forces_grow_with_overlaps(const ContactList<D>& contacts)
{
  constexpr double soft = 0.75;
  constexpr std::size_t fewest = 100;
  std::vector<double> forces, overlaps;
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    const double normal = contacts.force[c].dot(contacts.branch[c].normalized());
    if (contacts.j[c] < 0 || normal <= 0) continue;
    forces.push_back(normal);
    overlaps.push_back(-contacts.gap[c]);
  }
  if (forces.size() < fewest) return false;
  std::vector<double> work(2 * forces.size());
  return gsl_stats_spearman(forces.data(), 1, overlaps.data(), 1, forces.size(), work.data()) >
         soft;
}

double median_overlap(std::vector<double>& overlaps)
{
  if (overlaps.empty()) return 0;
  const auto middle = overlaps.begin() + static_cast<std::ptrdiff_t>(overlaps.size() / 2);
  std::nth_element(overlaps.begin(), middle, overlaps.end());
  return *middle;
}

double part_of_mobile(const Grains& grains, const std::vector<NearPair>& pairs)
{
  if (pairs.empty()) return 0;
  std::set<std::int32_t> members;
  for (const auto& pair : pairs) members.insert({pair.i, pair.j});
  double mobile = 0;
  for (std::size_t g = 0; g < grains.size(); ++g) mobile += is_mobile(grains, g);
  return mobile > 0 ? static_cast<double>(members.size()) / mobile : 0;
}

}  // namespace

template <int D>
UnlistedPairs unlisted_pairs_of(const Grains& grains, const Box& box, const Frame<D>& frame,
                                const ListedPairs& listed, double error)
{
  UnlistedPairs found;
  std::vector<double> overlaps;
  const auto is_open = [&](const NearPair& pair) {
    if (!listed.contains(pair.i, pair.j))
      return pair.gap < 0 || moves_as_one<D>(box, frame, pair, true);
    if (pair.gap < 0) overlaps.push_back(-pair.gap);
    return false;
  };
  const auto open = near_pairs<D>(grains, box, frame, widest, is_open);
  if (open.empty()) return found;
  const double least = std::max(errors * error, part_of_median * median_overlap(overlaps));
  for (const auto& pair : open) {
    const bool overlaps_without = -pair.gap > least;
    if (moves_as_one<D>(box, frame, pair, overlaps_without)) found.rigid.push_back(pair);
    if (!overlaps_without) continue;
    found.unlisted.push_back(pair);
    found.at_boundary += !is_mobile(grains, static_cast<std::size_t>(pair.i)) ||
                         !is_mobile(grains, static_cast<std::size_t>(pair.j));
  }
  std::sort(found.unlisted.begin(), found.unlisted.end(),
            [](const NearPair& a, const NearPair& b) { return a.gap < b.gap; });
  if (!found.unlisted.empty()) found.forces_grow = forces_grow_with_overlaps<D>(frame.contacts);
  found.rigid_grains = part_of_mobile(grains, found.rigid);
  return found;
}

template UnlistedPairs unlisted_pairs_of<2>(const Grains&, const Box&, const Frame<2>&,
                                            const ListedPairs&, double);
template UnlistedPairs unlisted_pairs_of<3>(const Grains&, const Box&, const Frame<3>&,
                                            const ListedPairs&, double);

}  // namespace grseg
