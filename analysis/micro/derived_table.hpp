// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/frames/frame_loop.hpp"
#include "analysis/micro/derived_quantities.hpp"

#include <string>
#include <vector>

namespace grseg {

/// The options of grseg-micro --derived.
struct DerivedOptions {
  std::string force = "modulus", average = "contacts", partition = "size", pool = "none", depth,
              heights;

  /// Adds --force --average --partition --pool --depth --heights.
  void add_to(po::options_description& options);
};

/// UsageError, "--option why", where one of `options` was given although it has no meaning here.
void refuse_options(const po::variables_map& values, const std::vector<const char*>& options,
                    const char* why);

/// Writes the derived quantities of the tables that the command line names, to the file of --output
/// or to standard output; --begin and --end choose windows. UsageError where options have no
/// meaning here or tables of different grains are given together; RunError where no row is left.
void write_derived_table(const ToolInfo& info, const po::variables_map& values,
                         const DerivedOptions& options, const FrameOptions& frames,
                         const std::string& command);

}  // namespace grseg
