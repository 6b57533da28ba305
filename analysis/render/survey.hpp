// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/frames/contacts.hpp"
#include "analysis/render/drawing.hpp"
#include "analysis/render/grain_field.hpp"
#include "analysis/render/round_numbers.hpp"

#include <optional>
#include <vector>

namespace grseg {

/// Measures that all pictures of a run share, so that they can be compared and a film does not flicker:
/// how far grains reach, how strong contacts are, where the field's numbers lie. They are taken from up
/// to sixteen of the frames, evenly spread from the first to the last.
template <int D>
struct Survey {
  /// Corners of the box around all grains that are present, boundary grains included; m.
  Vector<D> low, high;
  double largest_diameter = 0;  // m, of all grains
  std::vector<double> forces;   // normal forces of contacts, N, all positive, without order
  std::vector<double> values;   // of the field, without order
  Walls<D> walls;
  std::vector<double> times;  // s, of the frames
  /// Parts of a frame that are read for a picture.
  TrajectoryReader::Fields needs{.velocity = false, .contacts = true, .force = false};
};

/// Surveys the run; `frames` are numbers of its frames, at least one.
template <int D>
Survey<D> survey_frames(const TrajectoryReader& run, const std::vector<std::size_t>& frames,
                        const Grains& grains, const std::optional<GrainField<D>>& field);

/// The force (N) that 99 of 100 contacts do not exceed; 0 where there are none.
double strong_force(std::vector<double> forces);

/// Range of a field's colours, by FieldEnds. An end that is taken from the values leaves one in a hundred
/// beyond it. Widened to round numbers.
Range range_of(FieldEnds ends, std::vector<double> values);

}  // namespace grseg
