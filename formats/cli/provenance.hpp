// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/cli/table.hpp"
#include "formats/cli/tool.hpp"
#include "formats/trajectory/reader.hpp"

#include <string>
#include <utility>
#include <vector>

/// Provenance of a table: the "# key: value" lines at the beginning of every table.
///
///   program   the tool that made the table, and its version
///   preset    value of --preset; only in tables of tools that have presets
///   history   one line per command that led to the table, oldest first, this tool's own last
///   input     digest of the content of each run from which the table was made
///   bed       identity of a run (bed.hpp): grains, seed and flow; one line after each input
///   verified  "all", or the part of the inputs that could not be verified
///   incomplete  a run that had not ended
///   undecided   a check of an import that the archive cannot decide: "check: reason"
///   waived      a check of an import that failed or was undecided, but that the user accepted
///   doubt       a limit to conclusions from several tables
namespace grseg {

using HeaderLine = std::pair<std::string, std::string>;
using Header = std::vector<HeaderLine>;

/// The line "program", e.g. "grseg-stress 1.0.0".
HeaderLine program_line(const ToolInfo& info);

/// The lines program to bed, in the order above, for a table that `command` makes from one run.
/// `preset` is the result of preset_of().
Header provenance(const ToolInfo& info, const std::string& preset, const TrajectoryReader& run,
                  const std::string& command);

/// Values of all header lines `key`, in order. For several tables each value appears once.
std::vector<std::string> header_values(const Table& table, const std::string& key);
std::vector<std::string> header_values(const std::vector<Table>& tables, const std::string& key);

/// Value of the first header line `key` of a table; `otherwise` if there is none.
std::string header_or(const Table& table, const std::string& key, const std::string& otherwise);

/// Header lines on how a table was computed (preset and settings), without the lines on its data.
Header settings_of(const Table& table);

/// True if two values of a header line mean the same: their words are equal, or are numbers that
/// agree up to round-off, such as 0.2 and 2.2 - 2.
bool same_setting(const std::string& a, const std::string& b);

/// The tables that the command line names ("-": standard input), read by Table::read(). Throws
/// UsageError with the remedy if it names none.
std::vector<Table> read_tables(const po::variables_map& values, const WantedTables& wanted);

/// Header lines on reliability that a result inherits from its tables: "verified", "incomplete",
/// "undecided", "waived" and "doubt", each value once. "verified: all" remains only if no table has
/// another value.
Header trust_of(const std::vector<Table>& tables);

/// Option --trust: reads runs without comparing their content with its digests.
struct TrustOption {
  bool trust = false;

  void add_to(po::options_description& options);
  Verify verify() const { return trust ? Verify::no : Verify::yes; }
};

/// Header lines on the reliability of `run`: "verified"; "incomplete" if the run had not ended; for
/// an import also "cell", "coordinates", "undecided", "waived" and "remarks".
Header verification_lines(const TrajectoryReader& run);

}  // namespace grseg
