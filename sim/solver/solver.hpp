// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "sim/contact/contact_blocks.hpp"
#include "sim/solver/boundary_body.hpp"
#include "sim/solver/extrapolation.hpp"
#include "sim/solver/sweep.hpp"

#include <span>
#include <vector>

namespace grseg {

struct SolverSettings {
  double tolerance = 1e-2;  ///< on SolverReport::residual
  int max_sweeps = 500;
  bool acceleration = false;
  /// At least so many sweeps, unless one changes nothing. A sweep passes a load on to the next
  /// grain only, so while a bed still has to find its weight small changes do not mean small
  /// errors: a bed at rest trembles if every step stops at the first or second sweep.
  int min_sweeps = 1;
};

/// How a step's solve went. Not converging is a result: it is stored and reported, not thrown.
struct SolverReport {
  int sweeps = 0;           ///< relaxations per contact, rounded up
  double residual = 0;      ///< largest change of the last sweep / reference velocity
  double residual_rms = 0;  ///< the same in the quadratic mean, which hides newcomers
  bool converged = true;
};

/// Projected Gauss-Seidel: sweeps over the contacts, each solved exactly while the others hold
/// still, until no contact's relative velocity changes by more than `tolerance` times the
/// reference velocity: the quadratic mean of W p over the `count` contacts, at least `floor` (m/s),
/// so that a motionless bed stops at once. Normal and tangential parts both count, and the largest
/// rather than the mean change decides, so that a contact which has just closed is not hidden by
/// thousands of settled ones. `min_sweeps` come first. Changes in the last digits of the fastest
/// velocity are convergence, too: without gravity loads fade, and no number of sweeps makes changes
/// small against them.
///
/// With `acceleration` sweeps are extrapolated (Extrapolation, kept by the caller to reuse its
/// memory).
///
/// Impulses in the blocks are the first guess; they are applied to `motion` here. Contacts come in
/// strips and are swept run after run: those of even strips at a time, then those of odd ones.
/// Strips that are no neighbours share no mobile body; what is summed is added strip by strip. Of
/// several strips each is swept twice before the next, and counts as swept twice. When
/// changes above the tolerance are left in a quarter of the strips or less, only these and their
/// neighbours are swept further, without extrapolation; with free bodies all are.
SolverReport solve_contacts(std::span<const BlockRuns> strips, std::size_t count,
                            std::span<Motion> motion, double friction, Effects effects,
                            const SolverSettings& settings, double floor,
                            Extrapolation& extrapolation, int threads = 1,
                            FreeBodies* free = nullptr);

}  // namespace grseg
