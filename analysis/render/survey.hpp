// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/frames/contacts.hpp"
#include "analysis/render/drawing.hpp"
#include "analysis/render/grain_field.hpp"
#include "analysis/render/round_numbers.hpp"

#include <optional>
#include <vector>

namespace grseg {

/// Measured ranges that all pictures of a run share, so that pictures can be compared and a film does not
/// flicker: extent of the grains, forces of contacts, values of the field. They are measured in up to
/// sixteen of the frames, evenly spread from the first to the last.
template <int D>
struct Survey {
  /// Corners of the box around all grains that are present, including boundary grains; m.
  Vector<D> low, high;
  double largest_diameter = 0;  // diameter of the largest grain, m
  std::vector<double> forces;   // normal forces of contacts, N, all positive, unsorted
  std::vector<double> values;   // values of the field, unsorted
  Walls<D> walls;
  std::vector<double> times;  // times of the surveyed frames, s
  /// Data of a frame that are read for a picture.
  TrajectoryReader::Fields needs{.velocity = false, .contacts = true, .force = false};
};

/// Surveys the run; `frames` are numbers of its frames, at least one.
template <int D>
Survey<D> survey_frames(const TrajectoryReader& run, const std::vector<std::size_t>& frames,
                        const Grains& grains, const std::optional<GrainField<D>>& field);

/// Normal force (N) that 99 of 100 contacts do not exceed; 0 if there are no contacts.
double strong_force(std::vector<double> forces);

/// Range of a field's colour scale, chosen by FieldEnds. An end that depends on the values is set so that
/// one value in a hundred lies beyond; then the range is widened to round numbers.
Range range_of(FieldEnds ends, std::vector<double> values);

}  // namespace grseg
