// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/frames/layer_flow.hpp"
#include "analysis/frames/layers.hpp"
#include "analysis/frames/windows.hpp"
#include "formats/core/frame.hpp"

#include <array>
#include <string>
#include <vector>

namespace grseg {

/// Relative motion of the species in one layer over one window.
///
/// Velocities are along y, upward positive, mass-weighted. w is that of the layer in each frame, so
/// that what the whole layer does together drops out: w_L - w = <sum_L m (v_y - w)>/<sum_L m>, <>
/// the mean over frames. q_S = -q_L for grains of one density; q_L > 0: large grains rise.
struct LayerSegregation {
  double phi_large;           // of the area of the grains whose centre lies in the layer
  double w_small, w_large;    // w_S - w and w_L - w, m/s; NaN without such grains
  double q_small, q_large;    // flux q = phi (w_species - w), m/s
  double D_small, D_large;    // diffusivity, m^2/s, from displacements over an eighth of a window
  double D2_small, D2_large;  // the same over a quarter: as large where it is diffusion
  double Dhat_small, Dhat_large;  // D/(|du/dy| d^2), d = phi_S d_S + phi_L d_L, nominal
  double D;                       // of the composition, phi_S D_L + phi_L D_S (Darken 1948), m^2/s
  double gradient;                // d phi_L/dy between the neighbouring layers, 1/m
  double S;       // segregation velocity, m/s, from q_L = S phi_L phi_S - D d phi_L/dy
  double peclet;  // S H/D, H the height of the bed
};

/// Segregation flux, diffusivity and Peclet number by layer, of one window.
///
/// A window is cut into `parts` equal parts. Positions are kept at the first frame of each, which
/// makes parts x grains numbers however many frames there are. Displacements along y reach from
/// there to the beginning of the next part (lag: an eighth of a window) and of the next but one (a
/// quarter); D = <(dy - <dy>)^2>/(2 lag), where <dy> is the drift of the species' grains that began
/// in the same layer and part, and the sum of squares is divided by their number less one. Nothing
/// is periodic in y.
///
/// Standard errors are jackknifed over the parts (Tukey 1958). The displacements of D2 overlap,
/// which makes its error too small by up to sqrt(2).
class SegregationFlux {
 public:
  static constexpr std::size_t parts = 8;

  /// Nominal diameters, m.
  SegregationFlux(const Layers& layers, const Window& window, double small_diameter,
                  double large_diameter);

  void add(const Grains& grains, const Frame& frame);
  void merge(const SegregationFlux& others);

  /// Of one layer.
  struct Result {
    double area_small, area_large, mass;  // m^2, kg, per frame; of grains by centre
    LayerFlow flow;
    std::array<double, 2> displacements;  // that D_S and D_L stand on, less the drifts
    LayerSegregation value, error;
  };
  /// By layer, of the same grains; `bed` is the height H for the Peclet number, m.
  std::vector<Result> results(const Grains& grains, double bed) const;

  /// The columns from area_S to Pe_error, and a layer's numbers under them.
  static std::vector<std::string> columns();
  static std::vector<double> row(const Result& result);

 private:
  /// Of one layer over the frames of one part.
  struct Sums {
    std::array<double, 2> area{}, mass{};
    double excess = 0;  // kg m/s, sum of m (v_y - w) over large grains
    LayerFlowSums flow;
    // By lag and species: sums of squares over twice the lag, and how many they are, less drifts.
    std::array<std::array<double, 2>, 2> squares{}, number{};

    Sums& operator+=(const Sums& others);
    double phi_large() const { return area[1] / (area[0] + area[1]); }
  };
  using Profile = std::vector<Sums>;  // by layer
  struct Snapshot {
    double time = 0;
    std::vector<double> y;  // empty: no frame yet
  };

  void add_displacements(const Grains& grains, std::size_t part, std::size_t lag,
                         Profile& profile) const;
  LayerSegregation evaluate(const Profile& profile, std::size_t layer, double bed) const;
  double gradient(const Profile& profile, std::size_t layer) const;

  Layers layers_;
  double begin_, length_;
  std::array<double, 2> diameter_;
  std::size_t frames_ = 0;
  std::array<Profile, parts> profile_;
  std::array<Snapshot, parts> snapshot_;
};

}  // namespace grseg
