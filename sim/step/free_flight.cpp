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

void move_bodies(double duration, GrainState& grains, int threads)
{
  auto* position = grains.position.data();
  const auto* motion = grains.motion.data();
  for_ranges(threads, grains.size(), [=](std::size_t begin, std::size_t end) {
    for (std::size_t b = begin; b < end; ++b)
      position[b] += duration * Vec2(motion[b].vx, motion[b].vy);
  });
}

double move_bodies(double duration, double onward, GrainState& grains, std::vector<Vec2>& ahead,
                   int threads)
{
  ahead.resize(grains.position.size());
  using Velocities = Eigen::AlignedBox2d;  // m/s
  std::vector<Velocities> found(range_count(grains.position.size()));
  auto *position = grains.position.data(), *then = ahead.data();
  const auto* motion = grains.motion.data();
  for_ranges(threads, grains.position.size(), [=, &found](std::size_t begin, std::size_t end) {
    Velocities here(Vec2(0, 0));  // velocity of the immobile body
    for (std::size_t b = begin; b < end; ++b) {
      const Vec2 velocity(motion[b].vx, motion[b].vy);
      here.extend(velocity);
      const Vec2 moved = position[b] + duration * velocity;
      position[b] = moved;
      then[b] = moved + onward * velocity;
    }
    found[begin / range_size] = here;
  });
  Velocities all;
  for (const auto& range : found) all.extend(range);
  return all.diagonal().norm();
}

void forecast_positions(double onward, const GrainState& grains, std::vector<Vec2>& ahead,
                        int threads)
{
  ahead.resize(grains.position.size());
  for_ranges(threads, grains.position.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t b = begin; b < end; ++b)
      ahead[b] = grains.position[b] + onward * Vec2(grains.motion[b].vx, grains.motion[b].vy);
  });
}

void accelerate(const Vec2& change, GrainState& grains, int threads)
{
  if (change == Vec2::Zero()) return;
  auto* motion = grains.motion.data();
  const double x = change.x(), y = change.y();
  for_ranges(threads, grains.size(), [=](std::size_t begin, std::size_t end) {
    for (std::size_t b = begin; b < end; ++b) {
      if (!(motion[b].inverse_mass > 0)) continue;
      motion[b].vx += x;
      motion[b].vy += y;
    }
  });
}

void wrap_positions(double length, GrainState& grains, int threads)
{
  std::atomic<bool> too_far = false;
  for_ranges(threads, grains.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t b = begin; b < end; ++b) {
      const double periods = std::floor(grains.position[b].x() / length);
      if (std::abs(grains.image[b] + periods) > most_periods) {
        too_far = true;
        continue;
      }
      grains.position[b].x() -= periods * length;
      grains.image[b] += static_cast<std::int32_t>(periods);
    }
  });
  if (too_far)
    throw RunError(fmt::format(
        "a grain has crossed the periodic cell more than {} times, the limit of the file format; "
        "choose a shorter duration or a longer cell",
        most_periods));
}

void drive_boundaries(const World& world, double time, std::span<const std::uint32_t> body_of,
                      GrainState& grains)
{
  for (const auto& body : world.bodies)
    for (auto row = body.begin; row < body.end; ++row) {
      auto& motion = grains.motion[body_of[row]];
      const auto velocity = chord_velocity(body, grains.position[body_of[row]], time, world.step);
      motion.vx = velocity.x();
      if (!body.free()) motion.vy = velocity.y();
      motion.rim_speed = time + world.step > 0 ? body.spin * world.grains.radius[row] : 0;
    }
}

void apply_loads(const World& world, double duration, std::span<const std::uint32_t> body_of,
                 GrainState& grains)
{
  for (const auto& body : world.bodies)
    if (body.free())
      for (auto row = body.begin; row < body.end; ++row)
        grains.motion[body_of[row]].vy += duration * body.load / body.mass;
}

}  // namespace grseg
