// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/import/verify/near_pairs.hpp"

#include "formats/import/common/minimum_image.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace grseg {
namespace {

/// The present grains by cells of one size, a few of them in each.
template <int D>
class Cells {
 public:
  using Place = std::array<std::ptrdiff_t, D>;

  Cells(const Grains& grains, const Frame<D>& frame)
  {
    std::vector<double> radii;
    Vector<D> high = Vector<D>::Constant(-INFINITY);
    low_ = -high;
    for (std::size_t g = 0; g < grains.size(); ++g) {
      if (!is_present(frame, g)) continue;
      rows_.push_back(static_cast<std::int32_t>(g));
      radii.push_back(grains.radius[g]);
      low_ = low_.cwiseMin(frame.position[g]);
      high = high.cwiseMax(frame.position[g]);
    }
    if (rows_.empty()) return;
    const auto middle = radii.begin() + static_cast<std::ptrdiff_t>(radii.size() / 2);
    std::nth_element(radii.begin(), middle, radii.end());
    // No more cells than a few for each grain, however far apart grains are.
    const double limit = 8 * static_cast<double>(rows_.size()) + 64;
    for (side_ = 2 * *middle; !(cells_of(high) <= limit);) side_ *= 2;
    sort(frame);
  }

  /// use(row) for each grain in the cells that a box meets.
  template <class Use>
  void for_each_in(const Vector<D>& from, const Vector<D>& to, const Use& use) const
  {
    if (rows_.empty()) return;
    Place first, last;
    for (int k = 0; k < D; ++k) {
      const auto axis = static_cast<std::size_t>(k);
      const double end = static_cast<double>(counts_[axis] - 1);
      const double a = std::floor((from[k] - low_[k]) / side_);
      const double b = std::floor((to[k] - low_[k]) / side_);
      if (b < 0 || a > end) return;
      first[axis] = static_cast<std::ptrdiff_t>(std::max(a, 0.0));
      last[axis] = static_cast<std::ptrdiff_t>(std::min(b, end));
    }
    for (Place at = first;;) {
      // Cells along the first axis follow one another.
      const auto begin = begins_[index(at)];
      at[0] = last[0];
      const auto end = begins_[index(at) + 1];
      at[0] = first[0];
      for (auto k = begin; k < end; ++k) use(rows_[k]);
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
  std::size_t index(const Place& at) const
  {
    std::ptrdiff_t place = 0;
    for (std::size_t axis = D; axis-- > 0;) place = place * counts_[axis] + at[axis];
    return static_cast<std::size_t>(place);
  }
  void sort(const Frame<D>& frame)
  {
    std::size_t cells = 1;
    for (const auto count : counts_) cells *= static_cast<std::size_t>(count);
    begins_.assign(cells + 1, 0);
    std::vector<std::size_t> cell;
    for (const auto row : rows_) {
      Place at;
      const auto& x = frame.position[static_cast<std::size_t>(row)];
      for (int k = 0; k < D; ++k)
        at[static_cast<std::size_t>(k)] =
            static_cast<std::ptrdiff_t>(std::floor((x[k] - low_[k]) / side_));
      cell.push_back(index(at));
      ++begins_[cell.back() + 1];
    }
    for (std::size_t c = 0; c < cells; ++c) begins_[c + 1] += begins_[c];
    auto next = begins_;
    auto sorted = rows_;
    for (std::size_t k = 0; k < rows_.size(); ++k) sorted[next[cell[k]]++] = rows_[k];
    rows_ = std::move(sorted);
  }

  Vector<D> low_;
  double side_ = 0;
  Place counts_{};
  std::vector<std::size_t> begins_;  // of each cell in rows_, and the end
  std::vector<std::int32_t> rows_;
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
                                 double widest)
{
  const Cells<D> cells(grains, frame);
  std::vector<NearPair> pairs;
  const auto all_shifts = shifts<D>(box);
  for (std::size_t i = 0; i < grains.size(); ++i) {
    if (!is_present(frame, i)) continue;
    const double radius = grains.radius[i];
    // The larger of two grains finds the other, the first of two that are equal.
    const auto visit = [&](std::int32_t other) {
      const auto j = static_cast<std::size_t>(other);
      const double smaller = grains.radius[j];
      if (smaller > radius || (smaller == radius && j <= i)) return;
      const auto between = minimum_image<D>(box, frame.position[i] - frame.position[j]);
      const double range = radius + (1 + widest) * smaller;
      if (between.squaredNorm() > range * range) return;
      if (!is_mobile(grains, i) && !is_mobile(grains, j)) return;
      const auto row = static_cast<std::int32_t>(i);
      const double gap = (between.norm() - radius - smaller) / smaller;
      pairs.push_back({std::min(row, other), std::max(row, other), gap});
    };
    const Vector<D> reach = Vector<D>::Constant((2 + widest) * radius);
    for (const auto& shift : all_shifts) {
      const Vector<D> x = frame.position[i] + shift;
      cells.for_each_in(x - reach, x + reach, visit);
    }
  }
  const auto order = [](const NearPair& a, const NearPair& b) {
    return std::pair(a.i, a.j) < std::pair(b.i, b.j);
  };
  const auto same = [](const NearPair& a, const NearPair& b) { return a.i == b.i && a.j == b.j; };
  std::sort(pairs.begin(), pairs.end(), order);
  pairs.erase(std::unique(pairs.begin(), pairs.end(), same), pairs.end());
  return pairs;
}

template std::vector<NearPair> near_pairs<2>(const Grains&, const Box&, const Frame<2>&, double);
template std::vector<NearPair> near_pairs<3>(const Grains&, const Box&, const Frame<3>&, double);

}  // namespace grseg
