// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/frames/frame_loop.hpp"
#include "analysis/frames/sums.hpp"
#include "analysis/stress/kinetic_stress.hpp"
#include "formats/cli/words.hpp"
#include "formats/core/frame.hpp"
#include "formats/core/species.hpp"
#include "formats/trajectory/reader.hpp"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace grseg {

/// Which velocity of the step that a frame stands for. Frames hold that after the step.
enum class VelocityInStep { after, middle };
inline constexpr Choice<VelocityInStep> velocities_in_step[] = {
    {"after", VelocityInStep::after, "at the end of the step, as stored"},
    {"middle", VelocityInStep::middle,
     "half a step before: v - F h/(2 m), F the force on the grain, its weight included; of spins "
     "likewise with the torques of the contacts"}};

/// Turns the velocities and spins of the mobile grains, those after a step of `step` s, into those
/// in its middle, the means of before and after:
///   v - F h/(2 m), F = m (v_after - v_before)/h, the `force` of the frame;
///   w - T h/(2 I), T the torques of the frame's contacts, unless grains do not turn (`turning`).
/// Exact where nothing happens but gravity. Of a grain that bounces it is the mean of before and
/// after, at e = 1 no velocity at all. FormatError where the frame has no forces of grains.
template <int D>
void to_middle_of_step(const Grains& grains, double step, bool turning, Frame<D>& frame);

/// What the header of a table says of --velocity: the word, or "instant" of an imported run, whose frames
/// have one velocity. UsageError where one was chosen of such a run.
std::string velocity_line(const TrajectoryReader& run, const std::string& word, bool chosen);

/// Sums over frames with the velocities of one kind, made of those that frames hold.
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

/// What one looks at in the cell of a map: w, the third component of the mean velocity, in three
/// dimensions; T, the granular temperature: the mean of dv^2 over the grains' mass and the D components.
template <int D>
std::vector<Cell> flow_fields(const Vector<D>& velocity,
                              const typename KineticStress<D>::Mean& all_species);

/// The columns of grseg-kinetic with the numbers of a layer or cell, or their names without one. With
/// contents, areas or volumes, where masses do not tell them because densities differ; of a map with
/// flow_fields.
template <int D>
std::vector<Cell> kinetic_cells(const KineticStress<D>& stress, const SpeciesList& species,
                                bool with_contents, bool map, std::optional<std::size_t> layer);

/// What a reader of kinetic sums should know of the mean that they are counted from.
class KineticRemarks {
 public:
  /// Of a window of so many frames.
  template <int D>
  void add(const KineticStress<D>& stress, std::size_t species, std::size_t frames);
  /// About the layer's mean (`about_layer`): how much of the fluctuations is shear inside the layers.
  /// Where some grains are too few in their layer and frame for the mean: their number. And how much of
  /// its own motion a grain finds in the mean profile, where it is not little.
  std::vector<std::string> sentences(bool about_layer) const;

 private:
  double profile_ = 0, layer_bias_ = 0, of_shear_ = 0;  // J
  double left_out_ = 0, grains_ = 0;                    // number, over all frames
  double own_part_ = 0;                                 // the largest of a species in a window
  std::size_t own_frames_ = 0;                          // of that window
};

}  // namespace grseg
