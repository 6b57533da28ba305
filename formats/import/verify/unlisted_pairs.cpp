// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/import/verify/unlisted_pairs.hpp"

#include "formats/import/common/frame_tools.hpp"
#include "formats/import/verify/rigid_pairs.hpp"

#include <gsl/gsl_statistics_double.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <tuple>

namespace grseg {
namespace {

/// A grain that is present in the frame.
struct Present {
  Vec3 x;
  double radius = 0;
  std::int32_t row = 0;
  bool mobile = false;
};

/// The present grains, sorted into cubic cells with a few grains each.
class Cells {
 public:
  using Place = std::array<std::ptrdiff_t, 3>;

  Cells(const Grains& grains, const Frame<3>& frame)
  {
    std::vector<double> radii;
    high_ = Vec3::Constant(-std::numeric_limits<double>::infinity());
    low_ = -high_;
    for (std::size_t g = 0; g < grains.size(); ++g) {
      if (!is_present(frame, g)) continue;
      grains_.push_back({frame.position[g], grains.radius[g], static_cast<std::int32_t>(g),
                         is_mobile(grains, g)});
      radii.push_back(grains.radius[g]);
      low_ = low_.cwiseMin(frame.position[g]);
      high_ = high_.cwiseMax(frame.position[g]);
    }
    if (grains_.empty()) return;
    // At most a few cells per grain, however far apart the grains are.
    const double limit = 8 * static_cast<double>(grains_.size()) + 64;
    for (side_ = 2 * median(radii); !(cells_of(high_) <= limit);) side_ *= 2;
    sort();
  }

  /// The present grains, in the order of their cells.
  const std::vector<Present>& grains() const { return grains_; }

  /// Calls use(grain) for each grain, from index `beyond` on, in the cells that the box `from`,
  /// `to` meets.
  template <class Use>
  void for_each_in(const Vec3& from, const Vec3& to, std::size_t beyond, const Use& use) const
  {
    if ((from.array() > high_.array()).any() || (to.array() < low_.array()).any()) return;
    const Place first = place(from.cwiseMax(low_)), last = place(to.cwiseMin(high_));
    for (auto z = first[2]; z <= last[2]; ++z)
      for (auto y = first[1]; y <= last[1]; ++y) {
        // Cells along the first axis are adjacent in memory.
        const auto end = begins_[index({last[0], y, z}) + 1];
        for (auto k = std::max(begins_[index({first[0], y, z})], beyond); k < end; ++k)
          use(grains_[k]);
      }
  }

 private:
  double cells_of(const Vec3& high)
  {
    double cells = 1;
    for (int k = 0; k < 3; ++k) {
      const double count = std::floor((high[k] - low_[k]) / side_) + 1;
      cells *= count;
      counts_[static_cast<std::size_t>(k)] = static_cast<std::ptrdiff_t>(std::min(count, 1e9));
    }
    return cells;
  }
  Place place(const Vec3& x) const
  {
    Place at;
    for (int k = 0; k < 3; ++k)
      at[static_cast<std::size_t>(k)] = static_cast<std::ptrdiff_t>((x[k] - low_[k]) / side_);
    return at;
  }
  std::size_t index(const Place& at) const
  {
    return static_cast<std::size_t>((at[2] * counts_[1] + at[1]) * counts_[0] + at[0]);
  }
  void sort()
  {
    std::size_t cells = 1;
    for (const auto count : counts_) cells *= static_cast<std::size_t>(count);
    begins_.assign(cells + 1, 0);
    std::vector<std::size_t> cell;
    for (const auto& grain : grains_) {
      cell.push_back(index(place(grain.x)));
      ++begins_[cell.back() + 1];
    }
    for (std::size_t c = 0; c < cells; ++c) begins_[c + 1] += begins_[c];
    auto next = begins_;
    auto sorted = grains_;
    for (std::size_t k = 0; k < grains_.size(); ++k) sorted[next[cell[k]]++] = grains_[k];
    grains_ = std::move(sorted);
  }

