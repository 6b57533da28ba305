// SPDX-License-Identifier: GPL-3.0-or-later
#include "sim/step/free_flight.hpp"

#include "formats/core/errors.hpp"
#include "sim/contact/parallel.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <atomic>
#include <cmath>
#include <cstdint>

namespace grseg {

// Pointers are copied into the lambdas; otherwise the compiler reads them again for every grain.

template <int D>
void move_bodies(double duration, GrainState<D>& grains, int threads)
{
  auto* position = grains.position.data();
  const auto* motion = grains.motion.data();
  for_ranges(threads, grains.size(), [=](std::size_t begin, std::size_t end) {
    for (std::size_t b = begin; b < end; ++b) position[b] += displacement<D>(duration, motion[b]);
  });
}

template <int D>
double move_bodies(double duration, double onward, GrainState<D>& grains,
                   std::vector<Position<D>>& ahead, int threads)
{
  ahead.resize(grains.position.size());
  using Velocities = Eigen::AlignedBox<double, Position<D>::RowsAtCompileTime>;  // m/s
  std::vector<Velocities> found(range_count(grains.position.size()));
  auto *position = grains.position.data(), *then = ahead.data();
  const auto* motion = grains.motion.data();
  for_ranges(threads, grains.position.size(), [=, &found](std::size_t begin, std::size_t end) {
    Velocities here(Position<D>::Zero().eval());  // velocity of the immobile body
    for (std::size_t b = begin; b < end; ++b) {
      const Position<D> velocity = displacement<D>(1, motion[b]);
      here.extend(velocity);
      const Position<D> moved = position[b] + duration * velocity;
      position[b] = moved;
      then[b] = moved + onward * velocity;
    }
    found[begin / range_size] = here;
  });
  Velocities all;
  for (const auto& range : found) all.extend(range);
  return all.diagonal().norm();
}

template <int D>
void forecast_positions(double onward, const GrainState<D>& grains, std::vector<Position<D>>& ahead,
                        int threads)
{
  ahead.resize(grains.position.size());
  for_ranges(threads, grains.position.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t b = begin; b < end; ++b)
      ahead[b] = grains.position[b] + displacement<D>(onward, grains.motion[b]);
  });
}

template <int D>
void accelerate(const Vector<D>& change, GrainState<D>& grains, int threads)
{
  if (change == Vector<D>::Zero()) return;
  auto* motion = grains.motion.data();
  for_ranges(threads, grains.size(), [=](std::size_t begin, std::size_t end) {
    for (std::size_t b = begin; b < end; ++b) {
      if (!(motion[b].inverse_mass > 0)) continue;
      for (std::size_t k = 0; k < D; ++k) motion[b].v[k] += change[static_cast<Eigen::Index>(k)];
    }
  });
}

template <int D>
void wrap_positions(const Box& box, GrainState<D>& grains, int threads)
{
  std::atomic<bool> too_far = false;
  const auto wrap = [&](double length, double& x, std::int32_t& image) {
    const double periods = std::floor(x / length);
    if (std::abs(image + periods) > most_periods) {
      too_far = true;
      return;
    }
    x -= periods * length;
    image += static_cast<std::int32_t>(periods);
  };
  for_ranges(threads, grains.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t b = begin; b < end; ++b) {
      auto& x = grains.position[b];
      auto& image = grains.image[b];
      if (box.periodic_x) wrap(box.length_x, x[0], image[0]);
      if (D == 3 && box.periodic_z) wrap(box.length_z, x[D - 1], image[D - 2]);
    }
  });
  if (too_far)
    throw RunError(fmt::format(
        "a grain has crossed the periodic cell more than {} times, the limit of the file format; "
        "choose a shorter duration or a longer cell",
        most_periods));
}

template <int D>
void drive_boundaries(const World<D>& world, double time, std::span<const std::uint32_t> body_of,
                      GrainState<D>& grains)
{
  const double h = world.step;
  for (const auto& body : world.bodies)
    for (auto row = body.begin; row < body.end; ++row) {
      auto& motion = grains.motion[body_of[row]];
      const Vec2 position = grains.position[body_of[row]].template head<2>();
      const Vec2 velocity = velocity_at_begin(body, position, time, h);
      motion.v[0] = velocity.x();
      if (!body.free()) motion.v[1] = velocity.y();
      motion.rim.back() = time < 0 ? 0 : body.spin * world.grains.radius[row];
    }
}

template <int D>
void accelerate_boundaries(const World<D>& world, double time,
                           std::span<const std::uint32_t> body_of, GrainState<D>& grains)
{
  const double h = world.step;
  for (const auto& body : world.bodies)
    for (auto row = body.begin; row < body.end; ++row) {
      auto& v = grains.motion[body_of[row]].v;
      const Vec2 position = grains.position[body_of[row]].template head<2>();
      const Vec2 change = velocity_change(body, position, time, h);
      v[0] += change.x();
      v[1] += body.free() ? h * body.load / body.mass : change.y();
    }
}

template void move_bodies(double, GrainState<2>&, int);
template double move_bodies(double, double, GrainState<2>&, std::vector<Position<2>>&, int);
template void forecast_positions(double, const GrainState<2>&, std::vector<Position<2>>&, int);
template void accelerate<2>(const Vector<2>&, GrainState<2>&, int);
template void wrap_positions(const Box&, GrainState<2>&, int);
template void drive_boundaries(const World<2>&, double, std::span<const std::uint32_t>,
                               GrainState<2>&);
template void accelerate_boundaries(const World<2>&, double, std::span<const std::uint32_t>,
                                    GrainState<2>&);
template void move_bodies(double, GrainState<3>&, int);
template double move_bodies(double, double, GrainState<3>&, std::vector<Position<3>>&, int);
template void forecast_positions(double, const GrainState<3>&, std::vector<Position<3>>&, int);
template void accelerate<3>(const Vector<3>&, GrainState<3>&, int);
template void wrap_positions(const Box&, GrainState<3>&, int);
template void drive_boundaries(const World<3>&, double, std::span<const std::uint32_t>,
                               GrainState<3>&);
template void accelerate_boundaries(const World<3>&, double, std::span<const std::uint32_t>,
                                    GrainState<3>&);

}  // namespace grseg
