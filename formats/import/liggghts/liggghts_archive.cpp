// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/import/liggghts/liggghts_archive.hpp"

#include "formats/import/dump/dump_archive.hpp"
#include "formats/import/liggghts/liggghts_columns.hpp"

namespace grseg {
namespace {

std::string assumed_columns(const DumpHeader& contacts, const ArchiveGrains&)
{
  for (auto& columns : liggghts_columns_of(contacts))
    if (columns.find(',') == std::string::npos) return columns;  // a preset
  return "";
}

/// All its grains are spheres, also where they move in a plane.
ArchiveFacts facts_of_liggghts()
{
  auto facts = facts_of_late_forces("LIGGGHTS");
  facts.discs = false;
  return facts;
}

FileRole role_of(const FileStart& start)
{
  return role_of_dump(start, are_of_one_compute);
}

}  // namespace

std::unique_ptr<Archive> open_liggghts(const ArchiveFiles& files)
{
  static const DumpDialect dialect{assumed_columns,       liggghts_mapping,
                                   liggghts_columns_of,   "pos,id,force,delta",
                                   liggghts_wall_mapping, facts_of_liggghts()};
  return open_dumps(files, dialect);
}

const ArchiveFormat liggghts_format{
    .name = "liggghts",
    .open = open_liggghts,
    .role = role_of,
    .takes_wall_contacts = true,
    .takes_wall_columns = true,
    .examples =
        "  grseg-import --format liggghts --grains 'atoms_*' --contacts 'contacts_*' \\\n"
        "    --units si --columns pos,id,force,delta --step 5e-6 --gravity 9.81 --slope 23 \\\n"
        "    --axes xz --boundary 3 -o run.h5\n",
    .notes = "  liggghts: --columns may also list the keywords of its compute pair/gran/local\n"};

}  // namespace grseg
