// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/frames/layer_key.hpp"
#include "analysis/frames/runs_of_tables.hpp"
#include "analysis/segregation/closure.hpp"
#include "analysis/segregation/named_numbers.hpp"
#include "formats/cli/table.hpp"

#include <array>
#include <cstddef>
#include <functional>
#include <string>
#include <vector>

/// Prediction of phi_L(y, t) of a run from coefficients measured on other runs.
namespace grseg {

/// Laws for S and D of q_L = S phi_L phi_S - D dphi_L/dy (transport.hpp). g' is the shear rate of
/// the bed, d = phi_S d_S + phi_L d_L, R = d_L/d_S, and P = (solid volume above per area of the
/// base) cos(slope), the pressure over rho g, with rho the density of a grain.
///
///   closure   S = (B/c) g cos(slope), D = d/c, times g' d and g' d^2 of the predicted bed over those
///             of the fitted beds; d of a bed is from its Phi_L
///   trewhela  S = 0.3744 g' d^2 ((R - 1) + 2.0957 phi_L (R - 1)^2)/(0.2712 d + P), D = 0.108 g' d^2,
///             with the local phi_L (Trewhela, Ancey & Gray 2021, J. Fluid Mech. 916, A55, spheres)
///   trewhela_intruder  as trewhela, but without the term with (R - 1)^2, as for a large grain alone
///   unchanged S = D = 0
inline constexpr std::array<const char*, 4> prediction_laws{"closure", "trewhela",
                                                            "trewhela_intruder", "unchanged"};

/// A layer in a window of a predicted run.
struct PredictedLayer {
  LayerKey key;
  double content = 0;    // area or volume of the grains, m^2 or m^3
  double phi_large = 0;  // as measured
  std::array<double, prediction_laws.size()> predicted{};  // phi_L by law
};

struct PredictedWindow {
  Span span;  // s
  std::vector<PredictedLayer> layers;
};

struct Prediction {
  std::string name;  // of the table
  std::vector<PredictedWindow> windows;
  /// Derivatives of the closure's y_L in the last window by B/c, m/s, and by d/c, s/m.
  std::array<double, 2> slopes{};
};

/// The estimate of a number with this value and these derivatives by B/c and d/c.
using FromFlux = std::function<Estimate(double value, const std::array<double, 2>& slopes)>;

/// Predicts all windows of a table of grseg-segregation from its first. phi_L, the solid volume, and
/// its height at the median solid fraction come from the first window, taken at its middle; the
/// shear rate changes from window to window. Layers correspond by the share of all grains below them, so
/// that a bed may dilate. `filter` selects the windows and the least solid fraction of layers; its
/// heights are not used, because large grains are conserved only in the whole bed. Throws
/// UsageError if grains differ in density, FormatError if a column or a shear rate is missing or a
/// number is impossible, RunError if fewer than two windows are left, or if `fitted` has a NaN.
Prediction predict(const Table& table, const FluxCoefficients& fitted, const RowFilter& filter);

/// Throws UsageError if a table in `predicted` is of the same run as one in `fitted`, or as another
/// with the same times (find_runs()). Tables of grseg-stress are passed over.
void refuse_fitted_runs(const std::vector<Table>& predicted, const std::vector<Table>& fitted);

/// Numbers of each prediction, their names followed by "@" and the table's name:
///   y_L_first, y_L_last  mean height of the large grains in the first and in the last window, m
///   rms_phi_L_of_LAW  rms difference of predicted and measured phi_L, over the layers of all
///                     windows after the first, weighted with area or volume of the grains
///   rms_y_L_of_LAW    rms difference of the mean heights, over the same windows, m
///   y_L_last_of_LAW   mean height in the last window, m; of `closure` with the interval of
///                     `from_flux`, which is due to the errors of B/c and d/c alone
void add_predictions(NamedNumbers& numbers, const std::vector<Prediction>& predictions,
                     const FromFlux& from_flux);

/// Measured and predicted phi_L: columns run (number in the order of `predictions`), t0, t1, y0, y1,
/// solid (fraction), phi_L, and phi_L_LAW for each law.
Table prediction_table(const std::vector<Prediction>& predictions);

}  // namespace grseg
