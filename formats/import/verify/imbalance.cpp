// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/import/verify/imbalance.hpp"

#include "formats/import/common/frame_tools.hpp"
#include "formats/import/verify/unlisted_pairs.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <Eigen/IterativeLinearSolvers>
#include <Eigen/LU>
#include <Eigen/SparseCore>
#include <algorithm>
#include <cmath>
#include <limits>

namespace grseg {
namespace {

/// Fraction of the missing forces (or grains) that a cause must explain, at least.
constexpr double most = 0.8;
/// Largest distance from a side of the bed for a grain at this side, and smallest overlap that
/// counts as deep, in units of the radius.
constexpr double at_face = 0.3, deep = 0.1;
/// Smallest normal component of a missing wall force, relative to its magnitude: allows friction
/// coefficients up to 1.7.
constexpr double along_normal = 0.5;

/// A side of the bed: the lower or upper end along an axis of the flow.
struct Side {
  int axis = 0;
  bool upper = false;
  double position = 0;
};

/// Outward coordinate of a grain's edge at this side; its largest value over all grains is the
/// position of the side.
double reach(const Imbalance& imbalance, std::size_t g, const Side& side)
{
  const double x = imbalance.frame.position[g][side.axis], radius = imbalance.grains.radius[g];
  return side.upper ? x + radius : radius - x;
}

std::vector<Side> open_sides(const Imbalance& imbalance)
{
  const auto& [grains, box, frame, defect, limit] = imbalance;
  std::vector<Side> sides;
  for (int axis = 0; axis < 3; ++axis) {
    if ((axis == 2 && box.dimension == 2) || (axis == 0 && box.periodic_x) ||
        (axis == 2 && box.periodic_z))
      continue;
    for (const bool upper : {false, true}) {
      Side side{axis, upper, -std::numeric_limits<double>::infinity()};
      for (std::size_t g = 0; g < grains.size(); ++g)
        if (is_mobile(grains, frame, g))
          side.position = std::max(side.position, reach(imbalance, g, side));
      sides.push_back(side);
    }
  }
  return sides;
}

std::string text_of(const Side& side, const AxisInArchive& axis)
{
  const double x = side.upper ? side.position : -side.position;
  if (axis.letter == 0)
    return fmt::format("{} end {}", side.upper ? "upper" : "lower",
                       std::array{"down the slope", "normal to the base",
                                  "across"}[static_cast<std::size_t>(side.axis)]);
  const bool high = side.upper == axis.forward;
  return fmt::format("{} {}, at about {} = {:.4g}", high ? "highest" : "lowest", axis.letter,
                     axis.letter, axis.forward ? x - axis.shift : axis.shift - x);
}

std::string missing_walls(const Imbalance& imbalance, const std::vector<std::size_t>& unbalanced,
                          const std::array<AxisInArchive, 3>& axes)
{
  const auto sides = open_sides(imbalance);
  std::vector<std::size_t> count(sides.size());
  std::size_t explained = 0;
  double missing = 0, missing_at_sides = 0;
  for (const auto g : unbalanced) {
    bool at_any = false;
    const double size = imbalance.defect[g].norm();
    missing += size;
    for (std::size_t s = 0; s < sides.size(); ++s) {
      const auto& side = sides[s];
      // The missing force, the opposite of the defect, pushes away from the side.
      const double push = (side.upper ? 1 : -1) * imbalance.defect[g][side.axis];
      if (reach(imbalance, g, side) < side.position - at_face * imbalance.grains.radius[g] ||
          push < along_normal * size)
        continue;
      ++count[s];
      at_any = true;
    }
    explained += at_any;
    if (at_any) missing_at_sides += size;
  }
  if (missing_at_sides < most * missing) return "";
  std::string where;
  for (std::size_t s = 0; s < sides.size(); ++s)
    if (count[s] > 0)
      where += fmt::format("{}{} at the {}", where.empty() ? "" : "; ", count[s],
                           text_of(sides[s], axes[static_cast<std::size_t>(sides[s].axis)]));
  return fmt::format(
      "{} a force that pushes away from it ({}): contacts with a wall are missing; "
      "name the wall, as in --wall floor=z:0, or write its contacts",
      unbalanced.size() == 1
          ? "the only grain that does not balance is at a side of the bed and lacks"
          : fmt::format("of the {} grains that do not balance {} are at a side of the "
                        "bed and lack",
                        unbalanced.size(), explained),
      where);
}

bool all_along_normals(const ContactList<3>& contacts)
{
  double normal = 0, tangential = 0;
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    const Vec3 n = contacts.branch[c].normalized();
    const double along = contacts.force[c].dot(n);
    normal += std::abs(along);
    tangential += (contacts.force[c] - along * n).norm();
  }
  return normal > 0 && tangential < 1e-4 * normal;
}

std::size_t deeply_overlapping(const Grains& grains, const ContactList<3>& contacts,
                               const std::vector<std::size_t>& unbalanced)
{
  std::vector<bool> is_deep(grains.size());
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    const auto i = row(contacts.i[c]);
    const auto j = contacts.j[c] < 0 ? i : row(contacts.j[c]);
    if (-contacts.gap[c] < deep * std::min(grains.radius[i], grains.radius[j])) continue;
    is_deep[i] = is_deep[j] = true;
  }
  return static_cast<std::size_t>(std::count_if(unbalanced.begin(), unbalanced.end(),
                                                [&](std::size_t g) { return is_deep[g]; }));
}

