// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/core/errors.hpp"

#include <boost/program_options.hpp>

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace grseg {

namespace po = boost::program_options;

/// An option and what --preset paper and --preset rigorous set it to, as it would be typed; "":
/// they leave it as it is by default.
struct PresetOption {
  const char *option, *paper, *rigorous;
};

struct ToolInfo {
  const char* name;                            // "grseg-stress"
  const char* summary;                         // one sentence
  const char* usage;                           // "grseg-stress run.h5 [options]"
  const char* examples;                        // shown first by --help
  std::span<const PresetOption> presets = {};  // none: the tool has no --preset
};

/// What every program of the suite does alike: parse the command line (an unknown option is
/// refused with the nearest known one), --help, --version and --preset, and turn what `body` throws
/// into one sentence on standard error and an exit code (errors.hpp). Arguments that are no options
/// come as "input". `body` gets the parsed options; what a preset sets counts as default.
int run_tool(int argc, char** argv, const ToolInfo& info, const po::options_description& options,
             const std::function<void(const po::variables_map&)>& body);

/// The preset that was given, or "none".
std::string preset_of(const po::variables_map& values);

/// The command line as typed, but with the program's bare name and without --threads, which changes
/// no byte of any output: a line of a history chain.
std::string command_line(int argc, char** argv);

/// The one run that the command line names. UsageError where it names none, or several: then
/// `remedy` ends the sentence.
std::string only_run(const po::variables_map& values, const char* remedy);

/// An option of a time in s; `place` stays empty where it is not given.
po::typed_value<double>* time_option(std::optional<double>& place);

}  // namespace grseg
