// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/trajectory/reader.hpp"

#include <cstddef>
#include <string>
#include <vector>

namespace grseg {

/// A deviation of a trajectory file from formats/README.md.
struct Departure {
  std::string path;       // path in the file: "/particles/grains/velocity/time"
  std::string what;       // deviation: "is not a hard link to /particles/grains/position/time"
  std::size_t count = 1;  // number of similar deviations; `what` is the first one
};

struct LayoutReport {
  std::vector<Departure> departures;
  std::size_t datasets = 0, chunks = 0;  // numbers of datasets and chunks read completely
};

/// Compares the layout of a readable run with formats/README.md: exact types and shapes, units,
/// attributes, hard links of step and time. Also reads every dataset of the file completely, even
/// if README.md does not list it, so that HDF5 verifies its checksums. Throws FormatError, which
/// names dataset and row, if that fails or if a dataset uses a filter that other readers may lack.
LayoutReport check_layout(const TrajectoryReader& run);

}  // namespace grseg
