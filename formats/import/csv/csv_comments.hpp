// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/import/common/archive.hpp"

#include <string>
#include <vector>

namespace grseg {

/// What the comments above a table of grains say of the run, in the table's units, a line each:
///   # periodic: x 0 0.35          for each axis that is
///   # gravity: 3.83 -9.02 0
///   # step: 1e-5
///   # units: si                   or cgs, lj
///   # grains: spheres             or discs
/// Other comments are passed over.
struct CsvComments {
  ArchiveFacts facts;
  Vec3 low = Vec3::Zero(), high = Vec3::Zero();  // of the periods
  std::array<bool, 3> periodic{};
};

/// FormatError where one of these lines is not of its form.
CsvComments read_csv_comments(const std::vector<std::string>& comments);

}  // namespace grseg
