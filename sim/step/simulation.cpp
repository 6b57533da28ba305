// SPDX-License-Identifier: GPL-3.0-or-later
#include "sim/step/simulation.hpp"

#include "formats/core/errors.hpp"
#include "sim/contact/parallel.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <stdexcept>

namespace grseg {
namespace {

// A motionless bed has converged when no velocity changes by this part of g h times the tolerance.
constexpr double floor_of_reference = 1e-3;

World with_defaults(World world)
{
  const double smallest =
      2 * *std::min_element(world.grains.radius.begin(), world.grains.radius.end());
  world.law.margin = std::max(world.law.margin, least_margin * smallest);
  if (!(world.skin > 0))
    world.skin = 0.5 * smallest;  // whatever the margin: a restart may change that
  return world;
}

/// What the coefficients call for.
Effects effects_of(const World& world)
{
  return {.friction = world.general || world.material.friction > 0,
          .rotation = world.rotation,
          .restitution = world.general || world.material.restitution > 0 || world.law.horizon > 0};
}

// Fewer grains are not worth more than one thread.
constexpr std::size_t worth_sharing = 30000;

/// A grain's contacts as the file tells them: i before j, unless i does not move.
struct Named {
  std::int32_t i, j;
  bool turned;
  const ContactBlock* block;
  const BlockOrigin* origin;
  std::size_t lane;

  bool operator<(const Named& other) const { return i != other.i ? i < other.i : j < other.j; }
};

}  // namespace

Simulation::Simulation(const World& world, const std::vector<Vec2>& position)
    : world_(with_defaults(world)),
      gravity_(world.gravity),
      effects_(effects_of(world)),
      threads_(position.size() < worth_sharing ? 1 : world.threads),
      pairs_(world.walls, world.box,
             *std::max_element(world.grains.radius.begin(), world.grains.radius.end()), world_.skin,
             world_.law.margin, threads_),
      state_(make_state(world.grains, position)),
      body_of_(position.size())
{
  std::iota(body_of_.begin(), body_of_.end(), 0);
}

Simulation::Simulation(const World& world, const State& state) : Simulation(world, state.position)
{
  for (std::size_t b = 0; b < state.row.size(); ++b) {
    const auto g = static_cast<std::size_t>(state.row[b]);
    state_.row[b] = state.row[b];
    state_.position[b] = state.position[g];
    state_.image[b] = state.image[g];
    state_.radius[b] = world_.grains.radius[g];
    const double inverse_mass = world_.grains.fixed[g] ? 0 : 1 / world_.grains.mass[g];
    state_.motion[b] = {state.velocity[g].x(), state.velocity[g].y(), state.rim_speed[g],
                        inverse_mass};
    body_of_[g] = static_cast<std::uint32_t>(b);
  }
  pairs_.restore(state_, state.pairs);
  restored_ = true;
  steps_done_ = state.steps_done;
}

Simulation::State Simulation::state() const
{
  State state;
  for (std::size_t g = 0; g < body_of_.size(); ++g) {
    const auto b = body_of_[g];
    state.position.push_back(state_.position[b]);
    state.image.push_back(state_.image[b]);
    state.velocity.push_back(velocity(g));
    state.rim_speed.push_back(state_.motion[b].rim_speed);
  }
  state.row = state_.row;
  state.pairs = pairs_.state();
  state.steps_done = steps_done_;
  return state;
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
  if (gravity_.turns()) world_.gravity = gravity_.at(time() + world_.step / 2);
  drive_bodies();
  if (frame != nullptr) {
    before_.clear();
    for (const auto body : body_of_) before_.push_back(state_.motion[body]);
  }
  move_to_middle();
  find_contacts(report);
  apply_gravity(world_.step);
  apply_loads(world_.step);
  solve(report);
  keep_impulses(report);
  if (frame != nullptr) write_down(*frame);
  move_grains(world_.step / 2);
  ++steps_done_;
  return report;
}

void Simulation::solve(StepReport& report)
{
  std::vector<BlockRuns> strips;
  std::size_t count = 0;
  for (auto& strip : contacts_) {
    strips.push_back(strip.used());
    count += strip.count;
  }
  const bool any_free = std::any_of(world_.bodies.begin(), world_.bodies.end(),
                                    [](const auto& body) { return body.free(); });
  std::optional<FreeBodies> free;
  if (any_free) free.emplace(world_.bodies, body_of_, strips, state_.motion);
  report.solver =
      solve_contacts(strips, count, state_.motion, world_.material.friction, effects_,
                     world_.solver, floor_of_reference * world_.gravity.norm() * world_.step,
                     extrapolation_, threads_, any_free ? &*free : nullptr);
}

void Simulation::drive_bodies()
{
  for (const auto& body : world_.bodies)
    for (auto row = body.begin; row < body.end; ++row) {
      auto& motion = state_.motion[body_of_[row]];
      const auto velocity =
          chord_velocity(body, state_.position[body_of_[row]], time(), world_.step);
      motion.vx = velocity.x();
      if (!body.free()) motion.vy = velocity.y();
      motion.rim_speed = time() + world_.step > 0 ? body.spin * world_.grains.radius[row] : 0;
    }
}

void Simulation::apply_loads(double duration)
{
  for (const auto& body : world_.bodies)
    if (body.free())
      for (auto row = body.begin; row < body.end; ++row)
        state_.motion[body_of_[row]].vy += duration * body.load / body.mass;
}

void Simulation::move_to_middle()
{
  const double half = world_.step / 2, onward = world_.law.forecast * world_.step;
  ahead_.resize(state_.position.size());
  // Plain pointers, or the compiler fetches them anew for every grain.
  auto *position = state_.position.data(), *ahead = ahead_.data();
  const auto* motion = state_.motion.data();
  for_ranges(threads_, state_.position.size(), [=](std::size_t begin, std::size_t end) {
    for (std::size_t b = begin; b < end; ++b) {
      const Vec2 velocity(motion[b].vx, motion[b].vy);
      const Vec2 middle = position[b] + half * velocity;
      position[b] = middle;
      ahead[b] = middle + onward * velocity;
    }
  });
}

void Simulation::move_grains(double duration)
{
  auto* position = state_.position.data();
  const auto* motion = state_.motion.data();
  for_ranges(threads_, state_.size(), [=](std::size_t begin, std::size_t end) {
    for (std::size_t b = begin; b < end; ++b)
      position[b] += duration * Vec2(motion[b].vx, motion[b].vy);
  });
}

void Simulation::apply_gravity(double duration)
{
  const Vec2 change = duration * world_.gravity;
  if (change == Vec2::Zero()) return;
  auto* motion = state_.motion.data();
  for_ranges(threads_, state_.size(), [=](std::size_t begin, std::size_t end) {
    for (std::size_t b = begin; b < end; ++b) {
      if (!(motion[b].inverse_mass > 0)) continue;
      motion[b].vx += change.x();
      motion[b].vy += change.y();
    }
  });
}

void Simulation::wrap_positions()
{
  if (!world_.box.periodic_x) return;
  const double length = world_.box.length_x;
  for_ranges(threads_, state_.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t b = begin; b < end; ++b) {
      const double periods = std::floor(state_.position[b].x() / length);
      state_.position[b].x() -= periods * length;
      state_.image[b] += static_cast<std::int32_t>(periods);
    }
  });
}

