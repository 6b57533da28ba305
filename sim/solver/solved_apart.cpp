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

/// True if `direction` lies inside the friction cone of a contact.
template <int D>
bool in_cone(const Vector<D>& direction, const Contact<D>& contact, double friction)
{
  const Vector<D> n = vector_of(contact.n);
  const double along = direction.dot(n);
  double across = 0;
  if constexpr (D == 2)
    across = std::abs(direction.dot(Vec2(-n.y(), n.x())));
  else
    across = (direction - along * n).norm();
  return across < friction * along;
}

/// Unit vector from contact point a to contact point b of one grain.
template <int D>
Vector<D> line_between(const Contact<D>& a, const Contact<D>& b)
{
  return (a.kappa * vector_of(a.n) - b.kappa * vector_of(b.n)).normalized();
}

/// True if the bodies j of two contacts move apart, by more than round-off.
template <int D>
bool part(const Contact<D>& a, const Contact<D>& b, std::span<const Motion<D>> motion)
{
  const auto velocity = [&](const Contact<D>& c) {
    return vector_of(motion[static_cast<std::size_t>(c.j)].v);
  };
  const Vector<D> of_a = velocity(a), of_b = velocity(b);
  return (of_b - of_a).dot(line_between(a, b)) > 1e-6 * (of_a.norm() + of_b.norm());
}

/// True if friction can lock a grain between two of its contacts. Limits the rebounds of such
/// contacts to 0, and sets their first guesses to 0 if the two bodies move apart.
template <int D>
bool prepare(std::span<const ContactPlace<D>> contacts, std::span<const Motion<D>> motion,
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
        if (parting) place.set_impulse(0, {});
      }
    }
  return locked;
}

}  // namespace

template <int D>
bool locks(const Contact<D>& a, const Contact<D>& b, double friction)
{
  const Vector<D> line = line_between(a, b);
  return in_cone<D>(line, a, friction) && in_cone<D>(-line, b, friction);
}

template <int D>
WedgedGrains<D>::WedgedGrains(std::span<const std::span<ContactBlock<D>>> on_base,
                              std::span<const Motion<D>> motion, double friction)
{
  std::vector<ContactPlace<D>> all;
  for (const auto& blocks : on_base)
    for (auto& block : blocks)
      for (std::uint32_t lane = 0; lane < block_lanes; ++lane)
        if (motion[block.i[lane] / numbers_per_body<D>].inverse_mass > 0)
          all.push_back({&block, lane});
  std::stable_sort(all.begin(), all.end(),
                   [](const auto& a, const auto& b) { return a.i() < b.i(); });
  for (auto begin = all.begin(); begin != all.end();) {
    const auto end =
        std::find_if(begin, all.end(), [&](const auto& p) { return p.i() != begin->i(); });
    if (prepare<D>({begin, end}, motion, friction)) grains_.emplace_back(begin, end);
    begin = end;
  }
}

template <int D>
double WedgedGrains<D>::settle(std::span<Motion<D>> motion, double friction, Effects effects)
{
  const auto relax_alone = choose_relax<D>(effects);
  double most = 0;
  for (const auto& contacts : grains_) {
    double largest = 0;
    for (int round = 0; round < most_rounds; ++round) {
      double change = 0;
      for (const auto& contact : contacts) {
        const auto c = contact.relax(relax_alone, effects.restitution, motion, friction);
        change = std::max({change, c.change_n, vector_of(c.change_t).norm()});
      }
      largest = std::max(largest, change);
      if (change <= settled * largest) break;
    }
    most = std::max(most, largest);
  }
  return most;
}

template <int D>
FreeBodies<D>::FreeBodies(std::span<const BoundaryBody> bodies,
                          std::span<const std::uint32_t> place,
                          std::span<const BlockRuns<D>> strips, std::span<const Motion<D>> motion)
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
    own.free_velocity = motion[own.members.front()].v[1];
    bodies_.push_back(std::move(own));
  }
  for (const auto& strip : strips)
    for (auto& block : strip.blocks)
      for (std::uint32_t lane = 0; lane < block_lanes; ++lane) {
        const ContactPlace<D> contact{&block, lane};
        const auto body = body_at[contact.j()];
        if (body != nobody) bodies_[body].contacts.push_back(contact);
      }
}

template <int D>
double FreeBodies<D>::update_velocities(std::span<Motion<D>> motion)
{
  double largest = 0;
  for (const auto& body : bodies_) {
    double impulse = 0, answer = 0;
    for (const auto& [block, lane] : body.contacts) {
      const double nx = block->n[0][lane], ny = block->n[1][lane];
      const double t = D == 2 ? block->impulse_t[0][lane] * nx : block->impulse_t[D - 2][lane];
      const double mass_t = block->mass_t[lane];
      impulse -= block->impulse_n[lane] * ny + t;
      if (block->impulse_n[lane] > 0)
        answer +=
            block->mass_n[lane] * ny * ny + (D == 2 ? mass_t * nx * nx : mass_t * (1 - ny * ny));
    }
    const double velocity = motion[body.members.front()].v[1];
    const double change =
        (body.mass * (body.free_velocity - velocity) + impulse) / (body.mass + answer);
    for (const auto member : body.members) motion[member].v[1] = velocity + change;
    largest = std::max(largest, std::abs(change));
  }
  return largest;
}

template <int D>
double FreeBodies<D>::balance(std::span<Motion<D>> motion, double friction, Effects effects)
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

template <int D>
void FreeBodies<D>::relax_contacts(std::span<Motion<D>> motion, double friction, Effects effects)
{
  const auto relax_alone = choose_relax<D>(effects);
  for (const auto& body : bodies_)
    for (const auto& contact : body.contacts)
      contact.relax(relax_alone, effects.restitution, motion, friction);
}

template class FreeBodies<2>;
template class FreeBodies<3>;
template class WedgedGrains<2>;
template class WedgedGrains<3>;
template bool locks(const Contact<2>&, const Contact<2>&, double);
template bool locks(const Contact<3>&, const Contact<3>&, double);

}  // namespace grseg
