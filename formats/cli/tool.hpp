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

/// An option and the values that --preset paper and --preset rigorous give it, as typed; "" keeps
/// its default.
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

/// The frame of every program: parses the command line (an unknown option is refused with the
/// nearest known one), handles --help, --version and --preset, and turns an exception of `body`
/// into one sentence on standard error and an exit code (errors.hpp). Arguments that are not
/// options are passed on as "input". `body` gets the parsed options; values set by a preset count
/// as defaults.
int run_tool(int argc, char** argv, const ToolInfo& info, const po::options_description& options,
             const std::function<void(const po::variables_map&)>& body);

/// The preset that was given, or "none".
std::string preset_of(const po::variables_map& values);

/// The command line as typed, but with the program's bare name and without --threads, --part and
/// --join, on which no output depends: a line of the history.
std::string command_line(int argc, char** argv);

/// The single run on the command line. UsageError where it names no run or several; `remedy` then
/// ends the sentence.
std::string single_input(const po::variables_map& values, const char* remedy);

/// An option of a time in s; `place` stays empty where it is not given.
po::typed_value<double>* time_option(std::optional<double>& place);

/// Names of the shells for which completion_script() works.
std::vector<std::string> shells();

/// Output of --completion SHELL: a script by which that shell completes the tool's options, the
/// files of options named FILE, the words of other options (words.hpp), and input files. UsageError
/// for a shell that is not among `shells`.
std::string completion_script(const std::string& shell, const std::string& tool,
                              const boost::program_options::options_description& options);

}  // namespace grseg
