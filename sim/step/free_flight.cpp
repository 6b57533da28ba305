// SPDX-License-Identifier: GPL-3.0-or-later
#include "sim/step/free_flight.hpp"

#include "sim/contact/parallel.hpp"

#include <cmath>

namespace grseg {

// Plain pointers, captured by value, or the compiler fetches them anew for every grain.

void move_bodies(double duration, GrainState& grains, int threads)
{
  auto* position = grains.position.data();
  const auto* motion = grains.motion.data();
  for_ranges(threads, grains.size(), [=](std::size_t begin, std::size_t end) {
    for (std::size_t b = begin; b < end; ++b)
      position[b] += duration * Vec2(motion[b].vx, motion[b].vy);
  });
}

void move_bodies(double duration, double onward, GrainState& grains, std::vector<Vec2>& ahead,
                 int threads)
{
  ahead.resize(grains.position.size());
  auto *position = grains.position.data(), *then = ahead.data();
  const auto* motion = grains.motion.data();
  for_ranges(threads, grains.position.size(), [=](std::size_t begin, std::size_t end) {
    for (std::size_t b = begin; b < end; ++b) {
      const Vec2 velocity(motion[b].vx, motion[b].vy);
      const Vec2 moved = position[b] + duration * velocity;
      position[b] = moved;
      then[b] = moved + onward * velocity;
    }
  });
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

double largest_difference(const GrainState& grains, int threads)
{
  std::vector<Vec2> low(static_cast<std::size_t>(threads), Vec2::Zero()), high = low;
  for_each_part(threads, low.size(), [&](std::size_t part) {
    const std::size_t begin = part * grains.size() / low.size();
    const std::size_t end = (part + 1) * grains.size() / low.size();
    Vec2 least = Vec2::Zero(), most = Vec2::Zero();
    for (std::size_t b = begin; b < end; ++b) {
      const Vec2 velocity(grains.motion[b].vx, grains.motion[b].vy);
      least = least.cwiseMin(velocity);
      most = most.cwiseMax(velocity);
    }
    low[part] = least;
    high[part] = most;
  });
  for (std::size_t part = 1; part < low.size(); ++part) {
    low[0] = low[0].cwiseMin(low[part]);
    high[0] = high[0].cwiseMax(high[part]);
  }
  return (high[0] - low[0]).norm();
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
  for_ranges(threads, grains.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t b = begin; b < end; ++b) {
      const double periods = std::floor(grains.position[b].x() / length);
      grains.position[b].x() -= periods * length;
      grains.image[b] += static_cast<std::int32_t>(periods);
    }
  });
}

}  // namespace grseg
