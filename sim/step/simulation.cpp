// SPDX-License-Identifier: GPL-3.0-or-later
#include "sim/step/simulation.hpp"

#include "formats/core/errors.hpp"
#include "sim/contact/parallel.hpp"
#include "sim/step/free_flight.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <stdexcept>

namespace grseg {
namespace {

// Least reference velocity of the solver (solver.hpp), in velocities that gravity, or a plate's
// load, adds to the mean grain in a step. It decides when a motionless bed has converged.
constexpr double floor_of_reference = 1e-3;

// Largest reference velocity of the solver, in velocities that the mean load of a contact gives to
// the mean grain. The mean load is the square of a mean of roots, so that a few heavy or squeezed
// grains do not dominate it. The factor was measured: in the flow of Staron & Phillips (2015) the
// median of the reference is 6.6 times that velocity, and it is above 16 times in less than one
// step of a hundred (docs/studies/accuracy.md).
constexpr double most_of_loads = 16;
// In the first step, in which boundaries may start with a jerk, the largest reference is the load's
// velocity plus this fraction of the fastest approach. Otherwise an impact that few sweeps transmit
// gains or loses a quarter of its energy.
constexpr double part_of_approach = 0.1;

// Default skin, in smallest diameters. The fastest is between 0.5 and 0.9 for every scene and
// accuracy (docs/studies/performance.md).
constexpr double fastest_skin = 0.7;

double smallest_diameter(const Grains& grains)
{
  return 2 * *std::min_element(grains.radius.begin(), grains.radius.end());
}

template <int D>
World<D> with_defaults(World<D> world)
{
  const double smallest = smallest_diameter(world.grains);
  world.law.margin = std::max(world.law.margin, least_margin * smallest);
  // The skin does not depend on the margin, because a restart may change the margin.
  if (!(world.skin > 0)) world.skin = fastest_skin * smallest;
  return world;
}

template <int D>
World<D> with_skin(World<D> world, double skin)
{
  world.skin = skin;
  return world;
}

/// Effects to compute: those whose coefficient is not 0, or all if World::general asks for them.
template <int D>
Effects effects_of(const World<D>& world)
{
  return {.friction = world.general || world.material.friction > 0,
          .rotation = world.rotation,
          .restitution = world.general || world.material.restitution > 0 || world.law.horizon > 0};
}

/// Adds the report of a part of a step to the report of the earlier parts. Numbers of contacts are
/// from the last part.
void add_part(const StepReport& part, StepReport& all)
{
  const auto before = all;
  all = part;
  all.parts += before.parts;
  if (before.parts == 0) return;
  all.solver.sweeps += before.solver.sweeps;
  all.solver.residual = std::max(all.solver.residual, before.solver.residual);
  all.solver.residual_rms = std::max(all.solver.residual_rms, before.solver.residual_rms);
  all.solver.converged = all.solver.converged && before.solver.converged;
  all.largest_overlap = std::max(all.largest_overlap, before.largest_overlap);
  all.fastest_approach = std::max(all.fastest_approach, before.fastest_approach);
  all.farthest_approach = std::max(all.farthest_approach, before.farthest_approach);
  all.largest_impulse = std::max(all.largest_impulse, before.largest_impulse);
  all.energy_gain = std::max(all.energy_gain, before.energy_gain);
  all.solved_again = all.solved_again || before.solved_again;
  all.base_impulse += before.base_impulse;
}

// An impact is a step in which the sum of all impulses more than doubles while a pair approaches
// faster than four times g h. Its impulses do not last, so each impulse that more than doubled is
// lowered to twice its first guess before it becomes the first guess of the next step. If the load
// does last, first guesses catch up in a few steps.
constexpr double most_growth_of_loads = 2;
constexpr double approach_of_impact = 4;

template <int D>
void scale(double factor, PairMemory<D>& memory)
{
  memory.n *= factor;
  for (auto& t : memory.t) t *= factor;
}

/// First guess that is lowered: its entry in Pairs, and the factor (below 1) to multiply it by.
struct LoweredGuess {
  std::size_t pair;
  double factor;
};

/// Calls use(block, origin) for each block of contacts.
template <int D, class Use>
void for_blocks(std::span<const StripContacts<D>> contacts, const Use& use)
{
  for (const auto& strip : contacts)
    for (std::size_t b = 0; b < strip.size; ++b) use(strip.blocks[b], strip.origins[b]);
}

template <int D>
double sum_of_impulses(std::span<const StripContacts<D>> contacts)
{
  double sum = 0;
  for_blocks<D>(contacts, [&](const ContactBlock<D>& block, const BlockOrigin<D>&) {
    for (const double impulse : block.impulse_n) sum += impulse;
  });
  return sum;
}

/// First guesses that an impact requires to be lowered. `guesses`: first guesses of this step, kg
/// m/s; `fall`: g h, m/s.
template <int D>
std::vector<LoweredGuess> impacts_of(std::span<const StripContacts<D>> contacts,
                                     std::span<const double> guesses, double fall)
{
  std::vector<LoweredGuess> impacts;
  auto guess = guesses.begin();
  for_blocks<D>(contacts, [&](const ContactBlock<D>& block, const BlockOrigin<D>& origin) {
    for (std::size_t lane = 0; lane < block_lanes; ++lane) {
      const double before = *guess++ + block.mass_n[lane] * fall;
      if (block.impulse_n[lane] > most_growth_of_loads * before)
        impacts.push_back(
            {origin.entry(lane), most_growth_of_loads * before / block.impulse_n[lane]});
    }
  });
  return impacts;
}

constexpr double infinity = std::numeric_limits<double>::infinity();

// Number of grains from which on several threads are faster than one.
constexpr std::size_t worth_sharing = 30000;

}  // namespace

template <int D>
Simulation<D>::Simulation(const World<D>& world, const std::vector<Vector<D>>& position)
    : world_(with_defaults(world)),
      gravity_(world.gravity),
      effects_(effects_of(world)),
      threads_(position.size() < worth_sharing ? 1 : world.threads),
      pairs_(world.walls, world.box,
             *std::max_element(world.grains.radius.begin(), world.grains.radius.end()), world_.skin,
             world_.law.margin, threads_),
      state_(make_state<D>(world.grains, position)),
      body_of_(position.size()),
      most_approach_(smallest_diameter(world.grains) / 2),
      mobile_mass_(mobile_mass(world.grains))
{
  std::iota(body_of_.begin(), body_of_.end(), 0);
}

template <int D>
Simulation<D>::Simulation(const World<D>& world, const State& state)
    : Simulation(with_skin(world, state.pairs.skin), state.position)
{
  for (std::size_t b = 0; b < state.row.size(); ++b) {
    const auto g = static_cast<std::size_t>(state.row[b]);
    state_.row[b] = state.row[b];
    state_.position[b].template head<D>() = state.position[g];
    if constexpr (D == 3) state_.position[b][3] = world_.grains.radius[g];
    state_.image[b] = state.image[g];
    state_.radius[b] = world_.grains.radius[g];
    state_.motion[b].inverse_mass = world_.grains.fixed[g] ? 0 : 1 / world_.grains.mass[g];
    state_.motion[b].rim = state.rim[g];
    for (std::size_t k = 0; k < D; ++k)
      state_.motion[b].v[k] = state.velocity[g][static_cast<Eigen::Index>(k)];
    body_of_[g] = static_cast<std::uint32_t>(b);
  }
  pairs_.restore(state_, state.pairs);
  restored_ = true;
  steps_done_ = state.steps_done;
  held_back_ = state.held_back;
  stored_ = state.stored;
}

template <int D>
auto Simulation<D>::state() const -> State
{
  State state;
  for (std::size_t g = 0; g < body_of_.size(); ++g) {
    const auto b = body_of_[g];
    state.position.push_back(point<D>(state_.position[b]));
    state.image.push_back(state_.image[b]);
    state.velocity.push_back(velocity(g));
    state.rim.push_back(state_.motion[b].rim);
  }
  state.row = state_.row;
  state.pairs = pairs_.state();
  state.steps_done = steps_done_;
  state.held_back = held_back_;
  state.stored = stored_;
  return state;
}

template <int D>
StepReport Simulation<D>::step(Frame<D>* frame)
{
  const double h = world_.step;
  StepReport report;
  report.parts = 0;
  take({}, frame, report);
  world_.step = h;
  ++steps_done_;
  return report;
}

template <int D>
void Simulation<D>::take(const Part& part, Frame<D>* frame, StepReport& report)
{
  const double length = world_.step;
  StepReport own;
  if (try_to_take(part, frame, own)) return add_part(own, report);
  const double half = std::ldexp(1, -part.halvings - 1);
  const auto lengthen_impulses = [&](double factor) {
    for (auto& memory : pairs_.pairs().memory) scale(factor, memory);
  };
  world_.step = length / 2;
  lengthen_impulses(0.5);
  take({part.begin, part.halvings + 1}, nullptr, report);
  world_.step = length / 2;
  take({part.begin + half, part.halvings + 1}, frame, report);
  lengthen_impulses(2);
}

template <int D>
bool Simulation<D>::try_to_take(const Part& part, Frame<D>* frame, StepReport& report)
{
  const double h = world_.step, whole = std::ldexp(h, part.halvings);
  const auto at = [&](double steps) { return (static_cast<double>(steps_done_) + steps) * whole; };
  const double begin = at(part.begin), middle = at(part.begin + std::ldexp(0.5, -part.halvings));
  if (gravity_.turns()) world_.gravity = gravity_.at(begin + h / 2);
  drive_boundaries(world_, begin, body_of_, state_);
  if (frame != nullptr) {
    written_step_ = h;
    before_.clear();
    for (const auto body : body_of_) before_.push_back(state_.motion[body]);
  }
  if (pairs_.renewals() == 0) renew_pairs(0);

  const double spread = move_bodies(h / 2, world_.law.forecast * h, state_, ahead_, threads_);
  const bool renewed = find_contacts(spread, report);
  if (report.farthest_approach > most_approach_ && part.halvings < most_halvings) {
    take_back(renewed);
    return false;
  }
  if (report.farthest_approach == infinity) stop_at_coincidence(begin);
  forget_impulses(renewed);
  begin_budget();
  accelerate<D>(h * world_.gravity, state_, threads_);
  accelerate_boundaries(world_, begin, body_of_, state_);
  solve(report);
  keep_impulses(report);
  if (frame != nullptr) write_frame(middle, *frame);
  state_.position.swap(ahead_);
  return true;
}

template <int D>
void Simulation<D>::take_back(bool renewed)
{
  move_bodies(-world_.step / 2, state_, threads_);
  forget_search(contacts_);
  if (!renewed) return;
  renew_pairs(0);    // at positions at which no two grains have passed each other
  restored_ = true;  // contacts_ of the previous step refer to an old list
}

template <int D>
WedgedGrains<D> Simulation<D>::wedged_grains(bool any)
{
  std::vector<std::span<ContactBlock<D>>> on_base;
  if (any)
    for (auto& strip : contacts_)
      on_base.push_back(std::span(strip.blocks).subspan(strip.on_base, strip.size - strip.on_base));
  return {on_base, state_.motion, world_.material.friction};
}

template <int D>
void Simulation<D>::solve(StepReport& report)
{
  guesses_.clear();
  if (found_.fastest_approach > approach_of_impact * impulse_of_fall() / mobile_mass_)
    for_blocks<D>(contacts_, [&](const ContactBlock<D>& block, const BlockOrigin<D>&) {
      guesses_.insert(guesses_.end(), block.impulse_n.begin(), block.impulse_n.end());
    });
  report.solver = run_solver();
}

template <int D>
SolverReport Simulation<D>::run_solver()
{
  std::vector<BlockRuns<D>> strips;
  std::size_t count = 0;
  for (std::size_t s = 0; s < contacts_.size(); ++s) {
    strips.push_back(contacts_[s].used(pairs_.bodies_of_strip(s)));
    count += contacts_[s].count;
  }
  const bool any_free = std::any_of(world_.bodies.begin(), world_.bodies.end(),
                                    [](const auto& body) { return body.free(); });
  std::optional<FreeBodies<D>> free;
  if (any_free) free.emplace(world_.bodies, body_of_, strips, state_.motion);
  // A plate that moves freely transmits its load by squeezing: no grains are treated as wedged.
  auto wedged = wedged_grains(!any_free && effects_.friction);
  const SolvedApart<D> apart{free ? &*free : nullptr, wedged.empty() ? nullptr : &wedged};
  return solve_contacts<D>(strips, state_.motion,
                           {count, world_.material.friction, effects_, world_.solver,
                            reference_range(count), threads_, apart},
                           solver_memory_);
}

template <int D>
double Simulation<D>::impulse_of_fall() const
{
  double force = world_.gravity.norm() * mobile_mass_;
  for (const auto& body : world_.bodies) force = std::max(force, std::abs(body.load));
  return force * world_.step;
}

template <int D>
ReferenceRange Simulation<D>::reference_range(std::size_t contacts) const
{
  const double fall = impulse_of_fall() / mobile_mass_;
  const auto count = static_cast<double>(contacts);
  const double load = fall + found_.root_loads * found_.root_loads / count / mobile_mass_;
  const double loaded = most_of_loads * load;
  const double most = steps_done_ == 0 ? load + part_of_approach * found_.fastest_approach
                                       : std::sqrt(loaded * loaded + found_.approaches / count);
  const double least = floor_of_reference * fall;
  if (!(most > 0)) return least;
  return {least, most};
}

template <int D>
void Simulation<D>::renew_pairs(double onward)
{
  if (world_.box.periodic_x || world_.box.periodic_z) wrap_positions(world_.box, state_, threads_);
  forecast_positions(onward, state_, ahead_, threads_);
  pairs_.renew(state_, ahead_);  // sorts the bodies
  end_known_ = false;            // a sum in another order differs by round-off
  forecast_positions(onward, state_, ahead_, threads_);
  for_ranges(threads_, state_.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t b = begin; b < end; ++b)
      body_of_[static_cast<std::size_t>(state_.row[b])] = static_cast<std::uint32_t>(b);
  });
}

