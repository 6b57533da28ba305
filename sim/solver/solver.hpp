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

/// Precision in which sweeps relax contacts. `mixed`: sweeps in single precision, everything else
/// in double precision. The error of a relative velocity is then some 1e-7 of the fastest velocity,
/// far below the tolerance of a flow. Sweeps compute increments on the first guesses, which are
/// added to impulses and velocities at the end, so that momentum and angular momentum balance to
/// round-off of double precision.
enum class Precision { mixed, doubles };

struct SolverSettings {
  double tolerance = 1e-2;  ///< largest accepted SolverReport::residual
  int max_sweeps = 500;
  bool acceleration = false;  ///< extrapolate sweeps (ExtrapolationOf)
  /// Least number of sweeps, unless a sweep changes nothing (see solve_contacts). A sweep transmits
  /// a load to the next grain only. So while a load is still spreading through the bed, small
  /// changes do not mean small errors; the bed is soft if every step stops at the first or second
  /// sweep.
  int min_sweeps = 1;
  Precision precision = Precision::doubles;
};

/// Scratch space of the solver, which the caller reuses in every step.
template <int D>
struct SolverMemory {
  ExtrapolationOf<D, double> doubles;
  ExtrapolationOf<D, float> singles;
  SingleContacts<D> contacts;
  std::vector<Motion<D>> free_flight;
};

/// Limits of the reference velocity, with which changes are compared, m/s.
struct ReferenceRange {
  double least, most;

  ReferenceRange(double at_least, double at_most = std::numeric_limits<double>::infinity())
      : least(at_least), most(at_most)
  {
  }
};

/// Parameters of a solve.
template <int D>
struct SolverTask {
  std::size_t count;  // number of contacts
  double friction;
  Effects effects;
  SolverSettings settings;
  ReferenceRange range;
  int threads = 1;
  SolvedApart<D> apart = {};
};

/// Outcome of a step's solve. Not converging is a result: it is stored and reported, not thrown.
struct SolverReport {
  int sweeps = 0;           ///< relaxations per contact, rounded up
  double residual = 0;      ///< largest change in the last sweep over the reference velocity
  double residual_rms = 0;  ///< r.m.s. change in the last sweep over the reference velocity
  bool converged = true;
};

/// Projected Gauss-Seidel: sweeps over the contacts, each solved exactly while all others keep
/// their impulses. Impulses in the blocks are the first guess; they are applied to `motion` here.
/// The last entry of `motion` is the immobile body.
///
/// The solve ends when a sweep changes no contact's relative velocity by more than `tolerance`
/// times the reference velocity, but not before `min_sweeps` sweeps. The reference velocity is the
/// quadratic mean of W p over the `count` contacts, normal and tangential. It is limited to
/// `range`, so that a motionless bed stops at once and a few contacts of light grains under a heavy
/// one do not dominate. The criterion uses the largest change, not the mean, so that thousands of
/// settled contacts do not hide one that has just closed. Changes in the last digits of the fastest
/// velocity also count as convergence: without gravity loads fade, and no number of sweeps makes
/// changes small compared with them.
///
/// With free bodies or wedged grains everything is solved in double precision.
///
/// Contacts are divided into strips (pair_search.hpp), and within a strip into runs. A sweep
/// relaxes first even strips, several at a time, then odd ones. Strips that are not neighbours
/// share no mobile body; sums are added strip by strip. If there are several strips, each is swept
/// twice in a row, which counts as two sweeps. The first eight sweeps are never the last and never
/// restart the extrapolation, so each strip starts one as soon as its neighbours have finished
/// theirs (Wavefront). If changes above the tolerance remain in at most a quarter of the strips,
/// only these and their neighbours are swept further, without extrapolation. Neither is done with
/// bodies that are solved separately (SolvedApart).
template <int D>
SolverReport solve_contacts(std::span<const BlockRuns<D>> strips, std::span<Motion<D>> motion,
                            const SolverTask<D>& task, SolverMemory<D>& memory);

}  // namespace grseg
