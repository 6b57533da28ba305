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
/// bias of a mean that holds the grain itself.
///
/// V, the mean of n grains of masses m (M in all), moves with each of them, so that (v_i - V) (x)
/// (v_i - V) falls short of the variance of v_i: of equal grains by the factor 1 - 1/n, else by 2
/// m_i/M less what the others make V fluctuate. Here a grain i of a cell (a layer or a cell of a
/// map) has instead
///
///   (v_i - v_j) (x) (v_i - v_k), the mean over all j != k, weights m_j m_k, of the cell's others.
///
/// Where velocities in a cell have a common mean and are independent, its expectation is the
/// variance of v_i, whatever the masses and variances of i and of the others: j and k differ, so
/// that only the fluctuation of i is multiplied by itself. (With the mean of all others for both,
/// the expectation has their variance in it; (v_i - V) (x) (v_i - V without i) has the variance of
/// v_i where m var(v) is the same for all grains, and else an error of the order m_i/M.)
///
/// With e = v - V and, over the cell, Q = sum m^2, R = sum m^2 e, P = sum m^2 e (x) e it equals
///
///   [(M^2 - Q) e_i (x) e_i + e_i (x) R + R (x) e_i - P] / [(M - m_i)^2 - Q + m_i^2].
///
/// The sum over equal grains is n/(n - 1) times the sum about V. A grain needs two others; in a
/// cell of one or two there is no product. What all grains of the cell do together is left out; a
/// difference of mean velocity between them, such as shear, and correlations are not.
template <int D>
class UnbiasedFluctuations {
 public:
  using Product = MotionProduct<D>;

  UnbiasedFluctuations(const Layers& layers, const Grains& grains, const Frame<D>& frame);

  /// True where the cell holds three mobile grains or more.
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

/// sum m dv (x) dv, without a factor 1/2, and the same of rotation, sum k m r^2 dw^2 (w: spin; k =
/// 1/2 of discs and 2/5 of spheres); J.
template <int D>
struct Fluctuations {
  Tensor<D> kinetic = Tensor<D>::Zero();
  double rotational = 0;

  static constexpr auto members = std::tuple(&Fluctuations::kinetic, &Fluctuations::rotational);
};

/// Kinetic stress by layer and species, sigma^kappa = (1/V) sum m dv (x) dv (Staron & Phillips
/// 2015, eq. 5), dv = velocity less a mean velocity (MeanFlow). A grain counts, whole, in the layer
/// of its centre. J, not divided by V, means per frame. In annuli velocities have components along
/// and across the layer, at the grain's centre.
///
/// The layer bias is kept beside these sums, whatever the mean: sum about the layer's mean - sum
/// about the profile, by definition and exactly. For a linear shear it is mass (du/dy h)^2/12 in
/// xx, h the thickness of the layer, and nothing elsewhere. A map has neither profile nor bias.
///
/// About MeanFlow::instant_unbiased a grain needs two others in its layer or cell and frame. Where
/// there are fewer it counts in the mean flow but not in the sums, its mass and its number
/// included, so that temperatures and ratios are of the grains that count; `left_out` has the
/// others. About MeanFlow::profile_unbiased this holds where no bin of the profile has two others.
///
/// The frames of a window are read twice: first for the mean flow, then for the fluctuations.
template <int D>
class KineticStress {
 public:
  using Temperatures = Vector<D + 1>;
  /// Sums of one species in one layer.
  struct Mean {
    double mass = 0;      // kg
    double content = 0;   // m^2 or m^3, area or volume
    double grains = 0;    // number
    double left_out = 0;  // number without enough others for a mean; not in `grains`
    double own_part = 0;  // kg: mass times MeanVelocity::own_part(); about MeanFlow::profile only
    Fluctuations<D> about_mean;
    Fluctuations<D> layer_bias;

    /// Granular temperatures (dv_x^2, dv_y^2, dv_z^2 in three dimensions, k r^2 dw^2),
    /// mass-weighted means, m^2/s^2; NaN without grains. Energies per grain and degree of freedom
    /// are half the grain's mass times that; the spin of a sphere has three.
    Temperatures temperature() const;
    static constexpr auto members =
        std::tuple(&Mean::mass, &Mean::content, &Mean::grains, &Mean::left_out, &Mean::own_part,
                   &Mean::about_mean, &Mean::layer_bias);
  };

