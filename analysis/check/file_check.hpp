// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/check/checks.hpp"
#include "formats/trajectory/layout_check.hpp"
#include "formats/trajectory/reader.hpp"

#include <cstddef>
#include <string>
#include <vector>

namespace grseg {

/// Checks a file against what was written: it was closed, has frames, and each frame and what is
/// there once agree with their digests. TrajectoryReader refuses files that cannot be read at all.
class ContentCheck {
 public:
  /// `run` is best opened with Verify::no, so that all damaged frames are counted.
  explicit ContentCheck(const TrajectoryReader& run) : run_(run) {}

  /// Any frame, whole (all of TrajectoryReader::Fields).
  template <int D>
  void add(std::size_t index, const Frame<D>& frame);
  std::vector<CheckLine> lines() const;

 private:
  const TrajectoryReader& run_;
  std::size_t frames_ = 0, damaged_ = 0, first_damaged_ = 0;
};

/// Compares a file with formats/README.md, beyond what TrajectoryReader requires (numbers finite,
/// indices in range, offsets and times increasing, radii and masses positive, species in the list):
/// its layout (formats/trajectory/layout_check.hpp), which datasets it must have, and in which
/// range their values lie.
class SpecificationCheck {
 public:
  /// Reads the whole file once; throws as check_layout does.
  explicit SpecificationCheck(const TrajectoryReader& run);

  /// Any frame, with contacts.
  template <int D>
  void add(std::size_t index, const Frame<D>& frame);

  /// `specification`, the number of paths that depart from it; then a line for each of these paths,
  /// with the number of departures.
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
