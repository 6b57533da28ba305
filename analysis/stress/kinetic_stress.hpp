// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/frames/frame_loop.hpp"
#include "analysis/frames/layers.hpp"
#include "analysis/frames/mean_velocity.hpp"
#include "analysis/frames/sums.hpp"
#include "formats/cli/words.hpp"
#include "formats/core/frame.hpp"
#include "formats/core/species.hpp"
#include "formats/trajectory/reader.hpp"

#include <cstddef>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

namespace grseg {

/// Products of fluctuations in one frame (dv (x) dv of Staron & Phillips 2015, eq. 5) without the
/// bias of a mean velocity that includes the grain itself.
///
/// A cell is a layer or a cell of a map. V is the mean velocity of its n grains of masses m,
/// weighted by mass; M is the sum of m. V includes v_i, so (v_i - V) (x) (v_i - V) underestimates
/// the variance of v_i. For equal grains it is 1 - 1/n of the variance. Otherwise the bias is 2
/// m_i/M of the variance less the variance of V. Here grain i has instead the product
///
///   (v_i - v_j) (x) (v_i - v_k), averaged over pairs j != k of other grains, weighted by m_j m_k.
///
/// If the velocities in a cell are independent with a common mean, the expectation of this product
/// is the variance of v_i, for any masses and variances: j and k differ, so only the fluctuation of
/// i is multiplied by itself. (If the mean of all others replaces v_j and v_k, the expectation
/// includes their variance. (v_i - V) (x) (v_i - V without i) is unbiased if m var(v) is the same
/// for all grains, else it has an error of the order m_i/M.)
///
/// With e = v - V and sums over the cell Q = sum m^2, R = sum m^2 e, P = sum m^2 e (x) e it equals
///
///   [(M^2 - Q) e_i (x) e_i + e_i (x) R + R (x) e_i - P] / [(M - m_i)^2 - Q + m_i^2].
///
/// The sum over equal grains is n/(n - 1) times the sum about V. Cells of one or two grains have no
/// product. The product leaves out the common motion of all grains in the cell. It includes
/// differences of mean velocity between grains, such as shear, and correlations.
template <int D>
class UnbiasedFluctuations {
 public:
  using Product = MotionProduct<D>;

  UnbiasedFluctuations(const Layers& layers, const Grains& grains, const Frame<D>& frame);

  /// True if the cell contains at least three mobile grains.
  bool has(std::size_t layer) const { return cells_[layer].grains > 2; }
  /// Product of fluctuations of a grain of the cell with this mass and motion.
  Product of(std::size_t layer, double mass, const Motion<D>& motion) const;

 private:
  struct CellSums {
    std::size_t grains = 0;
    double mass = 0, squares = 0;                                      // M, Q
    Motion<D> mean = Motion<D>::Zero(), weighted = Motion<D>::Zero();  // V, R
    Product product;                                                   // P
  };
  std::vector<CellSums> cells_;
};

/// Sums over grains, J, without the factor 1/2 of energies: sum m dv (x) dv, and sum k m r^2 dw^2
/// with the spin w and k = 1/2 for discs, 2/5 for spheres.
template <int D>
struct Fluctuations {
  Tensor<D> kinetic = Tensor<D>::Zero();
  double rotational = 0;

  static constexpr auto members = std::tuple(&Fluctuations::kinetic, &Fluctuations::rotational);
};

/// Sums for the kinetic stress by layer and species, sigma^kappa = (1/V) sum m dv (x) dv (Staron &
/// Phillips 2015, eq. 5), with dv the velocity minus a mean velocity (MeanFlow). A grain belongs as
/// a whole to the layer of its centre. The sums are in J, not divided by V, and averaged over
/// frames. In annuli, velocities have components along and across the layer at the grain's centre.
///
/// The layer bias is the sum about the layer's mean minus the sum about the profile. It is found
/// for every MeanFlow. For a linear shear it is mass (du/dy h)^2/12 in xx, with h the thickness of
/// the layer, and 0 in other components.
///
/// With MeanFlow::instant_unbiased a grain needs two other grains in its layer or cell and frame.
/// Without them it is part of the mean flow, but not of the sums, nor of their mass and number of
/// grains, so that temperatures and ratios refer to the same grains. `left_out` is the number of
/// such grains. With MeanFlow::profile_unbiased a grain is left out if no bin of the profile has
/// two other grains, or in a map if the plane of its patch needs it.
///
/// The frames of a window are read twice: first for the mean flow, then for the fluctuations.
template <int D>
class KineticStress {
 public:
  using Temperatures = Vector<D + 1>;
  /// Sums of one species in one layer.
  struct Mean {
    double mass = 0;      // mass of the grains, kg
    double content = 0;   // area or volume of the grains, m^2 or m^3
    double grains = 0;    // number of grains
    double left_out = 0;  // number of grains without enough others for a mean; not in `grains`
    double own_part = 0;  // sum of mass times own_part(), kg; only for MeanFlow::profile
    Fluctuations<D> about_mean;
    Fluctuations<D> layer_bias;

    /// Granular temperatures: mass-weighted means of (dv_x^2, dv_y^2, in three dimensions dv_z^2,
    /// k r^2 dw^2), m^2/s^2; NaN without grains. Half the mass of a grain times a temperature is an
    /// energy per degree of freedom; for the spin of a sphere it is the energy of three.
    Temperatures temperature() const;
    static constexpr auto members =
        std::tuple(&Mean::mass, &Mean::content, &Mean::grains, &Mean::left_out, &Mean::own_part,
                   &Mean::about_mean, &Mean::layer_bias);
  };

