// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/check/checks.hpp"
#include "formats/trajectory/layout_check.hpp"
#include "formats/trajectory/reader.hpp"

#include <cstddef>
#include <string>
#include <vector>

namespace grseg {

/// Checks that a file is undamaged: it was closed, has frames, and its frames and its content
/// outside frames agree with their digests. TrajectoryReader refuses files that cannot be read.
class ContentCheck {
 public:
  /// Open `run` with Verify::no, so that all damaged frames are counted.
  explicit ContentCheck(const TrajectoryReader& run) : run_(run) {}

  /// Checks a frame, which must have been read with all TrajectoryReader::Fields. Any order.
  template <int D>
  void add(std::size_t index, const Frame<D>& frame);
  std::vector<CheckLine> lines() const;

 private:
  const TrajectoryReader& run_;
  std::size_t frames_ = 0, damaged_ = 0, first_damaged_ = 0;
};

/// Compares a file with its specification, formats/README.md: its layout (layout_check.hpp of
/// formats/trajectory), required datasets and ranges of values. TrajectoryReader has already
/// checked that numbers are finite, indices in range, offsets and times increasing, radii and
/// masses positive, and species in the list.
class SpecificationCheck {
 public:
  /// Reads the whole file once; throws the errors of check_layout().
  explicit SpecificationCheck(const TrajectoryReader& run);

  /// Checks a frame, which must have been read with all TrajectoryReader::Fields. Any order.
  template <int D>
  void add(std::size_t index, const Frame<D>& frame);

  /// Line `specification` with the number of paths that deviate, then a line for each of these
  /// paths with its number of deviations.
  std::vector<CheckLine> lines() const;

 private:
  void check_grains();
  void check_parameters();
  void check_observables();
  template <int D>
  void check_wrapped(std::size_t index, const Frame<D>& frame, int axis, double length);
  void depart(const std::string& path, const std::string& what);

  const TrajectoryReader& run_;
  LayoutReport layout_;
};

}  // namespace grseg
