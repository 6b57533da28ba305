// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "sim/scene.hpp"

#include <string>

namespace grseg {

struct RunOptions {
  std::string output;
  std::string command_line;
  bool overwrite = false;
  bool strict = false;
  bool quiet = false;
};

/// Deposits, tilts and runs `scene` into `options.output`. While it runs the file is called
/// output.part; a run that is interrupted (SIGINT, SIGTERM) or stops out of bounds leaves its
/// frames there, readable. A summary goes to standard error and, as numbers, into /parameters.
void simulate(const Scene& scene, const RunOptions& options);

}  // namespace grseg
