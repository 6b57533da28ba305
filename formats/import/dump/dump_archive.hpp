// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/import/common/archive.hpp"
#include "formats/import/dump/dump_reader.hpp"

#include <memory>
#include <string>
#include <vector>

namespace grseg {

/// What programs that write `dump custom` beside `dump local` differ in: how the columns of the
/// contacts are told. Mappings are those of contact_columns.hpp.
struct DumpDialect {
  /// The mapping where --columns is not given; "": the header does not tell.
  std::string (*assumed)(const DumpHeader& contacts, const ArchiveGrains& grains);
  /// The mapping that --columns means for these contacts. UsageError where it does not fit.
  std::string (*told)(const std::string& columns, const DumpHeader& contacts);
  /// What else --columns might be.
  std::vector<std::string> (*others)(const DumpHeader& contacts);
  const char* example;  // of --columns
  ArchiveFacts facts;   // as far as they are the same for every run
};

/// Facts of a program that at output evaluates contact forces anew, with the velocities of the end
/// of the step, and so half a step after those that moved the grains.
ArchiveFacts facts_of_late_forces(const std::string& program);

std::unique_ptr<Archive> open_dumps(const ArchiveFiles& files, const DumpDialect& dialect);

}  // namespace grseg
