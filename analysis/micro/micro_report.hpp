// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/frames/frame_loop.hpp"
#include "analysis/micro/micro_view.hpp"

#include <string>

namespace grseg {

/// The options of grseg-micro --derived.
struct ReportOptions {
  std::string force = "modulus", average = "contacts", partition = "size", pool = "none", depth,
              heights;

  /// Adds --force --average --partition --pool --depth --heights.
  void add_to(po::options_description& options);
};

/// UsageError, "--option why", where one of the options was given that have no meaning here.
void refuse_options(const po::variables_map& values, const std::vector<const char*>& options,
                    const char* why);

/// Writes the derived table of the tables that the command line names, to the file of --output or
/// to standard output; --begin and --end choose windows. UsageError where options have no meaning
/// here or tables of different grains are given together; RunError where no row is left.
void report_derived(const ToolInfo& info, const po::variables_map& values,
                    const ReportOptions& options, const FrameOptions& frames,
                    const std::string& command);

}  // namespace grseg
