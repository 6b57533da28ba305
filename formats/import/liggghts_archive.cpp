// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/import/liggghts_archive.hpp"

#include "formats/import/dump_archive.hpp"
#include "formats/import/liggghts_columns.hpp"

namespace grseg {
namespace {

std::string assumed_columns(const DumpHeader& contacts, const ArchiveGrains&)
{
  for (auto& columns : liggghts_columns_of(contacts))
    if (columns.find(',') == std::string::npos) return columns;  // a preset
  return "";
}

}  // namespace

std::unique_ptr<Archive> open_liggghts(const ArchiveFiles& files)
{
  static const DumpDialect dialect = [] {
    DumpDialect d{assumed_columns, liggghts_mapping, liggghts_columns_of, "pos,id,force,delta", {}};
    d.facts.forces_are_late = true;
    d.facts.tolerance = 5e-2;
    d.facts.tolerance_reason =
        "LIGGGHTS evaluates contact forces anew at output, with the velocities of the end of the "
        "step";
    return d;
  }();
  return open_dumps(files, dialect);
}

}  // namespace grseg
