// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/import/verify/near_pairs.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>
#include <utility>

namespace grseg {
namespace {

/// A present grain; whether it is mobile.
template <int D>
struct Present {
  Vector<D> x;
  double radius = 0;
  std::int32_t row = 0;
  bool mobile = false;
};

/// The present grains by cells of one size, a few of them in each.
template <int D>
class Cells {
 public:
  using Place = std::array<std::ptrdiff_t, D>;

  Cells(const Grains& grains, const Frame<D>& frame)
  {
    std::vector<double> radii;
    high_ = Vector<D>::Constant(-INFINITY);
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
    const auto middle = radii.begin() + static_cast<std::ptrdiff_t>(radii.size() / 2);
    std::nth_element(radii.begin(), middle, radii.end());
    // No more cells than a few for each grain, however far apart grains are.
    const double limit = 8 * static_cast<double>(grains_.size()) + 64;
    for (side_ = 2 * *middle; !(cells_of(high_) <= limit);) side_ *= 2;
    sort();
  }

  /// In the order of their cells.
  const std::vector<Present<D>>& grains() const { return grains_; }

  /// use(grain) for each grain in the cells that a box meets, from the grain `beyond` on.
  template <class Use>
  void for_each_in(const Vector<D>& from, const Vector<D>& to, std::size_t beyond,
                   const Use& use) const
  {
    if ((from.array() > high_.array()).any() || (to.array() < low_.array()).any()) return;
    const Place first = place(from.cwiseMax(low_)), last = place(to.cwiseMin(high_));
    for (Place at = first;;) {
      // Cells along the first axis follow one another.
      const auto begin = begins_[index(at)];
      at[0] = last[0];
      const auto end = begins_[index(at) + 1];
      at[0] = first[0];
      for (auto k = std::max(begin, beyond); k < end; ++k) use(grains_[k]);
      std::size_t axis = 1;
      while (axis < D && ++at[axis] > last[axis]) at[axis] = first[axis], ++axis;
      if (axis == D) return;
    }
  }

 private:
  double cells_of(const Vector<D>& high)
  {
    double cells = 1;
    for (int k = 0; k < D; ++k) {
      const double count = std::floor((high[k] - low_[k]) / side_) + 1;
      cells *= count;
      counts_[static_cast<std::size_t>(k)] = static_cast<std::ptrdiff_t>(std::min(count, 1e9));
    }
    return cells;
  }
  Place place(const Vector<D>& x) const
  {
    Place at;
    for (int k = 0; k < D; ++k)
      at[static_cast<std::size_t>(k)] = static_cast<std::ptrdiff_t>((x[k] - low_[k]) / side_);
    return at;
  }
  std::size_t index(const Place& at) const
  {
    std::ptrdiff_t place = 0;
    for (std::size_t axis = D; axis-- > 0;) place = place * counts_[axis] + at[axis];
    return static_cast<std::size_t>(place);
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

  Vector<D> low_, high_;
  double side_ = 0;
  Place counts_{};
  std::vector<std::size_t> begins_;  // of each cell in grains_, and the end
  std::vector<Present<D>> grains_;
};

/// The vectors by which a grain is shifted to meet others across a period, 0 among them.
template <int D>
std::vector<Vector<D>> shifts(const Box& box)
{
  std::vector<Vector<D>> all{Vector<D>::Zero()};
  const auto add = [&](int axis, double length) {
    for (std::size_t k = all.size(); k-- > 0;)
      for (const int side : {-1, 1}) all.push_back(all[k] + side * length * Vector<D>::Unit(axis));
  };
  if (box.periodic_x) add(0, box.length_x);
  if constexpr (D == 3)
    if (box.periodic_z) add(2, box.length_z);
  return all;
}

}  // namespace

template <int D>
std::vector<NearPair> near_pairs(const Grains& grains, const Box& box, const Frame<D>& frame,
                                 double widest, const std::function<bool(const NearPair&)>& counts)
{
  const Cells<D> cells(grains, frame);
  std::vector<NearPair> pairs;
  const auto all_shifts = shifts<D>(box);
  const auto& present = cells.grains();
  double smallest = INFINITY;
  for (const auto& grain : present) smallest = std::min(smallest, grain.radius);
  for (const auto& large : present) {
    const Vector<D> reach = Vector<D>::Constant((2 + widest) * large.radius);
    const auto own = static_cast<std::size_t>(&large - present.data());
    for (const auto& shift : all_shifts) {
      const Vector<D> x = large.x + shift;
      // The larger of two grains finds the other, the first of two that are equal.
      const auto beyond = large.radius == smallest ? own + 1 : 0;
      cells.for_each_in(x - reach, x + reach, beyond, [&](const Present<D>& small) {
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
  // Through a narrow period two grains may be near in two ways: the nearest counts.
  const auto order = [](const NearPair& a, const NearPair& b) {
    return std::tuple(a.i, a.j, a.gap) < std::tuple(b.i, b.j, b.gap);
  };
  const auto same = [](const NearPair& a, const NearPair& b) { return a.i == b.i && a.j == b.j; };
  std::sort(pairs.begin(), pairs.end(), order);
  pairs.erase(std::unique(pairs.begin(), pairs.end(), same), pairs.end());
  return pairs;
}

template std::vector<NearPair> near_pairs<2>(const Grains&, const Box&, const Frame<2>&, double,
                                             const std::function<bool(const NearPair&)>&);
template std::vector<NearPair> near_pairs<3>(const Grains&, const Box&, const Frame<3>&, double,
                                             const std::function<bool(const NearPair&)>&);

}  // namespace grseg
