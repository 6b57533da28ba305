// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/import/verify/unlisted_forces.hpp"

#include "formats/import/common/minimum_image.hpp"
#include "formats/import/verify/unlisted_pairs.hpp"

#include <fmt/format.h>

#include <Eigen/IterativeLinearSolvers>
#include <Eigen/SparseCore>
#include <algorithm>
#include <cmath>

namespace grseg {
namespace {

/// Of the squares of what is missing, the part that a cause has to explain.
constexpr double most = 0.95;
/// Grains that tell a drag from chance.
constexpr double fewest = 3;
/// Gaps over the smaller radius within which partners are looked for, one after another.
constexpr double reaches[] = {0.02, 0.1, 0.3};

/// A pair without a listed force, and the size of the force that it seems to bear, N.
struct PairForce {
  NearPair pair;
  double force = 0;
  bool pushes = false;
};

template <int D>
bool counts(const Grains& grains, const Frame<D>& frame, const Imbalance<D>& imbalance,
            std::size_t g)
{
  return is_mobile(grains, frame, g) && imbalance.defect[g].norm() > imbalance.limit;
}

/// The forces between `pairs` that leave the least of what is missing (least squares), and the part of
/// the squares that they explain on the grains that do not balance.
template <int D>
std::pair<std::vector<PairForce>, double> forces_between(const std::vector<NearPair>& pairs,
                                                         const Grains& grains, const Box& box,
                                                         const Frame<D>& frame,
                                                         const Imbalance<D>& imbalance)
{
  const auto rows = static_cast<Eigen::Index>(D * grains.size());
  const auto columns = static_cast<Eigen::Index>(D * pairs.size());
  std::vector<Eigen::Triplet<double>> entries;
  Eigen::VectorXd missing = Eigen::VectorXd::Zero(rows);
  const auto is_open = [&](std::size_t g) {
    return is_mobile(grains, frame, g) && !std::isnan(imbalance.defect[g].y());
  };
  for (std::size_t g = 0; g < grains.size(); ++g)
    if (is_open(g)) missing.segment<D>(static_cast<Eigen::Index>(D * g)) = -imbalance.defect[g];
  for (std::size_t k = 0; k < pairs.size(); ++k)
    for (int axis = 0; axis < D; ++axis) {
      const auto place = [&](std::int32_t of) { return static_cast<int>(D * of) + axis; };
      const auto column = static_cast<int>(D * k) + axis;
      if (is_open(static_cast<std::size_t>(pairs[k].i)))
        entries.emplace_back(place(pairs[k].i), column, 1);
      if (is_open(static_cast<std::size_t>(pairs[k].j)))
        entries.emplace_back(place(pairs[k].j), column, -1);
    }
  Eigen::SparseMatrix<double> sums(rows, columns);
#ifndef __clang_analyzer__  // it takes impossible paths through Eigen
  sums.setFromTriplets(entries.begin(), entries.end());
#endif
  Eigen::LeastSquaresConjugateGradient<Eigen::SparseMatrix<double>> solver(sums);
  const Eigen::VectorXd forces = solver.solve(missing);
  const Eigen::VectorXd left = sums * forces - missing;
  double rest = 0, all = 0;
  for (std::size_t g = 0; g < grains.size(); ++g) {
    if (!counts<D>(grains, frame, imbalance, g)) continue;
    rest += left.segment<D>(static_cast<Eigen::Index>(D * g)).squaredNorm();
    all += imbalance.defect[g].squaredNorm();
  }
  std::vector<PairForce> found;
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    const Vector<D> force = forces.segment<D>(static_cast<Eigen::Index>(D * k));
    if (force.norm() <= imbalance.limit) continue;
    const auto i = static_cast<std::size_t>(pairs[k].i), j = static_cast<std::size_t>(pairs[k].j);
    const auto branch = minimum_image<D>(box, frame.position[i] - frame.position[j]);
    found.push_back({pairs[k], force.norm(), force.dot(branch) > 0});
  }
  return {std::move(found), all > 0 ? 1 - rest / all : 0};
}

std::string text_of(const Grains& grains, const std::vector<PairForce>& pairs)
{
  const auto largest =
      std::max_element(pairs.begin(), pairs.end(),
                       [](const PairForce& a, const PairForce& b) { return a.force < b.force; });
  const auto gaps = std::minmax_element(
      pairs.begin(), pairs.end(),
      [](const PairForce& a, const PairForce& b) { return a.pair.gap < b.pair.gap; });
  const bool all_pull =
      std::all_of(pairs.begin(), pairs.end(), [](const PairForce& pair) { return !pair.pushes; });
  const auto id = [&](std::int32_t row) { return grains.id[static_cast<std::size_t>(row)]; };
  if (pairs.size() == 1 && pairs[0].pushes)
    return fmt::format(
        "; what is missing acts between grains {} and {}, which touch: their contact is missing",
        id(largest->pair.i), id(largest->pair.j));
  const double nearest = gaps.first->pair.gap, farthest = gaps.second->pair.gap;
  return fmt::format(
      "; what is missing acts along {} pairs without a listed force, opposite on the two grains, {:.2g} to "
      "{:.2g} of the smaller radius apart (the largest: grains {} and {}): {}",
      pairs.size(), nearest, farthest, id(largest->pair.i), id(largest->pair.j),
      all_pull
          ? "contacts that pull, also beyond touch, are not listed; write them, too"
          : "bonds, or another interaction, act between grains, and their stress is not that of the "
            "listed contacts");
}

/// k of the drag -k x on each grain that leaves the least of what is missing on the grains that do not
/// balance, and the part of the squares that it explains.
template <int D>
std::pair<double, double> drag_along(const std::vector<Vector<D>>& x, const Grains& grains,
                                     const Frame<D>& frame, const Imbalance<D>& imbalance)
{
  double xx = 0, xy = 0, all = 0, count = 0;
  for (std::size_t g = 0; g < grains.size(); ++g) {
    if (!counts<D>(grains, frame, imbalance, g)) continue;
    xx += x[g].squaredNorm();
    xy += x[g].dot(imbalance.defect[g]);
    all += imbalance.defect[g].squaredNorm();
    ++count;
  }
  if (!(xx > 0) || !(all > 0) || count < fewest) return {0, 0};
  return {xy / xx, xy * xy / (xx * all)};
}

}  // namespace

