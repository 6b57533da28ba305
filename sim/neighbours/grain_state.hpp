// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/core/frame.hpp"
#include "sim/contact/contact_law.hpp"

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <type_traits>
#include <vector>

namespace grseg {

/// Largest number of cell lengths that a grain may travel; files store the number in 32 bits.
constexpr std::int32_t most_periods = 1'000'000'000;

/// Centre of a sphere, m, and its radius, m (0 for the immobile body). One load reads all four,
/// which decide whether a pair touches. AVX loads need 32 bytes;
/// Eigen may align four doubles to 16.
struct alignas(32) SpherePosition : Eigen::Vector4d {
  SpherePosition() = default;
  template <class Other>
  SpherePosition(const Eigen::MatrixBase<Other>& other) : Eigen::Vector4d(other)
  {
  }
  template <class Other>
  SpherePosition& operator=(const Eigen::MatrixBase<Other>& other)
  {
    Eigen::Vector4d::operator=(other);
    return *this;
  }
};

/// Coordinates of a grain, m.
template <int D>
using Position = std::conditional_t<D == 2, Vec2, SpherePosition>;
template <int D>
constexpr std::uint32_t position_doubles = D == 2 ? 2 : 4;

template <int D>
Vector<D> point(const Position<D>& position)
{
  return position.template head<D>();
}

/// Displacement, m, of a grain that moves on with its velocity for `duration`, s.
template <int D>
Position<D> displacement(double duration, const Motion<D>& motion)
{
  if constexpr (D == 2)
    return duration * Vec2(motion.v[0], motion.v[1]);
  else
    // Loads all four numbers at once; the last product is 0.
    return Eigen::Map<const Eigen::Vector4d, Eigen::Aligned32>(motion.v.data())
        .cwiseProduct(Eigen::Vector4d(duration, duration, duration, 0));
}

/// Numbers of periods to add to the periodic coordinates: to x, and in three dimensions to z.
template <int D>
using Periods = Horizontal<D, std::int32_t>;

/// Variables of the grains, sorted along the cells of the pair list, so that neighbours in space
/// are near in memory. The entry after the last grain is the immobile body, which never moves: the
/// partner j of contacts at walls, and both partners in unused lanes of a block.
template <int D>
struct GrainState {
  std::vector<Position<D>> position;  // m, per grain, then the immobile body
  std::vector<Motion<D>> motion;      // per grain, then the immobile body
  std::vector<double> radius;         // m, per grain
  std::vector<Periods<D>> image;
  std::vector<std::int32_t> row;  // row of the grain in Grains

  std::size_t size() const { return row.size(); }
  /// Index of the immobile body.
  std::size_t immobile() const { return row.size(); }
  /// Resizes all arrays to the sizes of those in `other`.
  void resize_like(const GrainState& other)
  {
    position.resize(other.position.size(), Position<D>::Zero());
    motion.resize(other.motion.size());
    radius.resize(other.radius.size());
    image.resize(other.image.size());
    row.resize(other.row.size());
  }
};

/// State of grains at rest at `position`, m, in the order of their rows.
template <int D>
GrainState<D> make_state(const Grains& grains, const std::vector<Vector<D>>& position)
{
  const std::size_t count = position.size();
  GrainState<D> state;
  state.position.resize(count + 1, Position<D>::Zero());
  state.motion.resize(count + 1);
  for (std::size_t g = 0; g < count; ++g) {
    state.position[g].template head<D>() = position[g];
    if constexpr (D == 3) state.position[g][3] = grains.radius[g];
    state.motion[g].inverse_mass = grains.fixed[g] ? 0 : 1 / grains.mass[g];
  }
  state.radius = grains.radius;
  state.image.assign(count, {});
  state.row.resize(count);
  std::iota(state.row.begin(), state.row.end(), 0);
  return state;
}

}  // namespace grseg