  /// `mean`: mean velocities over the same frames that will be added.
  KineticStress(const Layers& layers, MeanFlow flow, const MeanVelocity<D>& mean,
                std::size_t species = 2);

  void add(const Grains& grains, const Frame<D>& frame);
  void merge(const KineticStress& others);

  std::size_t layers() const { return sums_.size(); }
  Mean mean(std::size_t layer, Species species) const;
  /// Mass-weighted mean velocity of a layer, m/s; NaN without grains.
  Vector<D> velocity(std::size_t layer) const
  {
    return mean_velocity_.of_layer(layer).template head<D>();
  }
  LayerFlow flow(std::size_t layer) const;
  /// Rate of shear of the mean flow in a cell of a map, 1/s (map_flow.hpp); NaN without grains.
  double shear_rate(std::size_t cell) const { return mean_velocity_.over_map()->shear_rate(cell); }
  /// Energy per large grain over energy per small grain in x, y, z and rotation: 1 for
  /// equipartition, the mass ratio for equal velocities. NaN unless both species are present.
  Temperatures equipartition(std::size_t layer) const;
  /// Part of the layer bias in xx due to the mean shear, J: mass (du/dy h)^2/12.
  double shear_bias(std::size_t layer, Species species) const;

  /// The columns of grseg-kinetic from mass_S on, with the numbers of a layer, or NaN without one.
  std::vector<Cell> cells(const SpeciesList& species, std::optional<std::size_t> layer) const;

 private:
  struct Sums {
    std::vector<Mean> species;
    LayerFlowSums flow;
    static constexpr auto members = std::tuple(&Sums::species, &Sums::flow);
  };

  Layers layers_;
  MeanFlow flow_;
  MeanVelocity<D> mean_velocity_;
  std::size_t species_;
  std::size_t frames_ = 0;
  std::vector<Sums> sums_;
};

/// Time within a frame's step whose velocities are used. Files store velocities after the step.
enum class VelocityInStep { after, middle };
inline constexpr Choice<VelocityInStep> velocities_in_step[] = {
    {"after", VelocityInStep::after, "at the end of the step, as stored"},
    {"middle", VelocityInStep::middle,
     "half a step earlier: v - F h/(2 m), with F the force on the grain including its weight; "
     "spins likewise, from the torques of contacts"}};

/// Replaces the velocities and spins of the mobile grains after a step of `step` s by those in the
/// middle of the step, the means of before and after:
///   v - F h/(2 m), with the frame's `force` F = m (v_after - v_before)/h;
///   w - T h/(2 I), with the torques T of the contacts; unchanged if `turning` is false, for runs
///   whose grains do not rotate.
/// Exact for free flight under gravity. For a grain that bounces the mean of before and after has
/// no meaning; at e = 1 it is 0. Throws FormatError if the frame has no forces of grains.
template <int D>
void to_middle_of_step(const Grains& grains, double step, bool turning, Frame<D>& frame);

/// Value of the header line "velocity": `word`, the value of --velocity, or "instant" for an
/// imported run, whose frames have only one velocity. Throws UsageError if the user gave --velocity
/// (`chosen`) for an imported run.
std::string velocity_line(const TrajectoryReader& run, const std::string& word, bool chosen);

/// Sums over frames with velocities at one time within the step.
template <int D, class Sums>
struct AtVelocity {
  Sums sums;
  VelocityInStep which;
  double step;   // length of a step, s
  bool turning;  // true if grains rotate

  void add(const Grains& grains, const Frame<D>& frame)
  {
    if (which == VelocityInStep::after) return sums.add(grains, frame);
    Frame<D> middle = frame;
    to_middle_of_step(grains, step_of_force(frame, step), turning, middle);
    sums.add(grains, middle);
  }
  void merge(const AtVelocity& others) { sums.merge(others.sums); }
};

/// Sums of a window about its mean flow, which is found with a copy of `no_grains`.
template <int D>
KineticStress<D> kinetic_stress(FrameLoop& loop, const Window& window, MeanFlow flow,
                                VelocityInStep which, const MeanVelocity<D>& no_grains);

/// Fields of a map's cell for pictures: w, the third component of the mean velocity, in three
/// dimensions; T, the granular temperature, the mass-weighted mean of dv^2 over D.
template <int D>
std::vector<Cell> flow_fields(const Vector<D>& velocity,
                              const typename KineticStress<D>::Mean& all_species);

/// The columns of grseg-kinetic with the numbers of a layer or cell; without one only the names
/// matter. `with_contents` adds areas or volumes, which masses do not give if densities differ; a
/// map also has flow_fields() and the rate of shear.
template <int D>
std::vector<Cell> kinetic_cells(const KineticStress<D>& stress, const SpeciesList& species,
                                bool with_contents, bool map, std::optional<std::size_t> layer);

/// Remarks to the user on the mean velocity from which fluctuations are measured.
class KineticRemarks {
 public:
  /// Adds a window of this number of frames.
  template <int D>
  void add(const KineticStress<D>& stress, std::size_t species, std::size_t frames);
  /// The remarks that apply: the share of shear inside layers in K_xx (with `about_layer`, for
  /// means of layers); the number of grains left out, because too few others are in their layer and
  /// frame; the share of a grain's own motion in the mean profile, if it is above 1 %.
  std::vector<std::string> sentences(bool about_layer) const;

 private:
  double profile_ = 0, layer_bias_ = 0, of_shear_ = 0;  // sums of K_xx about profile; biases, J
  double left_out_ = 0, grains_ = 0;                    // numbers of grains, over all frames
  double own_part_ = 0;         // largest mean share of a grain in the profile, 0 to 1
  std::size_t own_frames_ = 0;  // number of frames in the window with this share
};

}  // namespace grseg
