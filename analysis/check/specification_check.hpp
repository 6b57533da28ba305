// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/check/report.hpp"
#include "formats/trajectory/layout_check.hpp"
#include "formats/trajectory/reader.hpp"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace grseg {

/// Whether a file is as formats/README.md specifies, beyond what TrajectoryReader requires (numbers
/// finite, indices in range, offsets and times increasing, radii and masses positive, species 0 to
/// 2): its layout (formats/trajectory/layout_check.hpp), which datasets it must have, and in which
/// range their values lie.
class SpecificationCheck {
 public:
  /// Reads the whole file once; throws as check_layout does.
  explicit SpecificationCheck(const TrajectoryReader& run);

  /// Any frame, with contacts.
  void add(std::size_t index, const Frame<2>& frame);

  /// `specification`, the number of paths that depart from it; then a line for each of these paths,
  /// with the number of departures.
  std::vector<CheckLine> lines() const;

 private:
  void check_grains();
  void check_parameters();
  void check_observables();
  void depart(const std::string& path, const std::string& what);

  const TrajectoryReader& run_;
  LayoutReport layout_;
};

}  // namespace grseg
