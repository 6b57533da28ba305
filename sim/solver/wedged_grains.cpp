// SPDX-License-Identifier: GPL-3.0-or-later
#include "sim/solver/wedged_grains.hpp"

#include <algorithm>
#include <cmath>

namespace grseg {
namespace {

// Change of a round over the largest one.
constexpr double settled = 1e-3;
constexpr int most_rounds = 40;

/// `direction` along the normal and the tangent of a contact.
Vec2 parts_of(const Vec2& direction, const Contact& contact)
{
  const Vec2 n(contact.nx, contact.ny), t(-contact.ny, contact.nx);
  return {direction.dot(n), direction.dot(t)};
}

/// Unit vector from the point of contact a to that of contact b, which are contacts of one disc.
Vec2 line_between(const Contact& a, const Contact& b)
{
  return Vec2(a.kappa * a.nx - b.kappa * b.nx, a.kappa * a.ny - b.kappa * b.ny).normalized();
}

/// Whether the bodies of two contacts move apart, by more than round-off.
bool part(const Contact& a, const Contact& b, std::span<const Motion> motion)
{
  const auto velocity = [&](const Contact& c) {
    const auto& body = motion[static_cast<std::size_t>(c.j)];
    return Vec2(body.vx, body.vy);
  };
  const Vec2 of_a = velocity(a), of_b = velocity(b);
  return (of_b - of_a).dot(line_between(a, b)) > 1e-6 * (of_a.norm() + of_b.norm());
}

/// Whether friction can lock a disc by two of its contacts, which then need not rebound; between
/// bodies that part they bear nothing at first.
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

}  // namespace grseg
