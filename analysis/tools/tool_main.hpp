// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/cli/tool.hpp"

#include <string>

namespace grseg {

/// The main of a tool: its command line into `Settings`, by the options that `options_into` adds
/// for them, and then `work`, with the line of the history.
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
