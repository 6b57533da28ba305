// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "sim/neighbours/grain_state.hpp"

#include <array>

/// Contacts cannot create energy, but the law of a step can. Newton's rebounds with friction may
/// raise the energy of an exact solution (Kane's example; Glocker, Multibody Syst. Dyn. 29, 77,
/// 2013), and sweeps that stop early may, too. Simulation therefore limits the work of all contacts
/// in a step,
///
///   W = sum of p . (u + u')/2, without the work of moving boundaries on the grains
///
/// with impulses p and relative velocities u, u' before and after the step, to
///
///   W + T  <=  T_before + S + B + M (g h)^2/8 + sum of (load h)^2/(8 mass) over free bodies
///
///   T  energy that pairs gave up because they are slowed down before they touch; they get it back
///      in the next step, when they rebound (ImpulseSums::held_back); T_before: of the last step
///   S  energy that contacts may return as springs. With N sweeps a contact is as soft as a spring of
///      stiffness N m/h^2, which an impulse fills with W_nn p_n^2/(2 N). S is at most the sum over the
///      impulses of the last step (DetectionSums::strain), and at most what is left of it: a step
///      lowers S by the energy that it returned, or raises it by the energy that it took
///   B  max(0, sum of p . (V' - V)/2), V and V' velocities of a moving boundary's surface before and
///      after the step
///
/// The last two terms hold for exact solutions without rebounds, where p . u' <= 0: a grain of mass m
/// whose contacts change its velocity by q adds m q . (v' - (g h + q)/2), and the sum of m q . v' is
/// the sum of p . u'. The largest value of -m q . (g h + q)/2 is m (g h)^2/8. This holds for work
/// against boundaries that move with V' during the whole step, which is W less p . (V' - V)/2.
///
/// So over any number of undriven steps energy + T rises by at most S at their begin and these two
/// terms per step.
///
/// A step above the limit is solved again without rebounds. If this solution also exceeds it, pairs
/// that it slows down do not rebound later either: T = 0. Then impulses are moved from the first
/// solution towards the second one until the limit is met; if the second one still exceeds it,
/// because sweeps stopped early, towards no impulses. Impulses stay within Coulomb's cone.
/// docs/studies/accuracy.md has the measurements.
namespace grseg {

/// Kinetic energy, J, and momentum, kg m/s, of the mobile grains.
template <int D>
struct MotionSums {
  double kinetic = 0;
  Vector<D> momentum = Vector<D>::Zero();
};
template <int D>
MotionSums<D> motion_sums(const GrainState<D>& grains, int threads);
/// Also writes the positions after `duration`, s, to `later`, in one pass.
template <int D>
MotionSums<D> motion_sums(double duration, const GrainState<D>& grains,
                          std::vector<Position<D>>& later, int threads);

/// Velocity of a point of a surface in a step, m/s: its mean, and its change.
template <int D>
struct SurfaceMotion {
  Vector<D> mean = Vector<D>::Zero(), change = Vector<D>::Zero();
};

/// Work of moving boundaries on grains, with the energy that free bodies lost, and B, J.
struct WorkOfBoundaries {
  double work = 0, push = 0;
};

/// Largest x in [0, 1] for which a parabola with the values f(0) <= most, f(1/2), f(1) > most is at
/// most `most` between 0 and x.
double last_within(const std::array<double, 3>& f, double most);

}  // namespace grseg
