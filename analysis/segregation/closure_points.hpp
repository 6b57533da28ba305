// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/frames/layer_key.hpp"
#include "analysis/frames/runs_of_tables.hpp"
#include "analysis/frames/sums.hpp"
#include "analysis/statistics/correlated_windows.hpp"
#include "analysis/stress/partition_rule.hpp"
#include "formats/cli/table.hpp"
#include "formats/cli/words.hpp"

#include <cstddef>
#include <map>
#include <string>
#include <vector>

namespace grseg {

/// Terms of the closure of Gray & Thornton (2005) in one layer and one window. With f^L =
/// sigma^L/sigma = phi_L (1 + B phi_S) and the interaction force per volume
///
///   beta^L = sigma df^L/dy - rho^L c (w_L - w) - rho d dphi_L/dy,     rho^L = phi_L rho
///
/// take the momentum balance of the large grains along y, minus phi_L times the balance of the
/// mixture, divided by rho. Solved for the flux q_L = phi_L (w_L - w) it is
///
///   c q_L = B X - d G + k_push + k_spread - a
///
///   X         phi_L phi_S (-sigma')/rho, driving, m/s^2, > 0 if stress decreases upward
///   G         dphi_L/dy, gradient, 1/m
///   k_push    -(psi_K - phi_L) K'/rho, kinetic push, m/s^2, upward positive
///   k_spread  -(K_L' - psi_K K')/rho, kinetic spread, m/s^2: large grains transport momentum from
///             regions with many of them to regions with few, like diffusion
///   a         (rate^L - phi_L rate)/rho, inertia, m/s^2
///
/// K and K_L are sum m v_y^2 over V of all and of large grains, in the frame of the base, and psi_K
/// = K_L/K. rate is the change of momentum density over the window. ' is d/dy, from the two
/// neighbouring layers. The balance of the mixture gives -sigma'/rho = -g_y + (K' + rate)/rho, with
/// less noise than a difference of stresses. All terms are valid inside the bed, where no grain
/// touches the base, and for grains of one density.
struct ClosurePoint {
  std::size_t window = 0;            // index of the window in the series of all, run after run
  double frames = 0;                 // number of frames in the window
  double weight = 0;                 // frames x area or volume of the grains
  double flux = 0;                   // q_L, m/s
  double driving = 0, gradient = 0;  // driving X, m/s^2, and gradient G, 1/m (see above)
  // X and G of the same layer in the window before; NaN if there is no such window.
  double driving_before = no_number, gradient_before = no_number;
  double kinetic_push = no_number, kinetic_spread = no_number,
         inertia = no_number;       // m/s^2; NaN: not in the table
  double diffusivity = no_number;   // m^2/s, from displacements
  double weight_above = no_number;  // -sigma' by the table of stress over -sigma' by the balance
  double shear_rate = no_number;    // of the bed, 1/s
  double diameter = no_number;      // mean nominal diameter phi_S d_S + phi_L d_L, m
  // From the table of stress.
  double phi_large = 0;
  double product = 0;  // phi_L phi_S
  // psi_L - phi_L by rule, then for shares 0 and 1 of mixed contacts; without what gradients inside
  // the layer add (FitPoint::within)
  std::vector<double> excess;
  double total_ratio =
      1;  // sigma_yy at share 1 over sigma_yy at share 0; both are equal unless the
          // table shares mixed contacts between layers (--assign grain)

  /// psi_L - phi_L if the larger grain gets this share of mixed contacts.
  double excess_at(double share) const;
  double slope_of_excess(double share) const;  // its derivative by the share
};

/// Instrumental variables of the regression (closure.hpp).
enum class Instruments {
  previous,  ///< X and G of the window before, which the noise of this window does not change
  same,      ///< none: ordinary least squares, biased by noise in X
};
inline constexpr Choice<Instruments> instrument_choices[] = {
    {"previous", Instruments::previous, "driving X and gradient G of the window before"},
    {"same", Instruments::same, "X and G of this window, which is least squares"}};

/// Selection of layers and windows, and the choice of instruments.
struct ClosureFilter : RowFilter {
  Instruments instruments = Instruments::previous;
};

struct ClosureData {
  RunLengths runs;    // number of windows with points in each run
  std::string doubt;  // warning that tables may be of one run; usually empty
  std::vector<ClosurePoint> points;
  std::size_t rows = 0;  // number of rows in the tables: layers x windows
  Instruments instruments = Instruments::previous;
  bool has_kinetic = true;  // true if all tables have the columns for kinetic terms and inertia
};

/// Throws UsageError, which names the densities, if the grains of the table's run differ in density.
void require_one_density(const Table& table);

/// Joins tables of grseg-segregation and grseg-stress, in any order, on the digest of their run and
/// (t0, t1, y0, y1). Throws UsageError if grains differ in density. Throws FormatError if a column is missing or a number is impossible. Throws
/// UsageError, which names table and remedy, if a run lacks one of the two tables or has one twice,
/// or if layers or windows of the two differ. Throws RunError if no point is left.
ClosureData read_closure(const std::vector<Table>& tables, const std::vector<PartitionRule>& rules,
                         const ClosureFilter& filter);

/// Absolute shear rate of the bed in each window of a table of grseg-segregation, 1/s. Throws FormatError if
/// the table has no such column.
std::map<Span, double> shear_rates_of(const Table& table);

}  // namespace grseg