template <int D>
bool Simulation<D>::find_contacts(double spread, StepReport& report)
{
  const bool renew = !pairs_.complete(ahead_);
  double unlisted = 0;
  if (renew) {
    unlisted = pairs_.fastest_unlisted(state_.motion);
    renew_pairs(world_.law.forecast * world_.step);
  }
  DetectionRule<D> rule;
  rule.ahead = ahead_;
  rule.middle = state_.position;
  rule.motion = state_.motion;
  rule.walls = world_.walls;
  rule.margin = world_.law.margin;
  rule.effects = effects_;
  rule.restitution = world_.material.restitution;
  rule.horizon = world_.law.horizon * world_.step;
  rule.periodic = world_.general || world_.box.periodic_x || world_.box.periodic_z;
  rule.only_near = pairs_.only_near();
  found_ = grseg::find_contacts(pairs_.pairs(), rule, contacts_, threads_);
  const auto& sums = found_;
  report.touching = sums.touching;
  report.sum_overlap = sums.overlap;
  report.largest_overlap = sums.largest_overlap;
  report.fastest_approach = std::max({sums.fastest_approach, unlisted, unlisted_ahead(spread)});
  report.farthest_approach = sums.coincident ? infinity : report.fastest_approach * world_.step;
  return renew;
}