/// Fraction of the squares of the missing forces that a cause must explain, at least.
constexpr double most_squares = 0.95;
/// Smallest number of grains for a fit of a drag.
constexpr double fewest_dragged = 3;
/// Largest gaps of pairs in the search for partners, tried in turn, over the smaller radius.
constexpr double reaches[] = {0.02, 0.1, 0.3};

/// A pair without a listed force, and the magnitude of the force that it seems to transmit, N.
struct PairForce {
  NearPair pair;
  double force = 0;
  bool pushes = false;
};

/// Least-squares fit of the missing forces by forces between `pairs`. Returns these forces, and the
/// fraction of the squares that they explain on the grains that do not balance.
std::pair<std::vector<PairForce>, double> forces_between(const std::vector<NearPair>& pairs,
                                                         const Imbalance& imbalance)
{
  const auto& [grains, box, frame, defect, limit] = imbalance;
  const auto rows = static_cast<Eigen::Index>(3 * grains.size());
  const auto columns = static_cast<Eigen::Index>(3 * pairs.size());
  std::vector<Eigen::Triplet<double>> entries;
  Eigen::VectorXd missing = Eigen::VectorXd::Zero(rows);
  const auto is_open = [&](std::size_t g) {
    return is_mobile(imbalance.grains, imbalance.frame, g) && !std::isnan(imbalance.defect[g].y());
  };
  for (std::size_t g = 0; g < grains.size(); ++g)
    if (is_open(g)) missing.segment<3>(static_cast<Eigen::Index>(3 * g)) = -defect[g];
  for (std::size_t k = 0; k < pairs.size(); ++k)
    for (int axis = 0; axis < 3; ++axis)
      for (const auto& [grain, sign] : {std::pair{pairs[k].i, 1}, {pairs[k].j, -1}})
        if (is_open(row(grain)))
          entries.emplace_back(3 * grain + axis, static_cast<int>(3 * k) + axis, sign);
  Eigen::SparseMatrix<double> sums(rows, columns);
#ifndef __clang_analyzer__  // the analyzer follows impossible paths through Eigen
  sums.setFromTriplets(entries.begin(), entries.end());
#endif
  Eigen::LeastSquaresConjugateGradient<Eigen::SparseMatrix<double>> solver(sums);
  const Eigen::VectorXd forces = solver.solve(missing);
  const Eigen::VectorXd left = sums * forces - missing;
  double rest = 0, all = 0;
  for (std::size_t g = 0; g < grains.size(); ++g) {
    if (!imbalance.counts(g)) continue;
    rest += left.segment<3>(static_cast<Eigen::Index>(3 * g)).squaredNorm();
    all += defect[g].squaredNorm();
  }
  std::vector<PairForce> found;
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    const Vec3 force = forces.segment<3>(static_cast<Eigen::Index>(3 * k));
    if (force.norm() <= limit) continue;
    const Vec3 apart = frame.position[row(pairs[k].i)] - frame.position[row(pairs[k].j)];
    const auto branch = minimum_image(box, apart);
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
  const auto id = [&](std::int32_t of) { return grains.id[row(of)]; };
  if (pairs.size() == 1 && pairs[0].pushes)
    return fmt::format(
        "; the missing force acts between grains {} and {}, which touch: their contact is missing",
        id(largest->pair.i), id(largest->pair.j));
  const double nearest = gaps.first->pair.gap, farthest = gaps.second->pair.gap;
  return fmt::format(
      "; the missing forces act between {} pairs without a listed force, {:.2g} to {:.2g} of the "
      "smaller radius apart, opposite on the two grains (the largest: grains {} and {}): {}",
      pairs.size(), nearest, farthest, id(largest->pair.i), id(largest->pair.j),
      all_pull
          ? "attractive contacts, also across gaps, are not listed; write them as well"
          : "bonds, or another interaction, act between grains, and the listed contacts lack their "
            "stress");
}

