// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/errors.hpp"

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

/// "0.1.0"; with the git hash: "0.1.0 (1a2b3c4)".
std::string version();
std::string version_with_hash();

/// The known word nearest to `word`, or "" where none is near.
std::string nearest(const std::string& word, const std::vector<std::string>& known);

/// Has the system write what it keeps of `path` to the disk. RunError where that fails.
void bring_to_disk(const std::string& path);

/// Brings the closed file `beside` to the disk and renames it to `path`, so that `path` is whole or
/// not there. RunError where that fails; `beside` is then still there.
void publish_file(const std::string& beside, const std::string& path);

/// Writes `text` to `path`, whole or not at all (write beside, fsync, rename); "-" or "" is
/// standard output. RunError where that fails.
void write_whole(const std::string& path, std::string_view text);

/// The one run that the command line names. UsageError where it names none, or several: then
/// `remedy` ends the sentence.
std::string the_run(const po::variables_map& values, const char* remedy);

/// An option of a time in s; `place` stays empty where it is not given.
po::typed_value<double>* time_option(std::optional<double>& place);

/// Refuses to write where a folder is, or a file unless `overwrite` (UsageError).
void refuse_to_overwrite(const std::string& path, bool overwrite);

/// Refuses a path that is no readable file (UsageError).
void require_file(const std::string& path);

}  // namespace grseg
