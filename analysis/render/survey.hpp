// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/frames/contacts.hpp"
#include "analysis/render/drawing.hpp"
#include "analysis/render/grain_field.hpp"
#include "analysis/render/round_numbers.hpp"

#include <optional>
#include <vector>

namespace grseg {

/// What all pictures of a run have in common, so that they can be compared and a film does not
/// flicker: how far the grains reach, how strong contacts are, where the field's numbers lie. It is
/// taken from up to sixteen of the frames, evenly spread, the first and the last among them.
template <int D>
struct Survey {
  /// Of all grains that are present, and of boundary grains; m.
  Vector<D> low, high;
  double largest_diameter = 0;  // m, of all grains
  std::vector<double> forces;   // N, normal, of contacts that bear one, without order
  std::vector<double> values;   // of the field, without order
  Walls<D> walls;
  std::vector<double> times;  // s, of the frames
  /// What of a frame is read for a picture.
  TrajectoryReader::Fields needs{.velocity = false, .contacts = true, .force = false};
};

/// `frames` are numbers of the run's frames, at least one.
template <int D>
Survey<D> survey_frames(const TrajectoryReader& run, const std::vector<std::size_t>& frames,
                        const Grains& grains, const std::optional<GrainField<D>>& field);

/// The force (N) that 99 of 100 contacts do not exceed; 0 where there are none.
double strong_force(std::vector<double> forces);

/// The ends of a field's colours: those that FieldEnds names, but one number in a hundred may lie
/// beyond those which depend on the numbers; widened to round numbers.
Range range_of(FieldEnds ends, std::vector<double> values);

}  // namespace grseg