void Simulation::look_ahead()
{
  const double onward = world_.law.forecast * world_.step;
  for_ranges(threads_, state_.position.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t b = begin; b < end; ++b)
      ahead_[b] = state_.position[b] + onward * Vec2(state_.motion[b].vx, state_.motion[b].vy);
  });
}

void Simulation::renew_pairs()
{
  wrap_positions();
  look_ahead();
  pairs_.renew(state_, ahead_);
  look_ahead();
  for_ranges(threads_, state_.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t b = begin; b < end; ++b)
      body_of_[static_cast<std::size_t>(state_.row[b])] = static_cast<std::uint32_t>(b);
  });
}

void Simulation::find_contacts(StepReport& report)
{
  const bool renew = !pairs_.complete(ahead_);
  const double unseen = unseen_approach();
  if (renew) renew_pairs();
  DetectionRule rule;
  rule.looked_at = ahead_;
  rule.middle = state_.position;
  rule.motion = state_.motion;
  rule.walls = world_.walls;
  rule.margin = world_.law.margin;
  rule.effects = effects_;
  rule.restitution = world_.material.restitution;
  rule.horizon = world_.law.horizon * world_.step;
  rule.periodic = world_.general || world_.box.periodic_x;
  const auto sums = grseg::find_contacts(pairs_.pairs(), rule, contacts_, threads_);
  if (sums.coincident) stop_at_coincidence();
  if (renew || restored_)
    pairs_.forget_impulses();
  else
    forget_impulses(contacts_, pairs_.impulses(), memories(), threads_);
  restored_ = false;
  report.touching = sums.touching;
  report.sum_overlap = sums.overlap;
  report.largest_overlap = sums.largest_overlap;
  report.fastest_approach = std::max(sums.fastest_approach, unseen);
}

double Simulation::unseen_approach() const
{
  if (pairs_.renewals() > 0) return pairs_.moved_in_a_step() / world_.step;
  Vec2 low = Vec2::Zero(), high = Vec2::Zero();
  for (const auto& m : state_.motion) {
    low = low.cwiseMin(Vec2(m.vx, m.vy));
    high = high.cwiseMax(Vec2(m.vx, m.vy));
  }
  const double spread = (high - low).norm();
  return spread * world_.step / 2 > world_.skin - world_.law.margin ? spread : 0;
}

std::span<Pairs::Memory> Simulation::memories()
{
  if (world_.law.horizon > 0) return pairs_.memories();
  return {};
}

