// SPDX-License-Identifier: GPL-3.0-or-later
#include "sim/solver/solved_apart.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace grseg {
namespace {

// A free body's velocity has settled if a round changes it by at most this fraction of the largest
// change since the sweep. Measured: a bed between plates no longer creeps at 1e-4 or less
// (docs/studies/scenes.md).
constexpr double body_settled = 1e-6;
constexpr int most_body_rounds = 40;

// A wedged grain has settled if a round changes at most this fraction of the largest change.
constexpr double settled = 1e-3;
constexpr int most_rounds = 40;

/// Components of `direction` along the normal and the tangent of a contact.
Vec2 parts_of(const Vec2& direction, const Contact& contact)
{
  const Vec2 n(contact.nx, contact.ny), t(-contact.ny, contact.nx);
  return {direction.dot(n), direction.dot(t)};
}

/// Unit vector from contact point a to contact point b of one disc.
Vec2 line_between(const Contact& a, const Contact& b)
{
  return Vec2(a.kappa * a.nx - b.kappa * b.nx, a.kappa * a.ny - b.kappa * b.ny).normalized();
}

/// True if the bodies j of two contacts move apart, by more than round-off.
bool part(const Contact& a, const Contact& b, std::span<const Motion> motion)
{
  const auto velocity = [&](const Contact& c) {
    const auto& body = motion[static_cast<std::size_t>(c.j)];
    return Vec2(body.vx, body.vy);
  };
  const Vec2 of_a = velocity(a), of_b = velocity(b);
  return (of_b - of_a).dot(line_between(a, b)) > 1e-6 * (of_a.norm() + of_b.norm());
}

/// True if friction can lock a disc between two of its contacts. Limits the rebounds of such
/// contacts to 0, and sets their first guesses to 0 if the two bodies move apart.
bool prepare(std::span<const ContactPlace> contacts, std::span<const Motion> motion,
             double friction)
{
  bool locked = false;
  for (std::size_t k = 0; k < contacts.size(); ++k)
    for (std::size_t l = k + 1; l < contacts.size(); ++l) {
      const auto a = contacts[k].contact(), b = contacts[l].contact();
      if (!locks(a, b, friction)) continue;
      locked = true;
      const bool parting = part(a, b, motion);
      for (const auto& place : {contacts[k], contacts[l]}) {
        place.bar_rebound();
        if (parting) place.set_impulse(0, 0);
      }
    }
  return locked;
}

}  // namespace

bool locks(const Contact& a, const Contact& b, double friction)
{
  const Vec2 line = line_between(a, b), of_a = parts_of(line, a), of_b = parts_of(-line, b);
  const auto inside = [&](const Vec2& along) { return std::abs(along.y()) < friction * along.x(); };
  return inside(of_a) && inside(of_b);
}

WedgedGrains::WedgedGrains(std::span<const std::span<ContactBlock>> on_base,
                           std::span<const Motion> motion, double friction)
{
  std::vector<ContactPlace> all;
  for (const auto& blocks : on_base)
    for (auto& block : blocks)
      for (std::uint32_t lane = 0; lane < block_lanes; ++lane)
        if (motion[block.i[lane] / doubles_per_body].inverse_mass > 0)
          all.push_back({&block, lane});
  std::stable_sort(all.begin(), all.end(),
                   [](const auto& a, const auto& b) { return a.i() < b.i(); });
  for (auto begin = all.begin(); begin != all.end();) {
    const auto end =
        std::find_if(begin, all.end(), [&](const auto& p) { return p.i() != begin->i(); });
    if (prepare({begin, end}, motion, friction)) grains_.emplace_back(begin, end);
    begin = end;
  }
}

double WedgedGrains::settle(std::span<Motion> motion, double friction, Effects effects)
{
  const auto relax_alone = choose_relax(effects);
  double most = 0;
  for (const auto& contacts : grains_) {
    double largest = 0;
    for (int round = 0; round < most_rounds; ++round) {
      double change = 0;
      for (const auto& contact : contacts) {
        const auto c = contact.relax(relax_alone, effects.restitution, motion, friction);
        change = std::max({change, c.change_n, c.change_t});
      }
      largest = std::max(largest, change);
      if (change <= settled * largest) break;
    }
    most = std::max(most, largest);
  }
  return most;
}

FreeBodies::FreeBodies(std::span<const BoundaryBody> bodies, std::span<const std::uint32_t> place,
                       std::span<const BlockRuns> strips, std::span<const Motion> motion)
{
  constexpr auto nobody = std::numeric_limits<std::uint32_t>::max();
  std::vector<std::uint32_t> body_at(motion.size(), nobody);  // per index in `motion`
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