template <int D>
void Simulation<D>::forget_impulses(bool renewed)
{
  if (renewed || restored_)
    pairs_.forget();
  else
    grseg::forget_impulses<D>(contacts_, pairs_.pairs(), threads_);
  restored_ = false;
}

template <int D>
double Simulation<D>::unlisted_ahead(double spread)
{
  const double half = world_.step / 2;
  // `skin` is the limit for unlisted pairs, most_approach_ for listed ones that do not act yet.
  const double farthest = std::min(world_.skin, most_approach_) - world_.law.margin;
  if (spread * half <= farthest) return 0;
  forecast_positions(world_.law.forecast * world_.step + half, state_, ahead_at_end_, threads_);
  return pairs_.complete(ahead_at_end_, farthest) ? 0 : pairs_.fastest_unlisted(state_.motion);
}

template <int D>
void Simulation<D>::stop_at_coincidence(double time) const
{
  const auto& id = world_.grains.id;
  const auto& pairs = pairs_.pairs();
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    const std::size_t i = pairs.i[k] / position_doubles<D>, j = pairs.j[k] / position_doubles<D>;
    if (j >= state_.size()) continue;
    Vector<D> apart = point<D>(state_.position[i]) - point<D>(state_.position[j]);
    apart.x() += pairs.geometry[k].shift;
    if constexpr (D == 3) apart.z() += pairs.geometry[k].shift_z;
    if (apart.norm() > 0) continue;
    const auto [first, second] = std::minmax(state_.row[i], state_.row[j]);
    throw RunError(fmt::format(
        "the centres of grains {} and {} coincide at t = {:.6g} s, so their contact has no "
        "direction; start from separate positions or use a smaller step",
        id[static_cast<std::size_t>(first)], id[static_cast<std::size_t>(second)], time));
  }
  throw std::logic_error("no pair of centres coincides");
}

