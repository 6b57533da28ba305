// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/cli/table.hpp"
#include "formats/cli/tool.hpp"
#include "formats/trajectory/reader.hpp"

#include <string>
#include <utility>
#include <vector>

/// Where a table comes from: the "# key: value" lines that every table begins with.
///
///   program   the tool that made the table, and its version
///   preset    value of --preset; only of tools that have presets
///   history   one line per command that led here, the oldest first, this tool's own last
///   input     digest of the content of each run the table was made of
///   bed       grains, seed and flow of a run (bed.hpp); one after each input
///   verified  "all", or the part of the inputs that could not be verified
///   incomplete  a run that had not ended
///   undecided   a check of an import that the archive cannot decide: "check: why"
///   waived      a check of an import that failed or was undecided, and was accepted: likewise
///   doubt       a limit to conclusions from several tables
namespace grseg {

using HeaderLine = std::pair<std::string, std::string>;
using Header = std::vector<HeaderLine>;

/// The line "program", e.g. "grseg-stress 1.0.0".
HeaderLine program_line(const ToolInfo& info);

/// The lines above, in that order, of a table made of one run by `command`. `preset` as returned by
/// preset_of.
Header provenance(const ToolInfo& info, const std::string& preset, const TrajectoryReader& run,
                  const std::string& command);

/// The values of all lines `key` of one table, or of several tables each value once, in order.
std::vector<std::string> header_values(const Table& table, const std::string& key);
std::vector<std::string> header_values(const std::vector<Table>& tables, const std::string& key);

/// The first line `key` of a table, or `otherwise` where there is none.
std::string header_or(const Table& table, const std::string& key, const std::string& otherwise);

/// The lines that say how a table was made (preset and settings), not from which data.
Header settings_of(const Table& table);

/// True where two values of such a line mean the same: their words are equal, or numbers that agree
/// up to round-off, as where one is 0.2 and the other 2.2 - 2.
bool same_setting(const std::string& a, const std::string& b);

/// The tables that the command line names, "-" being standard input; none where it names none.
/// As Table::read.
std::vector<Table> read_tables(const po::variables_map& values);

/// Header lines on trust that a result inherits from its tables: "verified", "incomplete",
/// "undecided", "waived" and "doubt", each value once. "verified: all" remains only where every
/// table has it.
Header trust_of(const std::vector<Table>& tables);

/// --trust of every tool that reads runs.
struct TrustOption {
  bool trust = false;

  void add_to(po::options_description& options);
  Verify verify() const { return trust ? Verify::no : Verify::yes; }
};

/// Header lines of a result made from `run`: `verified`; `incomplete` where the run had not ended;
/// for an import `undecided` and `waived`.
Header verification_lines(const TrajectoryReader& run);

}  // namespace grseg
