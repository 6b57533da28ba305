// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/import/liggghts/liggghts_archive.hpp"

#include "formats/import/dump/contact_columns.hpp"
#include "formats/import/dump/dump_archive.hpp"
#include "formats/import/dump/named_columns.hpp"
#include "formats/import/liggghts/liggghts_columns.hpp"

#include <algorithm>

namespace grseg {
namespace {

/// Whether the ids and the force of both mappings are the same columns.
bool are_at_the_same_places(const std::string& keywords, const std::string& named,
                            const DumpHeader& contacts)
{
  const auto places_of = [&](const std::string& mapping) {
    ContactColumns columns(mapping);
    columns.look_up(contacts.columns, contacts.place);
    const auto& places = columns.wanted();
    return std::vector(places.begin(),
                       places.begin() + std::min<std::ptrdiff_t>(std::ssize(places), 3));
  };
  return places_of(liggghts_mapping(keywords, contacts)) == places_of(named);
}

/// All its grains are spheres, also where they move in a plane.
ArchiveFacts facts_of_liggghts()
{
  auto facts = facts_of_late_forces("LIGGGHTS");
  facts.discs = false;
  return facts;
}

/// Names that say what columns hold choose the list of keywords that has ids and force there, if one
/// does: only the list knows the order of all others. Without such names it is a preset.
std::string assumed_columns(const DumpHeader& contacts, const ArchiveGrains&)
{
  auto named = columns_by_name(contacts, PlainForce::whole);
  for (auto& columns : liggghts_columns_of(contacts)) {
    const bool is_preset = columns.find(',') == std::string::npos;
    if (named.empty() ? is_preset : are_at_the_same_places(columns, named, contacts))
      return columns;
  }
  return named;
}

bool is_of_liggghts(const FileStart& start)
{
  return role_of_dump(start) == FileRole::grains || are_of_liggghts(columns_of_dump(start));
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
    .role = role_of_dump,
    .is_of_program = is_of_liggghts,
    .takes_wall_contacts = true,
    .takes_wall_columns = true,
    .examples =
        "  grseg-import --format liggghts --grains 'atoms_*' --contacts 'contacts_*' \\\n"
        "    --units si --columns pos,id,force,delta --step 5e-6 --gravity 9.81 --slope 23 \\\n"
        "    --axes xz --boundary 3 -o run.h5\n",
    .notes = "  liggghts: --columns may also list the keywords of its compute pair/gran/local\n"};

}  // namespace grseg
