// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/import/lammps/lammps_archive.hpp"

#include "formats/import/dump/dump_archive.hpp"
#include "formats/import/dump/named_columns.hpp"
#include "formats/import/liggghts/liggghts_columns.hpp"

#include <fmt/format.h>

namespace grseg {
namespace {

constexpr const char* recipe = "i=2,j=3,dist=4,force=5,tangential=8";
constexpr std::size_t recipe_columns = 10;

std::string assumed_columns(const DumpHeader& header, const ArchiveGrains& grains)
{
  if (auto named = columns_by_name(header, PlainForce::normal); !named.empty()) return named;
  return header.columns.size() >= recipe_columns && !grains.force.empty() ? recipe : "";
}

/// First what is most likely: of some that fit equally well, as without friction, the first counts.
std::vector<std::string> other_columns(const DumpHeader& header)
{
  std::vector<std::string> others;
  const auto last = header.columns.size();
  for (const std::size_t i : {2U, 1U})
    for (auto f = i + 2; f + 2 <= last; ++f) {
      const auto force = fmt::format("i={},j={},force={}", i, i + 1, f);
      const auto with_tangential = [&](std::size_t t) {
        if (t + 2 <= last) others.push_back(fmt::format("{},tangential={}", force, t));
      };
      with_tangential(f + 3);
      others.push_back(force);
      for (auto t = i + 2; t + 2 <= last; ++t)
        if (t > f + 3 || f >= t + 3) with_tangential(t);
    }
  return others;
}

bool is_of_lammps(const FileStart& start)
{
  return role_of_dump(start) == FileRole::grains || !are_of_liggghts(columns_of_dump(start));
}

}  // namespace

std::unique_ptr<Archive> open_lammps(const ArchiveFiles& files)
{
  static const DumpDialect dialect{
      assumed_columns, [](const std::string& columns, const DumpHeader&) { return columns; },
      other_columns,   recipe,
      nullptr,         facts_of_late_forces("LAMMPS")};
  return open_dumps(files, dialect);
}

const ArchiveFormat lammps_format{
    .name = "lammps",
    .open = open_lammps,
    .role = role_of_dump,
    .is_of_program = is_of_lammps,
    .takes_wall_columns = true,
    .examples =
        "  grseg-import --format lammps --grains atoms.dump --contacts contacts.dump \\\n"
        "    --columns i=2,j=3,dist=4,force=5,tangential=8 --units si --step 1e-5 \\\n"
        "    --gravity 9.8 --slope 23 --boundary 3 -o run.h5\n"
        "  grseg-import --format lammps --grains 'atoms.*.gz' --contacts 'contacts.*.gz' \\\n"
        "    --units si --step 1e-5 --gravity 3.83,-9.02,0 --small 1 --large 2 --boundary 3 \\\n"
        "    -o run.h5\n"
        "  grseg-import --format lammps --grains spheres.dump --contacts contacts.dump \\\n"
        "    --units si --step 1e-6 --gravity 3.83,0,-9.02 --axes xz --boundary 1 \\\n"
        "    --species fine=2 --species AM=3,4 --species SE=5 -o run.h5\n"};

}  // namespace grseg
