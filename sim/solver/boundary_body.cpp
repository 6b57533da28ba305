// SPDX-License-Identifier: GPL-3.0-or-later
#include "sim/solver/boundary_body.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace grseg {

Vec2 displacement(const BoundaryBody& body, double time)
{
  if (time <= 0) return Vec2::Zero();
  return body.velocity * time + body.amplitude * std::sin(body.angular_frequency * time);
}

Vec2 chord_velocity(const BoundaryBody& body, const Vec2& position, double time, double step)
{
  const Vec2 now = displacement(body, time);
  Vec2 velocity = (displacement(body, time + step) - now) / step;
  if (body.spin != 0 && time + step > 0) {
    const double angle = body.spin * step, half = std::sin(angle / 2);
    const Vec2 arm = position - body.centre - now;
    const Vec2 across{-arm.y(), arm.x()};
    velocity += (std::sin(angle) * across - 2 * half * half * arm) / step;
  }
  return velocity;
}

namespace {

// A body's velocity has settled when it changes by no more than this part of what a sweep made it
// change. Measured: from 1e-4 on a bed between plates no longer creeps (docs/studies/scenes.md).
constexpr double body_settled = 1e-6;
constexpr int most_body_rounds = 40;

}  // namespace

FreeBodies::FreeBodies(std::span<const BoundaryBody> bodies, std::span<const std::uint32_t> place,
                       std::span<const BlockRuns> strips, std::span<const Motion> motion)
{
  constexpr auto nobody = std::numeric_limits<std::uint32_t>::max();
  std::vector<std::uint32_t> body_at(motion.size(), nobody);  // by place
  for (const auto& body : bodies) {
    if (!body.free()) continue;
    Body own{body.mass, 0, {}, {}};
    for (auto row = body.begin; row < body.end; ++row) {
      own.members.push_back(place[row]);
      body_at[place[row]] = static_cast<std::uint32_t>(bodies_.size());
    }
    own.free_velocity = motion[own.members.front()].vy;
    bodies_.push_back(std::move(own));
  }
  for (const auto& strip : strips)
    for (auto& block : strip.blocks)
      for (std::uint32_t lane = 0; lane < block_lanes; ++lane) {
        const ContactPlace contact{&block, lane};
        const auto body = body_at[contact.j()];
        if (body != nobody) bodies_[body].contacts.push_back(contact);
      }
}

double FreeBodies::update_velocities(std::span<Motion> motion)
{
  double largest = 0;
  for (const auto& body : bodies_) {
    double impulse = 0, answer = 0;
    for (const auto& [block, lane] : body.contacts) {
      const double nx = block->nx[lane], ny = block->ny[lane];
      impulse -= block->impulse_n[lane] * ny + block->impulse_t[lane] * nx;
      if (block->impulse_n[lane] > 0)
        answer += block->mass_n[lane] * ny * ny + block->mass_t[lane] * nx * nx;
    }
    const double velocity = motion[body.members.front()].vy;
    const double change =
        (body.mass * (body.free_velocity - velocity) + impulse) / (body.mass + answer);
    for (const auto member : body.members) motion[member].vy = velocity + change;
    largest = std::max(largest, std::abs(change));
  }
  return largest;
}

double FreeBodies::balance(std::span<Motion> motion, double friction, Effects effects)
{
  double largest = 0;
  for (int round = 0; round < most_body_rounds; ++round) {
    relax_contacts(motion, friction, effects);
    const double change = update_velocities(motion);
    largest = std::max(largest, change);
    if (change <= body_settled * largest) break;
  }
  relax_contacts(motion, friction, effects);
  return largest;
}

void FreeBodies::relax_contacts(std::span<Motion> motion, double friction, Effects effects)
{
  const auto relax_alone = choose_relax(effects);
  for (const auto& body : bodies_)
    for (const auto& contact : body.contacts)
      contact.relax(relax_alone, effects.restitution, motion, friction);
}

}  // namespace grseg
