// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/import/common/archive.hpp"
#include "formats/import/dump/dump_reader.hpp"

#include <memory>
#include <string>
#include <vector>

namespace grseg {

/// Differences of programs that write `dump custom` (grains) and `dump local` (contacts): the
/// columns of the contacts. A mapping is a text as in contact_columns.hpp.
struct DumpDialect {
  /// The mapping without --columns; "" if the header leaves it open.
  std::string (*assumed)(const DumpHeader& contacts, const ArchiveGrains& grains);
  /// Converts the value of --columns to a mapping for these contacts. Throws UsageError if it does
  /// not match them.
  std::string (*mapping)(const std::string& columns, const DumpHeader& contacts);
  /// Other possible values of --columns.
  std::vector<std::string> (*others)(const DumpHeader& contacts);
  const char* example;  // example of a value of --columns
  /// Converts the value of --wall-columns to a mapping of WallRows for these rows of contacts with
  /// walls; null if the program writes no such rows.
  std::string (*wall_mapping)(const std::string& columns, const DumpHeader& walls);
  ArchiveFacts facts;  // facts common to all runs of the program
};

/// Facts of a program that evaluates contact forces again for output, with velocities half a step
/// later than the velocities that moved the grains (imbalance.hpp).
ArchiveFacts facts_of_late_forces(const std::string& program);

/// Role of a dump: grains if its rows are labelled ATOMS, otherwise contacts.
FileRole role_of_dump(const FileStart& start);

/// Names of the columns of a dump's first block.
std::vector<std::string> columns_of_dump(const FileStart& start);

std::unique_ptr<Archive> open_dumps(const ArchiveFiles& files, const DumpDialect& dialect);

}  // namespace grseg