/// Least-squares fit of a drag -k x to the missing forces of the grains that do not balance.
/// Returns k, and the fraction of the squares that the drag explains.
std::pair<double, double> drag_along(const std::vector<Vec3>& x, const Imbalance& imbalance)
{
  double xx = 0, xy = 0, all = 0, count = 0;
  for (std::size_t g = 0; g < x.size(); ++g) {
    if (!imbalance.counts(g)) continue;
    xx += x[g].squaredNorm();
    xy += x[g].dot(imbalance.defect[g]);
    all += imbalance.defect[g].squaredNorm();
    ++count;
  }
  if (!(xx > 0) || !(all > 0) || count < fewest_dragged) return {0, 0};
  return {xy / xx, xy * xy / (xx * all)};
}

/// The normal n of a contact, the component of its force along n, and n cross the force.
struct Split {
  Vec3 n;
  double normal;
  Vec3 tangential;
};
std::vector<Split> split(const ContactList<3>& contacts)
{
  std::vector<Split> all;
  all.reserve(contacts.size());
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    const Vec3 n = contacts.branch[c].normalized();
    all.push_back({n, contacts.force[c].dot(n), n.cross(contacts.force[c])});
  }
  return all;
}

std::vector<Vec3> angular_accelerations(const Grains& grains, const ContactList<3>& contacts,
                                        const std::vector<Split>& forces, double inertia)
{
  std::vector<Vec3> acceleration(grains.size(), Vec3::Zero());
  const auto add = [&](std::size_t g, const Vec3& tangential) {
    if (is_mobile(grains, g))
      acceleration[g] -= tangential / (inertia * grains.mass[g] * grains.radius[g]);
  };
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    add(row(contacts.i[c]), forces[c].tangential);
    if (contacts.j[c] >= 0) add(row(contacts.j[c]), forces[c].tangential);
  }
  return acceleration;
}

/// Largest ratio of friction to normal force; contacts with this ratio slide.
double friction_of(const std::vector<Split>& forces)
{
  double largest = 0;
  for (const auto& force : forces)
    if (force.normal > 0) largest = std::max(largest, force.tangential.norm() / force.normal);
  return largest;
}

}  // namespace

std::string likely_cause(const Imbalance& imbalance, const std::array<AxisInArchive, 3>& axes)
{
  const auto& grains = imbalance.grains;
  const auto& contacts = imbalance.frame.contacts;
  std::vector<std::size_t> unbalanced;
  for (std::size_t g = 0; g < grains.size(); ++g)
    if (imbalance.counts(g)) unbalanced.push_back(g);
  if (unbalanced.empty()) return "";
  if (unbalanced.size() == 2) {
    const Vec3 &a = imbalance.defect[unbalanced[0]], &b = imbalance.defect[unbalanced[1]];
    if ((a + b).norm() < 0.1 * (a.norm() + b.norm()))
      return fmt::format(
          "; the missing forces on grains {} and {} are opposite: "
          "their contact is missing, or has one row too many",
          grains.id[unbalanced[0]], grains.id[unbalanced[1]]);
  }
  const auto walls = missing_walls(imbalance, unbalanced, axes);
  if (!walls.empty()) return "; " + walls;
  if (all_along_normals(contacts))
    return "; all contact forces are along their normals: is the tangential part missing?";
  const auto overlapping = deeply_overlapping(grains, contacts, unbalanced);
  if (static_cast<double>(overlapping) >= most * static_cast<double>(unbalanced.size()))
    return fmt::format(
        "; {} others by more than {} of a radius: the bed may still be filling; begin later with "
        "--begin",
        unbalanced.size() == 1 ? "the only grain that does not balance overlaps"
                               : fmt::format("{} of the {} grains that do not balance overlap",
                                             overlapping, unbalanced.size()),
        deep);
  return "";
}

