// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/import/common/archive.hpp"
#include "formats/import/dump/dump_reader.hpp"

#include <memory>
#include <string>
#include <vector>

namespace grseg {

/// How programs that write `dump custom` beside `dump local` differ: in the columns of the
/// contacts. A mapping is the text of contact_columns.hpp.
struct DumpDialect {
  /// The mapping without --columns; "" where the header does not show it.
  std::string (*assumed)(const DumpHeader& contacts, const ArchiveGrains& grains);
  /// The mapping that --columns means for these contacts. UsageError where it does not fit.
  std::string (*mapping)(const std::string& columns, const DumpHeader& contacts);
  /// Other possible values of --columns.
  std::vector<std::string> (*others)(const DumpHeader& contacts);
  const char* example;  // of --columns
  /// The meaning of --wall-columns for these rows of contacts with walls, as a mapping of WallRows;
  /// null where the program writes no such rows.
  std::string (*wall_mapping)(const std::string& columns, const DumpHeader& walls);
  ArchiveFacts facts;  // common to all runs of the program
};

/// Facts of a program that re-evaluates contact forces at output, with velocities half a step later
/// than the velocities that moved the grains.
ArchiveFacts facts_of_late_forces(const std::string& program);

/// Grains where a dump holds ATOMS, contacts where it holds other rows.
FileRole role_of_dump(const FileStart& start);

/// The names of the columns of the first block.
std::vector<std::string> columns_of_dump(const FileStart& start);

std::unique_ptr<Archive> open_dumps(const ArchiveFiles& files, const DumpDialect& dialect);

}  // namespace grseg
