// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/frames/layers.hpp"
#include "analysis/frames/mean_velocity.hpp"
#include "analysis/frames/sums.hpp"
#include "analysis/frames/windows.hpp"
#include "formats/core/frame.hpp"

#include <array>
#include <optional>
#include <tuple>
#include <vector>

namespace grseg {

/// Relative motion of the species in one layer over one window.
///
/// Velocities are along y, positive upward, and weighted with area or volume, as phi is, so that
/// q_S = -q_L; grains of one density are weighted with mass, which is the same. w is the velocity of
/// the layer in each frame; subtracting it removes the motion of the layer as a whole:
/// w_L - w = <sum_L m (v_y - w)>/<sum_L m>, with <> the mean over frames and m the weight. q_L > 0
/// means that large grains rise, whether size or weight drives them.
struct LayerSegregation {
  double phi_large;           // by area or volume of the grains with their centre in the layer
  double w_small, w_large;    // w_S - w and w_L - w, m/s; NaN without grains of the species
  double q_small, q_large;    // flux q = phi (w_species - w), m/s
  double D_small, D_large;    // diffusivity, m^2/s, from displacements over an eighth of a window
  double D2_small, D2_large;  // D over a quarter of a window; equals D if grains diffuse
  double Dhat_small, Dhat_large;  // D/(|du/dy| d^2), d = phi_S d_S + phi_L d_L, nominal
  double D;         // diffusivity of the composition, phi_S D_L + phi_L D_S (Darken 1948), m^2/s
  double gradient;  // d phi_L/dy between the neighbouring layers, 1/m
  double S;  // segregation velocity, m/s: q_L = S phi_L phi_S - D d phi_L/dy (Gray & Chugunov 2006)
  double peclet;  // Peclet number S H/D, with H the height of the bed
};

/// Sums over the grains of one species with their centre in the layer, averaged over the frames of
/// a window. grseg-closure needs them in addition to the fluxes.
struct LayerMomentum {
  double mass = 0;  // mass, kg
  double flux = 0;  // sum m v_y^2 in the frame of the base, J
  double gain = 0;  // change of sum m v_y from the first to the last frame of the window, over the
                    // time between them, N; NaN for a single frame
};

/// Flux, diffusivity and their errors in one layer and window.
struct SegregationResult {
  // Area or volume of each species (m^2, m^3) and mass (kg) of grains with their centre in the
  // layer, per frame.
  double content_small, content_large, mass;
  LayerFlow flow;
  std::array<double, 2> displacements;  // degrees of freedom of D_S and D_L: displacements - drifts
  LayerSegregation value, error;
  std::array<LayerMomentum, 2> momentum = {};  // momentum of small and of large grains

  /// Cells of the columns from area_S or volume_S to gain_L_y; `dimension` is 2 or 3.
  std::vector<Cell> cells(int dimension) const;
};

/// Segregation flux, diffusivity and Peclet number of one window, by layer.
///
/// A window is cut into `parts` equal parts. Positions are stored at the first frame of each part
/// only, so memory does not grow with the number of frames. Displacements along y are taken from
/// there to the first frame of the next part (lag: an eighth of a window) and of the part after it
/// (lag: a quarter). D = <(dy - <dy>)^2>/(2 lag), where <dy> is the drift: the mean over the grains
/// of the species that began in the same layer and part. The sum of squares is divided by their
/// number minus one. The cell must not be periodic in y.
///
/// Standard errors are from the jackknife over the parts (Tukey 1958). The displacements of D2
/// overlap, so its error is too small, by at most a factor sqrt(2).
template <int D>
class SegregationFlux {
 public:
  static constexpr std::size_t parts = 8;

  /// Nominal diameters, m.
  SegregationFlux(const Layers& layers, const Window& window, double small_diameter,
                  double large_diameter);

  void add(const Grains& grains, const Frame<D>& frame);
  void merge(const SegregationFlux& others);

