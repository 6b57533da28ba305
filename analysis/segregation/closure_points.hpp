// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/frames/layer_key.hpp"
#include "analysis/frames/sums.hpp"
#include "analysis/statistics/confidence.hpp"
#include "analysis/stress/partition_rule.hpp"
#include "formats/cli/table.hpp"
#include "formats/cli/words.hpp"

#include <cstddef>
#include <string>
#include <vector>

namespace grseg {

/// One layer in one window, as the closure of Gray & Thornton (2005) sees it. With f^L =
/// sigma^L/sigma = phi_L (1 + B phi_S) and the interaction
///
///   beta^L = sigma df^L/dy - rho^L c (w_L - w) - rho d dphi_L/dy,     rho^L = phi_L rho
///
/// the momentum balance of the large grains along y less phi_L times the mixture's balance, over
/// rho, is solved for the flux q_L = phi_L (w_L - w):
///
///   c q_L = B X - d G + k_push + k_spread - a
///
///   X         phi_L phi_S (-sigma')/rho, driving, m/s^2, > 0 where stress falls upward
///   G         dphi_L/dy, gradient, 1/m
///   k_push    -(psi_K - phi_L) K'/rho, kinetic push, m/s^2, upward positive
///   k_spread  -(K_L' - psi_K K')/rho, kinetic spread, m/s^2: large grains carry their momentum from
///             where they are many to where they are few, as diffusion does
///   a         (rate^L - phi_L rate)/rho, inertia, m/s^2
///
/// K and K_L: sum m v_y^2 over V of all and of large grains, in the frame of the base, psi_K =
/// K_L/K; rate: change of momentum density over the window; ' = d/dy, from the two neighbouring
/// layers. The balance of the mixture gives -sigma'/rho = -g_y + (K' + rate)/rho, with less noise
/// than a difference of stresses. All terms hold inside the bed, where the base does not act. One
/// density.
struct ClosurePoint {
  std::size_t window = 0;            // in the series of all windows, run after run
  double frames = 0;                 // of the window
  double weight = 0;                 // frames x area or volume of the grains
  double flux = 0;                   // q_L, m/s
  double driving = 0, gradient = 0;  // X and G
  // X and G of the same layer in the window before, NaN where there is none.
  double driving_before = no_number, gradient_before = no_number;
  double kinetic_push = no_number, kinetic_spread = no_number,
         inertia = no_number;       // m/s^2; NaN: not in the table
  double diffusivity = no_number;   // m^2/s, from displacements
  double weight_above = no_number;  // -sigma' of the table of stress over -sigma' of the balance
  // From the table of stress: phi_L, phi_L phi_S, and psi_L - phi_L by rule, followed by two more
  // rules: shares 0 and 1 of mixed contacts.
  double phi_large = 0;
  double product = 0;
  std::vector<double> excess;
};

/// Instrumental variables of the regression (closure.hpp).
enum class Instruments {
  previous,  ///< driving and gradient of the window before, on which this window's noise does not act
  same,      ///< X and G of this window: least squares
};
inline constexpr Choice<Instruments> instrument_choices[] = {
    {"previous", Instruments::previous, "X and G of the window before"},
    {"same", Instruments::same, "X and G of this window: least squares"}};

/// Which layers and windows take part.
struct ClosureFilter : RowFilter {
  Instruments instruments = Instruments::previous;
};

struct ClosureData {
  RunLengths runs;    // observations of each run: windows with points, in line
  std::string doubt;  // on which tables are of one run, mostly none
  std::vector<ClosurePoint> points;
  std::size_t rows = 0;  // layers and windows of these tables
  Instruments instruments = Instruments::previous;
  bool has_kinetic = true;  // all tables have what the kinetic terms and inertia need
};

/// Joins tables of grseg-segregation and grseg-stress, in any order, on the digest of their run and
/// (t0, t1, y0, y1). FormatError where a column is missing or a number cannot be; UsageError,
/// naming table and remedy, where a run lacks one of the two, has one twice, or where layers or
/// windows of the two differ; RunError where no point is left.
ClosureData read_closure(const std::vector<Table>& tables, const std::vector<PartitionRule>& rules,
                         const ClosureFilter& filter);

}  // namespace grseg
