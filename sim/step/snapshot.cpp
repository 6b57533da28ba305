// SPDX-License-Identifier: GPL-3.0-or-later
#include "sim/step/simulation.hpp"

#include <algorithm>
#include <cmath>

namespace grseg {
namespace {

/// Contact as in a file: i < j unless j is a boundary grain; j of a wall is -1 minus its number.
template <int D>
struct NamedContact {
  std::int32_t i, j;
  bool turned;  // true if i and j are exchanged relative to Pairs
  const ContactBlock<D>* block;
  const BlockOrigin<D>* origin;
  std::size_t lane;

  bool operator<(const NamedContact& other) const
  {
    return i != other.i ? i < other.i : j < other.j;
  }
};

template <int D>
std::int32_t name_of_wall(const Pairs<D>& pairs, std::size_t pair)
{
  for (const auto& c : pairs.classes)
    if (c.begin <= pair && pair < c.end) return -c.wall - 1;
  return -1;
}

/// Moves x into [0, length), m, and adds the number of subtracted periods to `image`.
void wrap(double length, double& x, std::int32_t& image)
{
  double periods = std::floor(x / length);
  x -= periods * length;
  if (x >= length) {  // round-off for a tiny negative x
    x = 0;
    ++periods;
  }
  image += static_cast<std::int32_t>(periods);
}

}  // namespace

template <int D>
void Simulation<D>::write_contacts(ContactList<D>& list) const
{
  const auto& pairs = pairs_.pairs();
  const auto row_of = [&](std::uint32_t offset) {
    return state_.row[offset / position_doubles<D>];
  };
  std::vector<NamedContact<D>> names;
  for (const auto& strip : contacts_) {
    for (std::size_t slot = 0; slot < strip.size * block_lanes; ++slot) {
      const auto& block = strip.blocks[slot / block_lanes];
      const auto& origin = strip.origins[slot / block_lanes];
      const std::size_t lane = slot % block_lanes;
      const std::size_t k = origin.entry(lane);
      if (k == pairs.size()) continue;
      const bool at_wall = pairs.j[k] / position_doubles<D> == state_.immobile();
      const std::int32_t i = row_of(pairs.i[k]),
                         j = at_wall ? name_of_wall<D>(pairs, k) : row_of(pairs.j[k]);
      const bool turned = !at_wall && j < i && !world_.grains.fixed[static_cast<std::size_t>(j)];
      names.push_back({turned ? j : i, turned ? i : j, turned, &block, &origin, lane});
    }
  }
  std::sort(names.begin(), names.end());
  list.clear();
  list.reserve(names.size());
  for (const auto& [i, j, turned, block, origin, lane] : names) {
    const double sign = turned ? -1 : 1, gap = origin->gap[lane];
    const auto reach = [&](std::int32_t row) {
      return row < 0 ? 0 : world_.grains.radius[static_cast<std::size_t>(row)];
    };
    list.i.push_back(i);
    list.j.push_back(j);
    list.force.push_back(impulse_of(*block, lane, sign) / world_.step);
    list.branch.push_back((reach(i) + reach(j) + gap) * (sign * at_lane(block->n, lane)));
    list.gap.push_back(gap);
  }
}

template <int D>
void Simulation<D>::write_frame(double middle, Frame<D>& frame) const
{
  const std::size_t count = state_.size();
  frame.step = steps_done_;
  frame.time = middle;
  frame.position.resize(count);
  frame.image.resize(count);
  frame.velocity.resize(count);
  frame.angular_velocity.resize(count);
  frame.force.resize(count);
  for (std::size_t g = 0; g < count; ++g) {
    const auto body = body_of_[g];
    auto& position = frame.position[g] = point<D>(state_.position[body]);
    auto& image = frame.image[g] = {};
    image[0] = state_.image[body][0];
    if constexpr (D == 3) image[2] = state_.image[body][1];
    if (world_.box.periodic_x) wrap(world_.box.length_x, position[0], image[0]);
    if (D == 3 && world_.box.periodic_z) wrap(world_.box.length_z, position[D - 1], image[D - 1]);
    frame.velocity[g] = velocity(g);
    frame.angular_velocity[g] = angular_velocity(g);
    const Vector<D> change = frame.velocity[g] - vector_of(before_[g].v);
    frame.force[g] = world_.grains.mass[g] * change / world_.step;
  }
  write_contacts(frame.contacts);
}

template void Simulation<2>::write_frame(double, Frame<2>&) const;
template void Simulation<3>::write_frame(double, Frame<3>&) const;

}  // namespace grseg