template <int D>
void Simulation<D>::keep_impulses(StepReport& report)
{
  auto sums = store_impulses();
  at_end_ = motion_sums(world_.step / 2, state_, ahead_, threads_);
  double gain = energy_gain(sums.held_back);
  const double exact = work_of_fall();
  stored_ = std::min(stored_,
                     found_.strain / std::max({report.solver.sweeps, world_.solver.min_sweeps, 1}));
  const double most = held_back_ + stored_ + exact;
  report.solved_again = gain > most;
  if (report.solved_again) {
    solve_within_limit(most, report);
    sums = store_impulses();
    gain = most;
  }
  report.energy_gain = gain - held_back_;
  stored_ -=
      report.energy_gain < 0 ? report.energy_gain : std::max(report.energy_gain - exact, 0.0);
  end_known_ = true;
  held_back_ = sums.held_back;
  lower_guesses();
  report.force_bearing = sums.force_bearing;
  report.sum_gap_bearing = sums.gap_bearing;
  report.largest_impulse = sums.largest;
  report.base_impulse.head<D>() = sums.on_base_side;
}

template <int D>
ImpulseSums<D> Simulation<D>::store_impulses()
{
  return grseg::keep_impulses<D>(contacts_, pairs_.pairs(), threads_);
}

template <int D>
void Simulation<D>::lower_guesses()
{
  if (guesses_.empty() ||
      !(sum_of_impulses<D>(contacts_) > most_growth_of_loads * (found_.load + impulse_of_fall())))
    return;
  for (const auto& [pair, factor] :
       impacts_of<D>(contacts_, guesses_, impulse_of_fall() / mobile_mass_))
    scale(factor, pairs_.pairs().memory[pair]);
}