  /// Results by layer. `grains` must equal the argument of add(); `bed` is the height H for the
  /// Peclet number, m.
  std::vector<SegregationResult> results(const Grains& grains, double bed) const;

 private:
  /// Sums over the frames of one part in one layer; arrays are by species.
  struct Sums {
    // Area or volume (m^2, m^3), mass (kg) and sum of m v_y^2 (J).
    std::array<double, 2> content{}, mass{}, mvv{};
    double excess = 0;  // sum of m (v_y - w) over large grains, with the weight m of velocities
    LayerFlowSums flow;
    // By lag and species: sums of (dy - <dy>)^2/(2 lag), m^2/s, and their degrees of freedom.
    std::array<std::array<double, 2>, 2> squares{}, number{};

    static constexpr auto members =
        std::tuple(&Sums::content, &Sums::mass, &Sums::mvv, &Sums::excess, &Sums::flow,
                   &Sums::squares, &Sums::number);
    double phi_large() const { return content[1] / (content[0] + content[1]); }
    /// Weight of the velocities of each species.
    const std::array<double, 2>& weight(bool one_density) const
    {
      return one_density ? mass : content;
    }
  };
  using Profile = std::vector<Sums>;  // by layer
  /// Momentum along y in the first or last frame of the window.
  struct Instant {
    double time = 0;                              // s
    std::vector<std::array<double, 2>> momentum;  // by layer and species, kg m/s; empty: no frame
    double at(std::size_t layer, std::size_t species) const
    {
      return layer < momentum.size() ? momentum[layer][species] : 0;
    }
  };
  struct Snapshot {
    double time = 0;        // s
    std::vector<double> y;  // heights of the grains, m; NaN if absent; empty: no frame yet
  };

  void add_displacements(const Grains& grains, std::size_t part, std::size_t lag,
                         Profile& profile) const;
  LayerSegregation evaluate(const Profile& profile, std::size_t layer, double bed) const;
  double gradient(const Profile& profile, std::size_t layer) const;

  Layers layers_;
  double begin_, length_;
  std::array<double, 2> diameter_;
  std::size_t frames_ = 0;
  std::optional<bool> one_density_;  // true if all grains have one density; set by the first frame
  std::array<Profile, parts> profile_;
  std::array<Snapshot, parts> snapshot_;
  Instant first_, last_;
};

/// Lacey's (1954) mixing index: (s_0^2 - s^2)/(s_0^2 - s_r^2), 0 if the species are separated and 1
/// if they are mixed at random. s^2 is the variance of phi_L over the layers about Phi_L of the
/// bed, weighted by area or volume. s_0^2 = Phi_L Phi_S is the variance of separated species, and
/// s_r^2 = n Phi_L Phi_S (Phi_S a_L + Phi_L a_S)/A the variance of a random mixture (Stange 1954),
/// for n layers; A is the area or volume of all grains, a_S and a_L of one small and one large
/// grain. Each grain belongs to the layer of its centre. NaN if a species is missing.
template <int D>
double mixing_index(const Layers& layers, const Grains& grains, const Frame<D>& frame);

/// State of the mobile grains in one frame; numbers that need a missing species are NaN.
struct BedState {
  double time = 0;                       // s
  double large = 0, small = 0, bed = 0;  // heights, m, as in BedHeights
  double shear_rate = 0;                 // slope of the least-squares line u(y) from 10 to 90 % of
                                         // `bed`, 1/s
  double mixing = 0;                     // mixing_index
  double strain = 0;                     // integral of the shear rate since the first frame, by
                                         // the trapezoidal rule
};

/// Progress of segregation in a bed: one BedState per frame.
template <int D>
class SegregationSeries {
 public:
  explicit SegregationSeries(const Layers& layers) : layers_(layers) {}

  void add(const Grains& grains, const Frame<D>& frame);
  /// Appends the frames of `later`, which follow in time.
  void merge(const SegregationSeries& later);
  const std::vector<BedState>& states() const { return states_; }

 private:
  Layers layers_;
  std::vector<BedState> states_;
};

}  // namespace grseg
