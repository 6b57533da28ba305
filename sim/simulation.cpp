// SPDX-License-Identifier: GPL-3.0-or-later
#include "sim/simulation.hpp"

#include "formats/errors.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace grseg {
namespace {

// A motionless bed has converged when no velocity changes by this part of g h times the tolerance.
constexpr double floor_of_reference = 1e-3;

double default_skin(const Grains& grains)
{
  return 0.8 * *std::min_element(grains.radius.begin(), grains.radius.end());
}

}  // namespace

Simulation::Simulation(const World& world, const std::vector<Vec2>& position)
    : world_(world),
      effects_{world.material.friction > 0, world.rotation, world.material.restitution > 0},
      pairs_(world.grains, world.walls, world.box,
             world.skin > 0 ? world.skin : default_skin(world.grains)),
      position_(position),
      image_(position.size(), {0, 0}),
      motion_(position.size() + 1)
{
  for (std::size_t g = 0; g < position_.size(); ++g)
    motion_[g].inverse_mass = world_.grains.fixed[g] ? 0 : 1 / world_.grains.mass[g];
}

StepReport Simulation::advance()
{
  return step(nullptr);
}

StepReport Simulation::advance(Frame& frame)
{
  return step(&frame);
}

StepReport Simulation::step(Frame* frame)
{
  StepReport report;
  if (frame != nullptr) before_ = motion_;
  move_grains(world_.step / 2);
  find_contacts(report);
  apply_gravity(world_.step);
  report.solver =
      solver_.solve(contacts_, motion_, world_.material.friction, effects_, world_.solver,
                    floor_of_reference * world_.gravity.norm() * world_.step);
  keep_impulses(report);
  if (frame != nullptr) write_down(*frame);
  move_grains(world_.step / 2);
  ++steps_done_;
  return report;
}

void Simulation::move_grains(double duration)
{
  for (std::size_t g = 0; g < position_.size(); ++g) {
    position_[g].x() += duration * motion_[g].vx;
    position_[g].y() += duration * motion_[g].vy;
  }
}

void Simulation::apply_gravity(double duration)
{
  for (std::size_t g = 0; g < position_.size(); ++g) {
    if (world_.grains.fixed[g]) continue;
    motion_[g].vx += duration * world_.gravity.x();
    motion_[g].vy += duration * world_.gravity.y();
  }
}

void Simulation::wrap_positions()
{
  if (!world_.box.periodic_x) return;
  const double length = world_.box.length_x;
  for (std::size_t g = 0; g < position_.size(); ++g) {
    const double periods = std::floor(position_[g].x() / length);
    position_[g].x() -= periods * length;
    image_[g][0] += static_cast<std::int32_t>(periods);
  }
}

void Simulation::find_contacts(StepReport& report)
{
  if (!pairs_.complete(position_)) {
    wrap_positions();
    pairs_.renew(world_.grains, position_);
  }
  contacts_.clear();
  pair_of_contact_.clear();
  gap_.clear();
  for (std::size_t k = 0; k < pairs_.size(); ++k) {
    const auto& pair = pairs_[k];
    const auto& at_i = position_[static_cast<std::size_t>(pair.i)];
    if (pair.j < 0) {
      const auto& wall = world_.walls[static_cast<std::size_t>(-pair.j - 1)];
      const double gap = (at_i - wall.point).dot(wall.normal) - pair.reach;
      if (gap <= 0) add_contact(k, wall.normal.x(), wall.normal.y(), 1, gap, report);
      continue;
    }
    // Component by component: a vector whose x alone is changed stalls on its way through memory.
    const auto& at_j = position_[static_cast<std::size_t>(pair.j)];
    const double x = at_i.x() - at_j.x() + pair.shift, y = at_i.y() - at_j.y();
    const double squared = x * x + y * y;
    if (squared > pair.reach * pair.reach) continue;
    const double distance = std::sqrt(squared);
    if (!(distance > 0)) stop_at_coincidence(pair);
    add_contact(k, x / distance, y / distance, distance / pair.reach, distance - pair.reach,
                report);
  }
}

void Simulation::stop_at_coincidence(const PairList::Pair& pair) const
{
  const auto& id = world_.grains.id;
  throw RunError(fmt::format(
      "the centres of grains {} and {} coincide at t = {:.6g} s, so their contact has no "
      "direction; start from separate positions or use a smaller step",
      id[static_cast<std::size_t>(pair.i)], id[static_cast<std::size_t>(pair.j)], time()));
}

