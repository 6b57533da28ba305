// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/trajectory/reader.hpp"

#include <cstddef>
#include <string>
#include <vector>

namespace grseg {

/// A path inside a trajectory file that differs from formats/README.md.
struct Departure {
  std::string path;       // "/particles/grains/velocity/time"
  std::string what;       // "is not a hard link to /particles/grains/position/time"
  std::size_t count = 1;  // how often; `what` is the first
};

struct LayoutReport {
  std::vector<Departure> departures;
  std::size_t datasets = 0, chunks = 0;  // read completely
};

/// Compares the layout of a readable run with formats/README.md: exact types and shapes, units,
/// attributes, hard links of step and time. Also reads every dataset of the file completely, listed
/// in README.md or not, so that checksums of HDF5 are verified. FormatError naming the
/// dataset and the row where that fails, or where a filter is used that a plain reader may not
/// have.
LayoutReport check_layout(const TrajectoryReader& run);

}  // namespace grseg
