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

/// An option and its values (as typed) under --preset paper and --preset rigorous; "" means that
/// the preset does not set the option.
struct PresetOption {
  const char *option, *paper, *rigorous;
};

struct ToolInfo {
  const char* name;                            // name of the tool: "grseg-stress"
  const char* summary;                         // purpose of the tool, one sentence
  const char* usage;                           // command line: "grseg-stress run.h5 [options]"
  const char* examples;                        // lines that --help shows before the options
  std::span<const PresetOption> presets = {};  // options that presets set; none: no --preset
  // Answer to an unknown option that people may expect; "" if there is none.
  std::string (*absent)(std::string option) = nullptr;
};

/// Main function of every tool. Parses the command line (for an unknown option the message suggests
/// the nearest known one) and handles --help, --columns, --version and --preset. Turns an exception
/// of `body` into one sentence on standard error and an exit code (errors.hpp). `body` receives the
/// parsed options, with all arguments that are not options under "input". Values set by a preset
/// count as defaults.
int run_tool(int argc, char** argv, const ToolInfo& info, const po::options_description& options,
             const std::function<void(const po::variables_map&)>& body);

/// The preset on the command line, or "none".
std::string preset_of(const po::variables_map& values);

/// Command line for the history of an output: as typed, but with the program's bare name and
/// without --threads, which does not affect the output.
std::string command_line(int argc, char** argv);

/// The single run on the command line. Throws UsageError if it names no run or several; for several
/// runs the message ends with `remedy`.
std::string single_input(const po::variables_map& values, const char* remedy);

/// An option whose value is a time (s); `place` stays empty if the option is not given.
po::typed_value<double>* time_option(std::optional<double>& place);

/// Names of the shells for which completion_script() works.
std::vector<std::string> shells();

/// Output of --completion SHELL: a script that lets the shell complete options of the tool, file
/// names after options with a value FILE, words after other options (words.hpp), and input files.
/// Throws UsageError for a shell that is not in shells().
std::string completion_script(const std::string& shell, const std::string& tool,
                              const boost::program_options::options_description& options);

}  // namespace grseg
