// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/cli/tool.hpp"

#include <string>

namespace grseg {

/// Main function of an analysis tool. Parses the command line into `Settings` by the options of
/// `options_into`, and then calls `work`, whose `command` is this tool's line of the history.
template <class Settings>
int tool_main(int argc, char** argv, const ToolInfo& info,
              po::options_description (*options_into)(Settings&),
              void (*work)(Settings&, const po::variables_map&, const std::string& command))
{
  Settings settings;
  const auto options = options_into(settings);
  return run_tool(argc, argv, info, options, [&](const po::variables_map& values) {
    work(settings, values, command_line(argc, argv));
  });
}

}  // namespace grseg