template <int D>
UnlistedForces unlisted_forces(const Grains& grains, const Box& box, const Frame<D>& frame,
                               const Imbalance<D>& imbalance)
{
  auto momentum = frame.velocity, weight = frame.velocity;
  Vector<D> missing = Vector<D>::Zero();  // over the mass, summed over grains
  for (std::size_t g = 0; g < grains.size(); ++g) {
    momentum[g] *= grains.mass[g];
    if (counts<D>(grains, frame, imbalance, g)) missing += imbalance.defect[g] / grains.mass[g];
  }
  for (std::size_t g = 0; g < grains.size(); ++g) weight[g] = grains.mass[g] * missing;
  const bool as_weight = drag_along<D>(weight, grains, frame, imbalance).second >= most;
  const std::pair<const std::vector<Vector<D>>&, const char*> drags[] = {
      {momentum, "momentum"}, {frame.velocity, "velocity"}};
  for (const auto& [x, name] : drags) {
    const auto [factor, explained] = drag_along<D>(x, grains, frame, imbalance);
    if (explained < most || factor <= 0) continue;
    return {
        fmt::format("; what is missing is {:.4g} times the {} of each grain, against it: {}",
                    factor, name,
                    as_weight ? "a drag on all grains, or another gravity, which cannot be told "
                                "apart where grains move alike"
                              : "a drag on all grains, which is no contact force and no other "
                                "gravity"),
        !as_weight};
  }
  const ListedPairs pushing(frame.contacts, true);
  for (const double reach : reaches) {
    const auto pairs = near_pairs<D>(grains, box, frame, reach, [&](const NearPair& pair) {
      return !pushing.contains(pair.i, pair.j);
    });
    if (pairs.empty()) continue;
    const auto [forces, explained] = forces_between<D>(pairs, grains, box, frame, imbalance);
    if (explained >= most && !forces.empty()) return {text_of(grains, forces), false};
  }
  return {};
}

template UnlistedForces unlisted_forces<2>(const Grains&, const Box&, const Frame<2>&,
                                           const Imbalance<2>&);
template UnlistedForces unlisted_forces<3>(const Grains&, const Box&, const Frame<3>&,
                                           const Imbalance<3>&);

}  // namespace grseg