  /// About the mean over the frames that `mean` was given, which are those to be added.
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
  /// Energy per large grain over energy per small grain in x, y, z and rotation: 1 for
  /// equipartition, the mass ratio where all fluctuate as fast. NaN unless both are there.
  Temperatures equipartition(std::size_t layer) const;
  /// The layer bias in xx that the mean shear alone makes, J: mass (du/dy h)^2/12.
  double shear_bias(std::size_t layer, Species species) const;

  /// The columns of grseg-kinetic from mass_S on with a layer's numbers, NaN without a layer.
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

/// Which velocity of the step that a frame stands for. Frames hold that after the step.
enum class VelocityInStep { after, middle };
inline constexpr Choice<VelocityInStep> velocities_in_step[] = {
    {"after", VelocityInStep::after, "at the end of the step, as stored"},
    {"middle", VelocityInStep::middle,
     "half a step before: v - F h/(2 m), F the force on the grain, its weight included; "
     "spins likewise by the contacts' torques"}};

/// Turns the velocities and spins of the mobile grains, those after a step of `step` s, into those
/// in its middle, the means of before and after:
///   v - F h/(2 m), F = m (v_after - v_before)/h, the `force` of the frame;
///   w - T h/(2 I), T the torques of the frame's contacts, unless grains do not turn (`turning`).
/// Exact where nothing happens but gravity. Of a grain that bounces it is the mean of before and
/// after, at e = 1 no velocity at all. FormatError where the frame has no forces of grains.
template <int D>
void to_middle_of_step(const Grains& grains, double step, bool turning, Frame<D>& frame);

/// The line on --velocity in a table's header: the word, or "instant" for an imported run, whose
/// frames have one velocity. UsageError where --velocity was given for such a run.
std::string velocity_line(const TrajectoryReader& run, const std::string& word, bool chosen);

/// Sums over frames with velocities of one kind, which are made from the velocities that frames
/// hold.
template <int D, class Sums>
struct AtVelocity {
  Sums sums;
  VelocityInStep which;
  double step;  // s
  bool turning;

  void add(const Grains& grains, const Frame<D>& frame)
  {
    if (which == VelocityInStep::after) return sums.add(grains, frame);
    Frame<D> middle = frame;
    to_middle_of_step(grains, step_of_force(frame, step), turning, middle);
    sums.add(grains, middle);
  }
  void merge(const AtVelocity& others) { sums.merge(others.sums); }
};

/// The sums of a window about its mean; `no_grains` makes that mean. Its frames are read twice.
template <int D>
KineticStress<D> kinetic_stress(FrameLoop& loop, const Window& window, MeanFlow flow,
                                VelocityInStep which, const MeanVelocity<D>& no_grains);

/// Fields in the cell of a map, for looking at: w, the third component of the mean velocity, in
/// three dimensions; T, the granular temperature: the mean of dv^2 over the grains' mass and the D
/// components.
template <int D>
std::vector<Cell> flow_fields(const Vector<D>& velocity,
                              const typename KineticStress<D>::Mean& all_species);

/// The columns of grseg-kinetic with the numbers of a layer or cell, or their names without one.
/// With contents, areas or volumes, where masses do not tell them because densities differ; of a
/// map with flow_fields.
template <int D>
std::vector<Cell> kinetic_cells(const KineticStress<D>& stress, const SpeciesList& species,
                                bool with_contents, bool map, std::optional<std::size_t> layer);

/// Remarks for a reader of kinetic sums on the mean from which velocities are counted.
class KineticRemarks {
 public:
  /// Adds a window of so many frames.
  template <int D>
  void add(const KineticStress<D>& stress, std::size_t species, std::size_t frames);
  /// About the layer's mean (`about_layer`): how much of the fluctuations is shear inside the
  /// layers. Where some grains are too few in their layer and frame for the mean: their number. And
  /// how much of its own motion a grain finds in the mean profile, where it is not little.
  std::vector<std::string> sentences(bool about_layer) const;

 private:
  double profile_ = 0, layer_bias_ = 0, of_shear_ = 0;  // J
  double left_out_ = 0, grains_ = 0;                    // number, over all frames
  double own_part_ = 0;                                 // the largest of a species in a window
  std::size_t own_frames_ = 0;                          // of that window
};

}  // namespace grseg