void Simulation::add_contact(std::size_t pair, double nx, double ny, double kappa, double gap,
                             StepReport& report)
{
  auto& contact = contacts_.emplace_back();
  contact.i = pairs_[pair].i;
  contact.j = pairs_[pair].j < 0 ? static_cast<std::int32_t>(position_.size()) : pairs_[pair].j;
  contact.nx = nx;
  contact.ny = ny;
  contact.kappa = kappa;
  const auto& a = motion_[static_cast<std::size_t>(contact.i)];
  const auto& b = motion_[static_cast<std::size_t>(contact.j)];
  const double w_nn = a.inverse_mass + b.inverse_mass;
  contact.mass_n = 1 / w_nn;
  contact.mass_t = 1 / (w_nn * (1 + (world_.rotation ? disc_rim_factor : 0) * kappa * kappa));
  const double approach = std::max(-((a.vx - b.vx) * nx + (a.vy - b.vy) * ny), 0.0);
  contact.rebound = world_.material.restitution * approach;
  contact.impulse_n = pairs_.impulse_n[pair];
  contact.impulse_t = pairs_.impulse_t[pair];
  pair_of_contact_.push_back(pair);
  gap_.push_back(gap);
  ++report.touching;
  report.sum_overlap -= gap;
  report.largest_overlap = std::max(report.largest_overlap, -gap);
  report.fastest_approach = std::max(report.fastest_approach, approach);
}

void Simulation::keep_impulses(StepReport& report)
{
  std::fill(pairs_.impulse_n.begin(), pairs_.impulse_n.end(), 0.0);
  std::fill(pairs_.impulse_t.begin(), pairs_.impulse_t.end(), 0.0);
  for (std::size_t c = 0; c < contacts_.size(); ++c) {
    const auto& contact = contacts_[c];
    pairs_.impulse_n[pair_of_contact_[c]] = contact.impulse_n;
    pairs_.impulse_t[pair_of_contact_[c]] = contact.impulse_t;
    if (contact.impulse_n == 0) continue;
    ++report.force_bearing;
    report.sum_gap_bearing += std::abs(gap_[c]);
    if (motion_[static_cast<std::size_t>(contact.j)].inverse_mass > 0) continue;
    report.base_impulse.x() += contact.impulse_n * contact.nx - contact.impulse_t * contact.ny;
    report.base_impulse.y() += contact.impulse_n * contact.ny + contact.impulse_t * contact.nx;
  }
}

void Simulation::write_down(Frame& frame) const
{
  write_down_positions(frame);
  write_down_contacts(frame.contacts);
  write_down_motion(frame);
}

void Simulation::write_down_positions(Frame& frame) const
{
  frame.step = steps_done_;
  frame.time = (static_cast<double>(frame.step) + 0.5) * world_.step;
  frame.position = position_;
  frame.image = image_;
  if (!world_.box.periodic_x) return;
  const double length = world_.box.length_x;
  for (std::size_t g = 0; g < position_.size(); ++g) {
    double& x = frame.position[g].x();
    double periods = std::floor(x / length);
    x -= periods * length;
    if (x >= length) {  // a tiny negative x rounds up to the period itself
      x = 0;
      ++periods;
    }
    frame.image[g][0] += static_cast<std::int32_t>(periods);
  }
}

void Simulation::write_down_contacts(ContactList& list) const
{
  list.clear();
  list.reserve(contacts_.size());
  for (std::size_t c = 0; c < contacts_.size(); ++c) {
    const auto& contact = contacts_[c];
    const auto& pair = pairs_[pair_of_contact_[c]];
    const Vec2 normal{contact.nx, contact.ny}, tangent{-contact.ny, contact.nx};
    list.i.push_back(pair.i);
    list.j.push_back(pair.j);
    list.force.push_back((contact.impulse_n * normal + contact.impulse_t * tangent) / world_.step);
    list.branch.push_back((pair.reach + gap_[c]) * normal);
    list.gap.push_back(gap_[c]);
  }
}

void Simulation::write_down_motion(Frame& frame) const
{
  const std::size_t count = position_.size();
  frame.velocity.resize(count);
  frame.angular_velocity.resize(count);
  frame.force.resize(count);
  for (std::size_t g = 0; g < count; ++g) {
    frame.velocity[g] = velocity(g);
    frame.angular_velocity[g] = angular_velocity(g);
    const Vec2 change = velocity(g) - Vec2(before_[g].vx, before_[g].vy);
    frame.force[g] = world_.grains.mass[g] * change / world_.step;
  }
}

Vec2 Simulation::position(std::size_t g) const
{
  return position_[g] + Vec2(image_[g][0] * world_.box.length_x, 0);
}

void Simulation::set_velocity(std::size_t g, const Vec2& velocity, double angular_velocity)
{
  motion_[g].vx = velocity.x();
  motion_[g].vy = velocity.y();
  motion_[g].rim_speed = angular_velocity * world_.grains.radius[g];
}

double Simulation::translational_energy() const
{
  double energy = 0;
  for (std::size_t g = 0; g < position_.size(); ++g)
    if (!world_.grains.fixed[g]) energy += world_.grains.mass[g] * velocity(g).squaredNorm() / 2;
  return energy;
}

double Simulation::rotational_energy() const
{
  double energy = 0;
  for (std::size_t g = 0; g < position_.size(); ++g) {
    const double speed = motion_[g].rim_speed;
    if (!world_.grains.fixed[g]) energy += world_.grains.mass[g] * speed * speed / 4;
  }
  return energy;
}

double Simulation::potential_energy() const
{
  double energy = 0;
  for (std::size_t g = 0; g < position_.size(); ++g)
    if (!world_.grains.fixed[g]) energy -= world_.grains.mass[g] * world_.gravity.dot(position(g));
  return energy;
}

}  // namespace grseg
