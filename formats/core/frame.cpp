// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/core/frame.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace grseg {

template <int D>
void ContactList<D>::clear()
{
  i.clear();
  j.clear();
  force.clear();
  branch.clear();
  gap.clear();
}

template <int D>
void ContactList<D>::reserve(std::size_t contacts)
{
  i.reserve(contacts);
  j.reserve(contacts);
  force.reserve(contacts);
  branch.reserve(contacts);
  gap.reserve(contacts);
}

template struct ContactList<2>;
template struct ContactList<3>;

template <int D>
double mean_density(const Grains& grains, std::optional<Species> species)
{
  double mass = 0, content = 0;
  for (std::size_t g = 0; g < grains.size(); ++g) {
    if (!is_mobile(grains, g) || (species && grains.species[g] != *species)) continue;
    mass += grains.mass[g];
    content += grain_volume<D>(grains.radius[g]);
  }
  return content > 0 ? mass / content : 0;
}

template <int D>
bool have_one_density(const Grains& grains)
{
  double least = std::numeric_limits<double>::infinity(), most = 0;
  for (std::size_t g = 0; g < grains.size(); ++g) {
    if (!is_mobile(grains, g)) continue;
    const double density = grains.mass[g] / grain_volume<D>(grains.radius[g]);
    least = std::min(least, density);
    most = std::max(most, density);
  }
  return most <= least * (1 + 1e-5);
}

template double mean_density<2>(const Grains&, std::optional<Species>);
template double mean_density<3>(const Grains&, std::optional<Species>);
template bool have_one_density<2>(const Grains&);
template bool have_one_density<3>(const Grains&);

/// Sum of one pseudo-random number (SplitMix64) per absent grain, computed from its row.
template <int D>
std::uint64_t which_are_absent(const Frame<D>& frame)
{
  std::uint64_t sum = 0;
  for (std::size_t g = 0; g < frame.position.size(); ++g) {
    if (is_present(frame, g)) continue;
    std::uint64_t mixed = (g + 1) * 0x9e3779b97f4a7c15U;
    mixed = (mixed ^ (mixed >> 30U)) * 0xbf58476d1ce4e5b9U;
    mixed = (mixed ^ (mixed >> 27U)) * 0x94d049bb133111ebU;
    sum += mixed ^ (mixed >> 31U);
  }
  return sum;
}

template std::uint64_t which_are_absent(const Frame<2>&);
template std::uint64_t which_are_absent(const Frame<3>&);

template <int D>
void make_absent(Frame<D>& frame, std::size_t g)
{
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  frame.position[g].setConstant(nan);
  if (!frame.image.empty()) frame.image[g].fill(0);
  if (!frame.velocity.empty()) {
    frame.velocity[g].setConstant(nan);
    if constexpr (D == 2)
      frame.angular_velocity[g] = nan;
    else
      frame.angular_velocity[g].setConstant(nan);
  }
  if (!frame.force.empty()) frame.force[g].setConstant(nan);
}

template void make_absent(Frame<2>&, std::size_t);
template void make_absent(Frame<3>&, std::size_t);

template <int D>
double share_of_first(const Grains& grains, const ContactList<D>& contacts, std::size_t contact)
{
  const auto j = contacts.j[contact];
  if (j < 0) return 1;
  const double radius_i = grains.radius[static_cast<std::size_t>(contacts.i[contact])];
  const double radius_j = grains.radius[static_cast<std::size_t>(j)];
  const double gap = contacts.gap[contact];
  return (radius_i + gap / 2) / (radius_i + radius_j + gap);
}

template <int D>
Vector<D> contact_point(const Grains& grains, const Frame<D>& frame, std::size_t contact)
{
  const auto i = static_cast<std::size_t>(frame.contacts.i[contact]);
  return frame.position[i] -
         share_of_first(grains, frame.contacts, contact) * frame.contacts.branch[contact];
}

template double share_of_first(const Grains&, const ContactList<2>&, std::size_t);
template double share_of_first(const Grains&, const ContactList<3>&, std::size_t);
template Vec2 contact_point(const Grains&, const Frame<2>&, std::size_t);
template Vec3 contact_point(const Grains&, const Frame<3>&, std::size_t);

template <int D>
Vector<D> Gravity<D>::at(double time) const
{
  if (!turns()) return start;
  const double angle = slope_rate * std::max(time, 0.0);
  const double c = std::cos(angle), s = std::sin(angle);
  // A slope that becomes steeper turns gravity from -y towards +x.
  Vector<D> turned = start;
  turned.x() = c * start.x() - s * start.y();
  turned.y() = s * start.x() + c * start.y();
  return turned;
}

template <int D>
Vector<D> Gravity<D>::mean(double last, std::int64_t steps, double step) const
{
  if (!turns()) return start;
  // Mean of vectors of equal length, each turned by `angle` from the one before (Dirichlet kernel).
  const double angle = slope_rate * step, half = angle / 2;
  const auto count = static_cast<double>(steps);
  return std::sin(count * half) / (count * std::sin(half)) * at(last - (count - 1) * step / 2);
}

template struct Gravity<2>;
template struct Gravity<3>;

}  // namespace grseg
