// SPDX-License-Identifier: GPL-3.0-or-later
#include "sim/step/energy_limit.hpp"

#include "sim/contact/parallel.hpp"
#include "sim/step/simulation.hpp"

#include <algorithm>

namespace grseg {
namespace {

/// Numbers of a Motion, in the order of memory.
template <int D>
using Numbers = Eigen::Array<double, numbers_per_body<D>, 1>;

/// Kinetic energy over mass times the square of each number of a Motion.
template <int D>
Numbers<D> energy_factors()
{
  Numbers<D> factors = Numbers<D>::Zero();
  factors.template head<D>() = 0.5;
  factors.template segment<std::tuple_size_v<Turning<D, double>>>(D + 1) = inertia_factor<D> / 2;
  return factors;
}

/// Accepted error of the energies of a step, over their sum: round-off of velocities.
double round_off(Precision precision)
{
  return precision == Precision::mixed ? 1e-6 : 1e-12;
}

/// Sums over all grains; calls also(b) for each grain b in the same pass.
template <int D, class Also>
MotionSums<D> sums_over(const GrainState<D>& grains, int threads, const Also& also)
{
  struct Sums {
    Numbers<D> squares = Numbers<D>::Zero(), momenta = Numbers<D>::Zero();
  };
  std::vector<Sums> found(range_count(grains.size()));
  const auto* motion = grains.motion.data();
  for_ranges(threads, grains.size(), [=, &found](std::size_t begin, std::size_t end) {
    Sums sums;
    for (std::size_t b = begin; b < end; ++b) {
      const double inverse = motion[b].inverse_mass;
      const double mass = inverse > 0 ? 1 / inverse : 0;
      const Eigen::Map<const Numbers<D>, Eigen::Aligned32> numbers(motion[b].v.data());
      const Numbers<D> momentum = mass * numbers;
      sums.squares += momentum * numbers;
      sums.momenta += momentum;
      also(b);
    }
    found[begin / range_size] = sums;
  });
  MotionSums<D> total;
  for (const auto& sums : found) {
    total.kinetic += (energy_factors<D>() * sums.squares).sum();
    total.momentum += sums.momenta.template head<D>().matrix();
  }
  return total;
}

}  // namespace

template <int D>
MotionSums<D> motion_sums(const GrainState<D>& grains, int threads)
{
  return sums_over(grains, threads, [](std::size_t) {});
}

template <int D>
MotionSums<D> motion_sums(double duration, const GrainState<D>& grains,
                          std::vector<Position<D>>& later, int threads)
{
  later.resize(grains.position.size());
  later.back() = grains.position.back();
  const auto* position = grains.position.data();
  const auto* motion = grains.motion.data();
  auto* then = later.data();
  return sums_over(grains, threads, [=](std::size_t b) {
    then[b] = position[b] + displacement<D>(duration, motion[b]);
  });
}

double last_within(const std::array<double, 3>& f, double most)
{
  const double curved = 2 * (f[0] - 2 * f[1] + f[2]), steep = f[2] - f[0] - curved;
  double within = 0, beyond = 1;
  for (int halvings = 0; halvings < 60; ++halvings) {
    const double x = (within + beyond) / 2;
    (f[0] + x * (steep + x * curved) <= most ? within : beyond) = x;
  }
  return within;
}

template <int D>
void Simulation<D>::begin_budget()
{
  if (!end_known_) at_end_ = motion_sums(state_, threads_);
  at_begin_ = at_end_;
  bodies_before_.clear();
  for (const auto& body : world_.bodies)
    for (auto row = body.begin; row < body.end; ++row)
      bodies_before_.push_back(state_.motion[body_of_[row]]);
}

template <int D>
SurfaceMotion<D> Simulation<D>::surface_motion(std::size_t b, double lever,
                                               const Vector<D>& n) const
{
  const auto row = static_cast<std::uint32_t>(state_.row[b]);
  const auto* before = bodies_before_.data();
  for (const auto& body : world_.bodies) {
    if (row < body.begin || row >= body.end) {
      before += body.end - body.begin;
      continue;
    }
    const auto& motion = state_.motion[b];
    const Vector<D> was = vector_of(before[row - body.begin].v), now = vector_of(motion.v);
    SurfaceMotion<D> surface{(was + now) / 2, now - was};
    if (body.free()) surface.mean.y() = surface.change.y() = 0;
    const auto rim = spin_of<D>(motion.rim);
    if constexpr (D == 2)
      surface.mean += lever * rim * Vec2(-n.y(), n.x());
    else
      surface.mean += lever * rim.cross(n);
    return surface;
  }
  return {};
}

template <int D>
WorkOfBoundaries Simulation<D>::work_of_boundaries() const
{
  if (world_.bodies.empty()) return {};
  double work = 0, change = 0;
  for (const auto& strip : contacts_)
    for (std::size_t slot = strip.on_base * block_lanes; slot < strip.size * block_lanes; ++slot) {
      const auto& block = strip.blocks[slot / block_lanes];
      const std::size_t lane = slot % block_lanes, j = block.j[lane] / numbers_per_body<D>;
      if (!(block.impulse_n[lane] > 0) || j == state_.immobile()) continue;
      const auto surface = surface_motion(j, block.kappa[lane], at_lane(block.n, lane));
      const auto impulse = impulse_of(block, lane);
      work += impulse.dot(surface.mean);
      change += impulse.dot(surface.change);
    }
  const auto* before = bodies_before_.data();
  for (const auto& body : world_.bodies) {
    const double was = before->v[1], now = state_.motion[body_of_[body.begin]].v[1];
    if (body.free()) work -= (body.mass * (now - was) - body.load * world_.step) * (now + was) / 2;
    before += body.end - body.begin;
  }
  return {work, std::max(change / 2, 0.0)};
}

template <int D>
double Simulation<D>::energy_gain(double held_back) const
{
  const double by_gravity =
      world_.step * world_.gravity.dot(at_begin_.momentum + at_end_.momentum) / 2;
  const auto by_boundaries = work_of_boundaries();
  const double scale =
      at_begin_.kinetic + at_end_.kinetic + std::abs(by_gravity) + std::abs(by_boundaries.work);
  return at_end_.kinetic - at_begin_.kinetic - by_gravity - by_boundaries.work -
         by_boundaries.push + held_back - round_off(world_.solver.precision) * scale;
}

template <int D>
double Simulation<D>::work_of_fall() const
{
  const auto falling = [&](double mass, double force) {
    return force * force * world_.step * world_.step / (8 * mass);
  };
  double most = falling(mobile_mass_, mobile_mass_ * world_.gravity.norm());
  for (const auto& body : world_.bodies)
    if (body.free()) most += falling(body.mass, body.load);
  return most;
}

/// Calls use(numbers) for each array of eight impulses, in the order of a solution.
template <int D, class Use>
void for_impulses(std::vector<StripContacts<D>>& contacts, const Use& use)
{
  for (auto& strip : contacts)
    for (auto& block : std::span(strip.blocks).first(strip.size)) {
      use(block.impulse_n);
      for (auto& t : block.impulse_t) use(t);
    }
}

template <int D>
Eigen::VectorXd Simulation<D>::solution()
{
  std::vector<double> all;
  for_impulses(contacts_, [&](const Lanes& impulses) {
    all.insert(all.end(), impulses.begin(), impulses.end());
  });
  const auto* before = bodies_before_.data();
  for (const auto& body : world_.bodies) {
    const double change = state_.motion[body_of_[body.begin]].v[1] - before->v[1];
    all.push_back(body.free() ? change - world_.step * body.load / body.mass : 0);
    before += body.end - body.begin;
  }
  return Eigen::Map<Eigen::VectorXd>(all.data(), static_cast<Eigen::Index>(all.size()));
}

template <int D>
void Simulation<D>::set_impulses(const Eigen::VectorXd& solution)
{
  const double* next = solution.data();
  for_impulses(contacts_, [&](Lanes& impulses) {
    std::copy_n(next, block_lanes, impulses.begin());
    next += block_lanes;
  });
}

template <int D>
void Simulation<D>::apply(const Eigen::VectorXd& solution)
{
  set_impulses(solution);
  for (auto& strip : contacts_)
    apply_impulses<D>(std::span(strip.blocks).first(strip.size), state_.motion.data(), effects_);
  const auto bodies = solution.tail(static_cast<Eigen::Index>(world_.bodies.size()));
  for (Eigen::Index k = 0; k < bodies.size(); ++k) {
    const auto& body = world_.bodies[static_cast<std::size_t>(k)];
    for (auto row = body.begin; row < body.end; ++row)
      state_.motion[body_of_[row]].v[1] += bodies[k];
  }
}

template <int D>
void Simulation<D>::stop_rebounds()
{
  for (auto& strip : contacts_)
    for (auto& block : std::span(strip.blocks).first(strip.size))
      for (auto& rebound : block.rebound) rebound = std::min(rebound, 0.0);
}

template <int D>
void Simulation<D>::stop_later_rebounds()
{
  for (auto& strip : contacts_)
    for (auto& origin : std::span(strip.origins).first(strip.size)) origin.approach.fill(0);
}

template <int D>
void Simulation<D>::solve_within_limit(double most, StepReport& report)
{
  Eigen::VectorXd above = solution();
  apply(-above);
  set_impulses(above);
  stop_rebounds();
  report.solver.sweeps += run_solver().sweeps;
  Eigen::VectorXd within = solution();
  apply(-within);
  const auto gain_of = [&](const Eigen::VectorXd& trial) {
    apply(trial);
    at_end_ = motion_sums(state_, threads_);
    const double gain = energy_gain(store_impulses().held_back);
    apply(-trial);
    return gain;
  };
  if (gain_of(within) > most) stop_later_rebounds();
  if (gain_of(within) > most) {
    above = within;
    within.setZero();
  }
  const Eigen::VectorXd middle = (within + above) / 2;
  const double part = last_within({gain_of(within), gain_of(middle), gain_of(above)}, most);
  apply(within + part * (above - within));
  at_end_ = motion_sums(world_.step / 2, state_, ahead_, threads_);
}

template MotionSums<2> motion_sums(const GrainState<2>&, int);
template MotionSums<3> motion_sums(const GrainState<3>&, int);
template MotionSums<2> motion_sums(double, const GrainState<2>&, std::vector<Position<2>>&, int);
template MotionSums<3> motion_sums(double, const GrainState<3>&, std::vector<Position<3>>&, int);
template void Simulation<2>::begin_budget();
template double Simulation<2>::energy_gain(double) const;
template double Simulation<2>::work_of_fall() const;
template void Simulation<2>::solve_within_limit(double, StepReport&);
template void Simulation<3>::begin_budget();
template double Simulation<3>::energy_gain(double) const;
template double Simulation<3>::work_of_fall() const;
template void Simulation<3>::solve_within_limit(double, StepReport&);

}  // namespace grseg
