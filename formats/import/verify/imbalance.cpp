// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/import/verify/imbalance.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace grseg {
namespace {

/// Of what is missing, the part that a cause has to explain.
constexpr double most = 0.8;
/// In units of the radius: how near to a face of the bed a grain lies that touches it, and from
/// where on an overlap is deep.
constexpr double at_face = 0.3, deep = 0.1;
/// What is missing of a contact with a wall is along its normal at least by this part: friction
/// coefficients up to 1.7.
constexpr double along_normal = 0.5;

std::size_t row(std::int32_t index)
{
  return static_cast<std::size_t>(index);
}

/// One of the sides of the bed: the lower or upper end of an axis of the flow.
struct Side {
  int axis = 0;
  bool upper = false;
  double position = 0;
};

/// How far the near edge of a grain is outside; the largest of all grains is where the side lies.
template <int D>
double reach(const Grains& grains, const Frame<D>& frame, std::size_t g, const Side& side)
{
  const double x = frame.position[g][side.axis];
  return side.upper ? x + grains.radius[g] : grains.radius[g] - x;
}

template <int D>
std::vector<Side> open_sides(const Grains& grains, const Box& box, const Frame<D>& frame)
{
  std::vector<Side> sides;
  for (int axis = 0; axis < D; ++axis) {
    if ((axis == 0 && box.periodic_x) || (axis == 2 && box.periodic_z)) continue;
    for (const bool upper : {false, true}) {
      Side side{axis, upper, -std::numeric_limits<double>::infinity()};
      for (std::size_t g = 0; g < grains.size(); ++g)
        if (is_mobile(grains, frame, g))
          side.position = std::max(side.position, reach<D>(grains, frame, g, side));
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

template <int D>
std::string missing_walls(const Grains& grains, const Box& box, const Frame<D>& frame,
                          const Imbalance<D>& imbalance, const std::vector<std::size_t>& unbalanced,
                          const std::array<AxisInArchive, 3>& axes)
{
  const auto sides = open_sides<D>(grains, box, frame);
  std::vector<std::size_t> count(sides.size());
  std::size_t explained = 0;
  double missing = 0, missing_at_sides = 0;
  for (const auto g : unbalanced) {
    bool at_any = false;
    missing += imbalance.defect[g].norm();
    for (std::size_t s = 0; s < sides.size(); ++s) {
      const auto& side = sides[s];
      // What is missing pushes away from the side: the opposite of the defect.
      const double push = (side.upper ? 1 : -1) * imbalance.defect[g][side.axis];
      if (reach<D>(grains, frame, g, side) < side.position - at_face * grains.radius[g] ||
          push < along_normal * imbalance.defect[g].norm())
        continue;
      ++count[s];
      at_any = true;
    }
    explained += at_any;
    if (at_any) missing_at_sides += imbalance.defect[g].norm();
  }
  if (missing_at_sides < most * missing) return "";
  std::string where;
  for (std::size_t s = 0; s < sides.size(); ++s)
    if (count[s] > 0)
      where += fmt::format("{}{} at the {}", where.empty() ? "" : "; ", count[s],
                           text_of(sides[s], axes[static_cast<std::size_t>(sides[s].axis)]));
  return fmt::format(
      "{} a push away from it ({}): contacts with a wall are missing; "
      "name the wall, as in --wall floor=z:0, or write its contacts",
      unbalanced.size() == 1
          ? "the only grain that does not balance is at a side of the bed and lacks"
          : fmt::format("of the {} grains that do not balance {} are at a side of the "
                        "bed and lack",
                        unbalanced.size(), explained),
      where);
}

/// Whether two grains alone do not balance, by opposite forces.
template <int D>
bool is_pair(const Imbalance<D>& imbalance, const std::vector<std::size_t>& unbalanced)
{
  if (unbalanced.size() != 2) return false;
  const Vector<D>&a = imbalance.defect[unbalanced[0]], &b = imbalance.defect[unbalanced[1]];
  return (a + b).norm() < 0.1 * (a.norm() + b.norm());
}

template <int D>
bool all_along_normals(const ContactList<D>& contacts)
{
  double normal = 0, tangential = 0;
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    const Vector<D> n = contacts.branch[c].normalized();
    const double along = contacts.force[c].dot(n);
    normal += std::abs(along);
    tangential += (contacts.force[c] - along * n).norm();
  }
  return normal > 0 && tangential < 1e-4 * normal;
}

template <int D>
std::size_t deeply_overlapping(const Grains& grains, const ContactList<D>& contacts,
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

}  // namespace

template <int D>
std::string likely_cause(const Grains& grains, const Box& box, const Frame<D>& frame,
                         const Imbalance<D>& imbalance, const std::array<AxisInArchive, 3>& axes)
{
  std::vector<std::size_t> unbalanced;
  for (std::size_t g = 0; g < grains.size(); ++g)
    if (is_mobile(grains, g) && imbalance.defect[g].norm() > imbalance.limit)
      unbalanced.push_back(g);
  if (unbalanced.empty()) return "";
  if (is_pair<D>(imbalance, unbalanced))
    return fmt::format(
        "; what is missing on grain {} is the opposite of that on grain {}: their contact is missing, "
        "or has a row too many",
        grains.id[unbalanced[0]], grains.id[unbalanced[1]]);
  const auto walls = missing_walls<D>(grains, box, frame, imbalance, unbalanced, axes);
  if (!walls.empty()) return "; " + walls;
  if (all_along_normals<D>(frame.contacts))
    return "; all contact forces are along their normals: is the tangential part missing?";
  const auto overlapping = deeply_overlapping<D>(grains, frame.contacts, unbalanced);
  if (static_cast<double>(overlapping) >= most * static_cast<double>(unbalanced.size()))
    return fmt::format(
        "; {} of the {} grains that do not balance overlap others by more than {} of a radius: a bed "
        "that is still being filled; begin later with --begin",
        overlapping, unbalanced.size(), deep);
  return "";
}

template std::string likely_cause<2>(const Grains&, const Box&, const Frame<2>&,
                                     const Imbalance<2>&, const std::array<AxisInArchive, 3>&);
template std::string likely_cause<3>(const Grains&, const Box&, const Frame<3>&,
                                     const Imbalance<3>&, const std::array<AxisInArchive, 3>&);

}  // namespace grseg
