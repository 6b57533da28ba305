// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/frames/layers.hpp"
#include "analysis/frames/mean_velocity.hpp"
#include "analysis/frames/sums.hpp"
#include "analysis/frames/windows.hpp"
#include "formats/core/frame.hpp"

#include <array>
#include <tuple>
#include <vector>

namespace grseg {

/// Relative motion of the species in one layer over one window.
///
/// Velocities are along y, upward positive, mass-weighted. w is the velocity of the layer in each
/// frame, so that the motion of the layer as a whole drops out:
/// w_L - w = <sum_L m (v_y - w)>/<sum_L m>, <> the mean over frames. q_S = -q_L for grains of one
/// density; q_L > 0 means that large grains rise.
struct LayerSegregation {
  double phi_large;           // by area or volume of the grains with their centre in the layer
  double w_small, w_large;    // w_S - w and w_L - w, m/s; NaN without such grains
  double q_small, q_large;    // flux q = phi (w_species - w), m/s
  double D_small, D_large;    // diffusivity, m^2/s, from displacements over an eighth of a window
  double D2_small, D2_large;  // the same over a quarter of a window; equal if it is diffusion
  double Dhat_small, Dhat_large;  // D/(|du/dy| d^2), d = phi_S d_S + phi_L d_L, nominal
  double D;                       // of the composition, phi_S D_L + phi_L D_S (Darken 1948), m^2/s
  double gradient;                // d phi_L/dy between the neighbouring layers, 1/m
  double S;  // segregation velocity, m/s: q_L = S phi_L phi_S - D d phi_L/dy (Gray & Chugunov 2006)
  double peclet;  // S H/D, H the height of the bed
};

/// Sums over the grains of one species with their centre in the layer, means over the frames of a
/// window: what the closure of grseg-closure needs beside the fluxes.
struct LayerMomentum {
  double mass = 0;  // kg
  double flux = 0;  // J, m v_y^2 in the frame of the base
  double gain = 0;  // N, change of sum m v_y from the first frame of the window to the last over
                    // the time in between; NaN of a single frame
};

/// Flux, diffusivity and their errors in one layer and window.
struct SegregationResult {
  double content_small, content_large, mass;  // m^2 or m^3, kg, per frame; of grains by centre
  LayerFlow flow;
  std::array<double, 2> displacements;  // behind D_S and D_L, less one per drift
  LayerSegregation value, error;
  std::array<LayerMomentum, 2> momentum = {};  // of small and of large grains

  /// The columns from area_S or volume_S to gain_L_y, in 2 or 3 dimensions.
  std::vector<Cell> cells(int dimension) const;
};

/// Segregation flux, diffusivity and Peclet number by layer, of one window.
///
/// A window is cut into `parts` equal parts. Positions are kept at the first frame of each, so that
/// memory does not grow with the number of frames. Displacements along y reach from there to the
/// beginning of the next part (lag: an eighth of a window) and of the next but one (a quarter);
/// D = <(dy - <dy>)^2>/(2 lag), where <dy> is the drift of the species' grains that began in the
/// same layer and part, and the sum of squares is divided by their number less one. The cell is not
/// periodic in y.
///
/// Standard errors are jackknifed over the parts (Tukey 1958). The displacements of D2 overlap,
/// which makes its error too small, by at most a factor sqrt(2).
template <int D>
class SegregationFlux {
 public:
  static constexpr std::size_t parts = 8;

  /// Nominal diameters, m.
  SegregationFlux(const Layers& layers, const Window& window, double small_diameter,
                  double large_diameter);

  void add(const Grains& grains, const Frame<D>& frame);
  void merge(const SegregationFlux& others);

  /// By layer, of the same grains; `bed` is the height H for the Peclet number, m.
  std::vector<SegregationResult> results(const Grains& grains, double bed) const;

 private:
  /// One layer over the frames of one part.
  struct Sums {
    std::array<double, 2> content{}, mass{}, mvv{};  // mvv: J, sum of m v_y^2
    double excess = 0;                               // kg m/s, sum of m (v_y - w) over large grains
    LayerFlowSums flow;
    // By lag and species: sums of squares over twice the lag, and their number less one per drift.
    std::array<std::array<double, 2>, 2> squares{}, number{};

    static constexpr auto members =
        std::tuple(&Sums::content, &Sums::mass, &Sums::mvv, &Sums::excess, &Sums::flow,
                   &Sums::squares, &Sums::number);
    double phi_large() const { return content[1] / (content[0] + content[1]); }
  };
  using Profile = std::vector<Sums>;  // by layer
  /// Momentum along y by layer and species in the first or last frame, kg m/s.
  struct Instant {
    double time = 0;
    std::vector<std::array<double, 2>> momentum;  // empty: no frame yet
    double at(std::size_t layer, std::size_t species) const
    {
      return layer < momentum.size() ? momentum[layer][species] : 0;
    }
  };
  struct Snapshot {
    double time = 0;
    std::vector<double> y;  // NaN of absent grains; empty: no frame yet
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
  Instant first_, last_;
};

/// Lacey's (1954) index of the composition by layer: (s_0^2 - s^2)/(s_0^2 - s_r^2), 0 where the
/// species are separated and 1 where they are mixed at random. s^2 is the variance of phi_L over
/// the layers about the bed's Phi_L, weighted by area or volume; s_0^2 = Phi_L Phi_S is the
/// variance of separated species and s_r^2 = n Phi_L Phi_S (Phi_S a_L + Phi_L a_S)/A the variance
/// of a random mixture (Stange 1954), for n layers, the area or volume A of all grains and a_S, a_L
/// of one grain. Each grain belongs to the layer of its centre. NaN where a species is missing.
template <int D>
double mixing_index(const Layers& layers, const Grains& grains, const Frame<D>& frame);

/// The mobile grains of one frame; NaN where a species is missing.
struct BedState {
  double time = 0;                       // s
  double large = 0, small = 0, bed = 0;  // m, as in BedHeights
  double shear_rate = 0;                 // 1/s, slope of the least-squares line u(y) from 10 to
                                         // 90 % of `bed`
  double mixing = 0;                     // mixing_index
  double strain = 0;                     // integral of the shear rate since the first frame, by
                                         // trapezia
};

/// How far a bed has segregated, frame by frame: a few numbers per frame.
template <int D>
class SegregationSeries {
 public:
  explicit SegregationSeries(const Layers& layers) : layers_(layers) {}

  void add(const Grains& grains, const Frame<D>& frame);
  /// Appends the frames of another, which come later.
  void merge(const SegregationSeries& later);
  const std::vector<BedState>& moments() const { return moments_; }

 private:
  Layers layers_;
  std::vector<BedState> moments_;
};

}  // namespace grseg