UnlistedForces unlisted_forces(const Imbalance& imbalance)
{
  const auto& [grains, box, frame, defect, limit] = imbalance;
  auto momentum = frame.velocity, weight = frame.velocity;
  Vec3 missing = Vec3::Zero();  // sum over grains of defect over mass
  for (std::size_t g = 0; g < grains.size(); ++g) {
    momentum[g] *= grains.mass[g];
    if (imbalance.counts(g)) missing += defect[g] / grains.mass[g];
  }
  for (std::size_t g = 0; g < grains.size(); ++g) weight[g] = grains.mass[g] * missing;
  const bool as_weight = drag_along(weight, imbalance).second >= most_squares;
  const std::pair<const std::vector<Vec3>&, const char*> drags[] = {{momentum, "momentum"},
                                                                    {frame.velocity, "velocity"}};
  for (const auto& [x, name] : drags) {
    const auto [factor, explained] = drag_along(x, imbalance);
    if (explained < most_squares || factor <= 0) continue;
    return {
        fmt::format("; the missing force is {:.4g} times the {} of each grain, and opposes it: {}",
                    factor, name,
                    as_weight ? "a drag on all grains, or another gravity; they cannot be "
                                "distinguished if all grains have the same velocity"
                              : "a drag on all grains, and neither a contact force nor another "
                                "gravity"),
        !as_weight};
  }
  const ListedPairs pushing(frame.contacts, true);
  for (const double reach : reaches) {
    const auto pairs = near_pairs(grains, box, frame, reach, [&](const NearPair& pair) {
      return !pushing.contains(pair.i, pair.j);
    });
    if (pairs.empty()) continue;
    const auto [forces, explained] = forces_between(pairs, imbalance);
    if (explained >= most_squares && !forces.empty()) return {text_of(grains, forces), false};
  }
  return {};
}

LateDamping subtract_late_damping(const Grains& grains, const Frame<3>& frame, double step,
                                  double inertia, std::vector<Vec3>& defect)
{
  const auto& contacts = frame.contacts;
  const auto forces = split(contacts);
  const auto spin_up = angular_accelerations(grains, contacts, forces, inertia);
  const double friction = friction_of(forces);
  // Missing force on every grain per unit of the coefficients c_n and c_t.
  std::vector<Vec3> per_normal(grains.size(), Vec3::Zero()), per_tangential = per_normal;
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    const auto i = row(contacts.i[c]);
    const bool wall = contacts.j[c] < 0;
    const auto j = wall ? i : row(contacts.j[c]);
    const bool pair = !wall && is_mobile(grains, j);
    const double m = grains.mass[i];
    const double mass = pair ? m * grains.mass[j] / (m + grains.mass[j]) : m;
    const auto& force = forces[c];
    Vec3 a = frame.force[i] / m;
    Vec3 rims = grains.radius[i] * spin_up[i];
    if (pair) {
      a -= frame.force[j] / grains.mass[j];
      rims += grains.radius[j] * spin_up[j];
    }
    const bool slides = force.tangential.norm() > 0.99 * friction * std::abs(force.normal);
    const Vec3 along_n = -mass * step / 2 * a.dot(force.n) * force.n;
    Vec3 along_t = Vec3::Zero();
    if (!slides) along_t = (-mass * step / 2 * (force.n.cross(a) - rims)).cross(force.n);
    per_normal[i] += along_n;
    per_tangential[i] += along_t;
    if (!pair) continue;
    per_normal[j] -= along_n;
    per_tangential[j] -= along_t;
  }
  Eigen::Matrix2d products = Eigen::Matrix2d::Zero();
  Vec2 projections = Vec2::Zero();
  for (std::size_t g = 0; g < grains.size(); ++g) {
    if (!is_mobile(grains, frame, g)) continue;
    Eigen::Matrix<double, 3, 2> columns;
    columns << per_normal[g], per_tangential[g];
    products += columns.transpose() * columns;
    projections += columns.transpose() * defect[g];
  }
  Vec2 c = products.fullPivLu().solve(projections);
  if (!(c.y() >= 0)) c = {products(0, 0) > 0 ? projections.x() / products(0, 0) : 0, 0};
  if (!(c.x() >= 0))
    c = {0, products(1, 1) > 0 ? std::max(0.0, projections.y() / products(1, 1)) : 0};
  for (std::size_t g = 0; g < grains.size(); ++g)
    defect[g] -= c.x() * per_normal[g] + c.y() * per_tangential[g];
  return {c.x(), c.y()};
}

}  // namespace grseg