  Vec3 low_, high_;
  double side_ = 0;
  Place counts_{};
  std::vector<std::size_t> begins_;  // index in grains_ of each cell's first grain, and the end
  std::vector<Present> grains_;
};

/// Vectors from a grain to its periodic images, including 0.
std::vector<Vec3> shifts(const Box& box)
{
  std::vector<Vec3> all{Vec3::Zero()};
  const auto add = [&](int axis, double length) {
    for (std::size_t k = all.size(); k-- > 0;)
      for (const int side : {-1, 1}) all.push_back(all[k] + side * length * Vec3::Unit(axis));
  };
  if (box.periodic_x) add(0, box.length_x);
  if (box.periodic_z) add(2, box.length_z);
  return all;
}

/// Largest gap between grains of one rigid body, over the smaller radius.
constexpr double widest = 0.05;
constexpr double errors = 3, part_of_median = 0.25;

/// True if normal forces grow with overlaps, by their rank correlation. In single frames it was
/// 0.79 to 1 in archives of soft grains (LAMMPS, LIGGGHTS, YADE), and 0.04 to 0.66 in contact
/// dynamics, where overlaps remain from earlier steps. From 100 contacts it is accurate to 0.1.
bool forces_grow_with_overlaps(const ContactList<3>& contacts)
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

}  // namespace

std::vector<NearPair> near_pairs(const Grains& grains, const Box& box, const Frame<3>& frame,
                                 double widest, const std::function<bool(const NearPair&)>& counts)
{
  const Cells cells(grains, frame);
  std::vector<NearPair> pairs;
  const auto all_shifts = shifts(box);
  const auto& present = cells.grains();
  double smallest = INFINITY;
  for (const auto& grain : present) smallest = std::min(smallest, grain.radius);
  for (const auto& large : present) {
    const Vec3 reach = Vec3::Constant((2 + widest) * large.radius);
    const auto own = static_cast<std::size_t>(&large - present.data());
    for (const auto& shift : all_shifts) {
      const Vec3 x = large.x + shift;
      // Each pair is found once: by the larger grain, or, for equal sizes, by the first one.
      const auto beyond = large.radius == smallest ? own + 1 : 0;
      cells.for_each_in(x - reach, x + reach, beyond, [&](const Present& small) {
        if (small.radius > large.radius) return;
        if (small.radius == large.radius && &small <= &large) return;
        const double range = large.radius + (1 + widest) * small.radius;
        const double squared = (x - small.x).squaredNorm();
        if (squared > range * range || (!large.mobile && !small.mobile)) return;
        const double gap = (std::sqrt(squared) - large.radius - small.radius) / small.radius;
        const NearPair pair{std::min(large.row, small.row), std::max(large.row, small.row), gap};
        if (counts(pair)) pairs.push_back(pair);
      });
    }
  }
  // In a short periodic cell two grains may be neighbours twice; only the nearest images count.
  const auto order = [](const NearPair& a, const NearPair& b) {
    return std::tuple(a.i, a.j, a.gap) < std::tuple(b.i, b.j, b.gap);
  };
  const auto same = [](const NearPair& a, const NearPair& b) { return a.i == b.i && a.j == b.j; };
  std::sort(pairs.begin(), pairs.end(), order);
  pairs.erase(std::unique(pairs.begin(), pairs.end(), same), pairs.end());
  return pairs;
}

ListedPairs::ListedPairs(const ContactList<3>& contacts, bool pushing_only)
{
  const auto for_each = [&](const auto& use) {
    for (std::size_t c = 0; c < contacts.size(); ++c) {
      if (pushing_only && contacts.force[c].isZero(0)) continue;
      const auto [low, high] = std::minmax(contacts.i[c], contacts.j[c]);
      use(low, static_cast<std::size_t>(high));
    }
  };
  begins_.push_back(0);
  for_each([&](std::int32_t, std::size_t high) {
    if (begins_.size() < high + 2) begins_.resize(high + 2);
    ++begins_[high + 1];
  });
  for (std::size_t g = 1; g < begins_.size(); ++g) begins_[g] += begins_[g - 1];
  lower_.resize(begins_.back());
  auto next = begins_;
  for_each([&](std::int32_t low, std::size_t high) { lower_[next[high]++] = low; });
  for (std::size_t g = 1; g < begins_.size(); ++g)
    std::sort(lower_.data() + begins_[g - 1], lower_.data() + begins_[g]);
}

bool ListedPairs::contains(std::int32_t i, std::int32_t j) const
{
  const auto [low, high] = std::minmax(i, j);
  const auto g = static_cast<std::size_t>(high);
  if (g + 1 >= begins_.size()) return false;
  return std::binary_search(lower_.data() + begins_[g], lower_.data() + begins_[g + 1], low);
}

std::optional<ListedPairs::Pair> ListedPairs::twice() const
{
  for (std::size_t g = 1; g < begins_.size(); ++g) {
    const auto* end = lower_.data() + begins_[g];
    const auto* found = std::adjacent_find(lower_.data() + begins_[g - 1], end);
    if (found != end) return Pair(*found, static_cast<std::int32_t>(g - 1));
  }
  return std::nullopt;
}

UnlistedPairs unlisted_pairs_of(const Grains& grains, const Box& box, const Frame<3>& frame,
                                const ListedPairs& listed, double error)
{
  UnlistedPairs found;
  std::vector<double> overlaps;
  const auto is_open = [&](const NearPair& pair) {
    if (!listed.contains(pair.i, pair.j))
      return pair.gap < 0 || moves_as_one(box, frame, pair, true);
    if (pair.gap < 0) overlaps.push_back(-pair.gap);
    return false;
  };
  const auto open = near_pairs(grains, box, frame, widest, is_open);
  if (open.empty()) return found;
  const double least = std::max(errors * error, part_of_median * median(overlaps));
  for (const auto& pair : open) {
    const bool overlaps_without = -pair.gap > least;
    if (moves_as_one(box, frame, pair, overlaps_without)) found.rigid.push_back(pair);
    if (!overlaps_without) continue;
    found.unlisted.push_back(pair);
    found.at_boundary += !is_mobile(grains, row(pair.i)) || !is_mobile(grains, row(pair.j));
  }
  std::sort(found.unlisted.begin(), found.unlisted.end(),
            [](const NearPair& a, const NearPair& b) { return a.gap < b.gap; });
  if (!found.unlisted.empty()) found.forces_grow = forces_grow_with_overlaps(frame.contacts);
  return found;
}

}  // namespace grseg
