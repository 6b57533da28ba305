// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/frames/frame_loop.hpp"
#include "analysis/frames/sums.hpp"
#include "analysis/frames/velocity_in_step.hpp"
#include "analysis/stress/kinetic_stress.hpp"
#include "formats/core/species.hpp"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace grseg {

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
