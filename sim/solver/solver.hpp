// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "sim/contact/contact_blocks.hpp"
#include "sim/solver/extrapolation.hpp"
#include "sim/solver/single_contacts.hpp"
#include "sim/solver/solved_apart.hpp"
#include "sim/solver/sweep.hpp"

#include <limits>
#include <span>
#include <vector>

namespace grseg {

/// Precision in which sweeps relax contacts. `mixed` is single precision: a contact's relative
/// velocity is then off by some 1e-7 of the fastest velocity, far below the tolerance of a flow.
/// All else is done in double precision. Sweeps find increments on the first guesses, which are
/// added to impulses and velocities at the end, so that momentum and angular momentum balance to
/// round-off.
enum class Precision { mixed, doubles };

struct SolverSettings {
  double tolerance = 1e-2;  ///< on SolverReport::residual
  int max_sweeps = 500;
  bool acceleration = false;
  /// Least number of sweeps, unless one changes nothing (see solve_contacts). A sweep passes a load
  /// on to the next grain only, so while a bed still has to find its weight small changes do not
  /// mean small errors: such a bed is soft if every step stops at the first or second sweep.
  int min_sweeps = 1;
  Precision precision = Precision::doubles;
};

/// Memory of the solver, kept by the caller from step to step.
struct SolverMemory {
  ExtrapolationOf<double> doubles;
  ExtrapolationOf<float> singles;
  SingleContacts contacts;
  std::vector<Motion> free_flight;
};

/// m/s, the range of the velocity that changes are compared with.
struct ReferenceRange {
  double least, most;

  ReferenceRange(double at_least, double at_most = std::numeric_limits<double>::infinity())
      : least(at_least), most(at_most)
  {
  }
};

/// A solve apart from its contacts and bodies.
struct SolverTask {
  std::size_t count;  // of contacts
  double friction;
  Effects effects;
  SolverSettings settings;
  ReferenceRange range;
  int threads = 1;
  SolvedApart apart = {};
};

/// Outcome of a step's solve. Not converging is a result: it is stored and reported, not thrown.
struct SolverReport {
  int sweeps = 0;           ///< relaxations per contact, rounded up
  double residual = 0;      ///< largest change of the last sweep / reference velocity
  double residual_rms = 0;  ///< the same in the quadratic mean, which hides newcomers
  bool converged = true;
};

/// Projected Gauss-Seidel: sweeps over the contacts, each solved exactly while the others hold
/// still. Impulses in the blocks are the first guess; they are applied to `motion` here, whose last
/// entry is the body that never moves.
///
/// The solve ends when no contact's relative velocity changes by more than `tolerance` times the
/// reference velocity: the quadratic mean of W p over the `count` contacts, within `range`, so that
/// a motionless bed stops at once and a few contacts of light grains under a heavy one do not count
/// for all. Normal and tangential parts both count. The largest rather than the mean change
/// decides, so that a contact which has just closed is not hidden by thousands of settled ones.
/// `min_sweeps` come first. Changes in the last digits of the fastest velocity are convergence,
/// too: without gravity loads fade, and no number of sweeps makes changes small against them.
///
/// With `acceleration` sweeps are extrapolated (ExtrapolationOf). Free bodies and wedged grains are
/// solved in double precision, whatever the setting.
///
/// Contacts come in strips and are swept run after run: first even strips, several at a time, then
/// odd ones. Strips that are not neighbours share no mobile body; sums are added strip by strip.
/// Where there are several strips, each is swept twice before the next, and counts as swept twice.
/// The first eight sweeps are never the last and never restart the extrapolation, so each strip
/// starts one as soon as its neighbours have finished theirs (Wavefront); not so with bodies that
/// are solved apart. When changes above the tolerance are left in a quarter of the strips or less,
/// only these and their neighbours are swept further, without extrapolation; with bodies that are
/// solved apart all are.
SolverReport solve_contacts(std::span<const BlockRuns> strips, std::span<Motion> motion,
                            const SolverTask& task, SolverMemory& memory);

}  // namespace grseg
