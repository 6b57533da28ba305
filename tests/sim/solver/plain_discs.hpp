// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "sim/contact/contact_law.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

/// Contact dynamics of discs, written as plainly as possible: every pair is tried, and contacts are
/// relaxed one by one until nothing changes (projected Gauss-Seidel). It is the reference for the
/// simulator, which does the same with pair lists, colours, vector lanes and single precision, and
/// it is where to begin reading. sim/contact/contact_law.hpp defines the symbols. Walls, driven
/// bodies, divided steps, the limit of energy and lowered first guesses after impacts are left out.
namespace grseg::plain {

struct Disc {
  Vec2 x = Vec2::Zero(), v = Vec2::Zero();  // m, m/s
  double spin = 0;                          // 1/s, positive counterclockwise
  double radius = 0, mass = 0;              // m, kg
  bool fixed = false;

  double inverse_mass() const { return fixed ? 0 : 1 / mass; }
  double inverse_inertia() const { return inverse_mass() * 2 / (radius * radius); }
};

/// Two discs that act in this step. The impulses are those on disc i.
struct Contact {
  std::size_t i = 0, j = 0;
  Vec2 n = Vec2::Zero();                     // unit normal, from j to i
  double kappa = 0, mass_n = 0, mass_t = 0;  // lever arms over radii; 1/W_nn and 1/W_tt, kg
  double rebound = 0, approach = 0;          // m/s, least u+; approach to remember in the next step
  double friction = 0;                       // Coulomb's mu of these two
  double impulse_n = 0, impulse_t = 0;       // kg m/s; of the previous step at first

  Vec2 t() const { return {-n.y(), n.x()}; }
};

class Discs {
 public:
  std::vector<Disc> disc;
  Vec2 gravity = Vec2::Zero();  // m/s^2
  double step = 0, period = 0;  // s; m, length of the cell along x
  Material material;
  LawParameters law;

  /// One step of Moreau's mid-point scheme.
  void advance()
  {
    for (auto& d : disc) d.x += step / 2 * d.v;
    find_contacts();
    for (auto& d : disc)
      if (!d.fixed) d.v += step * gravity;
    for (const auto& c : contacts_) apply(c, c.impulse_n, c.impulse_t);
    double change = 1;
    for (int sweep = 0; sweep < 200000 && change > 0; ++sweep) {
      change = 0;
      for (auto& c : contacts_) change = std::max(change, relax(c));
      if (change < 1e-15 * fastest()) change = 0;
    }
    for (auto& d : disc) d.x += step / 2 * d.v;
    last_.clear();
    for (const auto& c : contacts_)
      if (c.impulse_n > 0) last_[{c.i, c.j}] = c;
  }

  const std::vector<Contact>& contacts() const { return contacts_; }

  /// Replaces what is remembered of the previous step: impulses and approaches of pairs i < j.
  void remember(std::map<std::pair<std::size_t, std::size_t>, Contact> last)
  {
    last_ = std::move(last);
  }

 private:
  void find_contacts()
  {
    contacts_.clear();
    for (std::size_t i = 0; i < disc.size(); ++i)
      for (std::size_t j = i + 1; j < disc.size(); ++j)
        if (!disc[i].fixed || !disc[j].fixed) add_if_acting(i, j);
  }

  void add_if_acting(std::size_t i, std::size_t j)
  {
    const auto &a = disc[i], &b = disc[j];
    Vec2 apart = a.x - b.x;
    apart.x() -= period * std::round(apart.x() / period);
    const double reach = a.radius + b.radius;
    const Vec2 ahead = apart + law.forecast * step * (a.v - b.v);
    if (ahead.norm() > reach + law.margin) return;
    Contact c{.i = i, .j = j, .n = apart.normalized()};
    c.kappa = apart.norm() / reach;
    c.mass_n = 1 / (a.inverse_mass() + b.inverse_mass());
    c.mass_t = c.mass_n / (1 + 2 * c.kappa * c.kappa);
    c.friction = material.friction;
    const auto before = last_.find({i, j});
    const Contact none{};
    const auto& last = before == last_.end() ? none : before->second;
    c.impulse_n = last.impulse_n;
    c.impulse_t = last.impulse_t;
    set_rebound(c, apart.norm() - reach, c.n.dot(a.v - b.v), last.approach);
    contacts_.push_back(c);
  }

  /// Newton's restitution; a pair whose gap is open is slowed down first if the law has a horizon.
  void set_rebound(Contact& c, double gap, double u, double remembered) const
  {
    const double load = c.impulse_n / c.mass_n;
    double approach = -u;
    if (std::abs(u) <= (u > 0 ? parting_error : solver_error) * load) approach = 0;
    if (law.horizon > 0 && remembered > 0) approach = std::max(remembered, approach);
    c.rebound = material.restitution * approach;
    c.approach = 0;
    if (!(law.horizon > 0) || gap <= 0 || remembered > 0) return;
    const double closing = -gap / (law.horizon * step);
    c.rebound = std::min(closing, c.rebound);
    if (load == 0 && u < closing) c.approach = approach;
  }

  /// Adds impulses along n and t to the motion of both discs.
  void apply(const Contact& c, double along_n, double along_t)
  {
    auto &a = disc[c.i], &b = disc[c.j];
    const Vec2 p = along_n * c.n + along_t * c.t();
    a.v += a.inverse_mass() * p;
    b.v -= b.inverse_mass() * p;
    a.spin -= a.inverse_inertia() * c.kappa * a.radius * along_t;
    b.spin -= b.inverse_inertia() * c.kappa * b.radius * along_t;
  }

  /// Makes one contact obey Signorini's, Newton's and Coulomb's laws; returns the largest change of
  /// its relative velocity, m/s.
  double relax(Contact& c)
  {
    const auto &a = disc[c.i], &b = disc[c.j];
    const Vec2 relative = a.v - b.v;
    const double slip = c.t().dot(relative) - c.kappa * (a.radius * a.spin + b.radius * b.spin);
    const double n = std::max(0.0, c.impulse_n + c.mass_n * (c.rebound - c.n.dot(relative)));
    const double most = c.friction * n;
    const double t = std::clamp(c.impulse_t - c.mass_t * slip, -most, most);
    const double change_n = n - c.impulse_n, change_t = t - c.impulse_t;
    apply(c, change_n, change_t);
    c.impulse_n = n;
    c.impulse_t = t;
    return std::max(std::abs(change_n) / c.mass_n, std::abs(change_t) / c.mass_t);
  }

  double fastest() const
  {
    double most = 0;
    for (const auto& d : disc) most = std::max(most, d.v.norm());
    return most;
  }

  std::vector<Contact> contacts_;
  std::map<std::pair<std::size_t, std::size_t>, Contact> last_;  // with a force
};

}  // namespace grseg::plain