template <int D>
Vector<D> Simulation<D>::position(std::size_t g) const
{
  const auto body = body_of_[g];
  Vector<D> position = point<D>(state_.position[body]);
  position.x() += state_.image[body][0] * world_.box.length_x;
  if constexpr (D == 3) position.z() += state_.image[body][1] * world_.box.length_z;
  return position;
}

template <int D>
void Simulation<D>::drive(const std::vector<BoundaryBody>& bodies)
{
  world_.bodies = bodies;
  auto stands = world_.grains.fixed;
  for (const auto& body : bodies)
    std::fill(stands.begin() + body.begin, stands.begin() + body.end, std::uint8_t{0});
  for (std::size_t g = 0; g < stands.size(); ++g)
    if (stands[g] != 0) set_velocity(g, Vector<D>::Zero());
}

template <int D>
void Simulation<D>::set_velocity(std::size_t g, const Vector<D>& velocity,
                                 const Spin<D>& angular_velocity)
{
  auto& motion = state_.motion[body_of_[g]];
  for (std::size_t k = 0; k < D; ++k) motion.v[k] = velocity[static_cast<Eigen::Index>(k)];
  motion.rim = components_of<D>(angular_velocity * world_.grains.radius[g]);
  end_known_ = false;
}

template class Simulation<2>;
template class Simulation<3>;

}  // namespace grseg