void Simulation::stop_at_coincidence() const
{
  const auto& id = world_.grains.id;
  const auto& pairs = pairs_.pairs();
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    const std::size_t i = pairs.i[k] / 2, j = pairs.j[k] / 2;
    if (j >= state_.size()) continue;
    const Vec2 apart = state_.position[i] - state_.position[j] + Vec2(pairs.geometry[k].shift, 0);
    if (apart.norm() > 0) continue;
    const auto [first, second] = std::minmax(state_.row[i], state_.row[j]);
    throw RunError(fmt::format(
        "the centres of grains {} and {} coincide at t = {:.6g} s, so their contact has no "
        "direction; start from separate positions or use a smaller step",
        id[static_cast<std::size_t>(first)], id[static_cast<std::size_t>(second)], time()));
  }
  throw std::logic_error("no pair of centres coincides");
}

void Simulation::keep_impulses(StepReport& report)
{
  const auto sums = grseg::keep_impulses(contacts_, pairs_.impulses(), memories(), threads_);
  report.force_bearing = sums.force_bearing;
  report.sum_gap_bearing = sums.gap_bearing;
  report.base_impulse = sums.on_base_side;
}

void Simulation::write_down(Frame& frame) const
{
  write_down_positions(frame);
  write_down_contacts(frame.contacts);
  write_down_motion(frame);
}

void Simulation::write_down_positions(Frame& frame) const
{
  const std::size_t count = state_.size();
  frame.step = steps_done_;
  frame.position.resize(count);
  frame.image.resize(count);
  frame.time = (static_cast<double>(frame.step) + 0.5) * world_.step;
  for (std::size_t g = 0; g < count; ++g) {
    frame.position[g] = state_.position[body_of_[g]];
    frame.image[g] = {state_.image[body_of_[g]], 0};
  }
  if (!world_.box.periodic_x) return;
  const double length = world_.box.length_x;
  for (std::size_t g = 0; g < count; ++g) {
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
  const auto& pairs = pairs_.pairs();
  const auto row_of = [&](std::uint32_t twice) { return state_.row[twice / 2]; };
  std::vector<Named> names;
  for (const auto& strip : contacts_) {
    for (std::size_t slot = 0; slot < strip.size * block_lanes; ++slot) {
      const auto& block = strip.blocks[slot / block_lanes];
      const auto& origin = strip.origins[slot / block_lanes];
      const std::size_t lane = slot % block_lanes;
      const std::size_t k = origin.row[lane] / 2;
      if (k == pairs.size()) continue;
      const bool at_wall = pairs.j[k] / 2 == state_.still();
      const std::int32_t i = row_of(pairs.i[k]), j = at_wall ? wall_name(k) : row_of(pairs.j[k]);
      const bool turned = !at_wall && j < i && !world_.grains.fixed[static_cast<std::size_t>(j)];
      names.push_back({turned ? j : i, turned ? i : j, turned, &block, &origin, lane});
    }
  }
  std::sort(names.begin(), names.end());
  list.clear();
  list.reserve(names.size());
  for (const auto& [i, j, turned, block, origin, lane] : names) {
    const double sign = turned ? -1 : 1, gap = origin->gap[lane];
    const Vec2 normal{sign * block->nx[lane], sign * block->ny[lane]};
    const Vec2 tangent{-normal.y(), normal.x()};
    list.i.push_back(i);
    list.j.push_back(j);
    list.force.push_back((block->impulse_n[lane] * normal + block->impulse_t[lane] * tangent) /
                         world_.step);
    list.branch.push_back((pairs.geometry[origin->row[lane] / 2].reach + gap) * normal);
    list.gap.push_back(gap);
  }
}

std::int32_t Simulation::wall_name(std::size_t pair) const
{
  for (const auto& c : pairs_.pairs().classes)
    if (c.begin <= pair && pair < c.end) return -c.wall - 1;
  return -1;
}

void Simulation::write_down_motion(Frame& frame) const
{
  const std::size_t count = state_.size();
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
  const auto body = body_of_[g];
  return state_.position[body] + Vec2(state_.image[body] * world_.box.length_x, 0);
}

void Simulation::set_velocity(std::size_t g, const Vec2& velocity, double angular_velocity)
{
  auto& motion = state_.motion[body_of_[g]];
  motion.vx = velocity.x();
  motion.vy = velocity.y();
  motion.rim_speed = angular_velocity * world_.grains.radius[g];
}

double Simulation::translational_energy() const
{
  double energy = 0;
  for (std::size_t g = 0; g < state_.size(); ++g)
    if (!world_.grains.fixed[g]) energy += world_.grains.mass[g] * velocity(g).squaredNorm() / 2;
  return energy;
}

double Simulation::rotational_energy() const
{
  double energy = 0;
  for (std::size_t g = 0; g < state_.size(); ++g) {
    const double speed = motion(g).rim_speed;
    if (!world_.grains.fixed[g]) energy += world_.grains.mass[g] * speed * speed / 4;
  }
  return energy;
}

double Simulation::potential_energy() const
{
  double energy = 0;
  for (std::size_t g = 0; g < state_.size(); ++g)
    if (!world_.grains.fixed[g]) energy -= world_.grains.mass[g] * world_.gravity.dot(position(g));
  return energy;
}

}  // namespace grseg
