// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/import/common/archive.hpp"
#include "formats/import/dump/contact_columns.hpp"
#include "formats/import/dump/dump_archive.hpp"
#include "formats/import/liggghts/liggghts_columns.hpp"

#include <fmt/format.h>

#include <memory>

namespace grseg {

namespace {

constexpr const char* recipe = "i=2,j=3,dist=4,force=5,tangential=8";
constexpr std::size_t recipe_columns = 10;

std::string assumed_columns(const DumpHeader& header, const ArchiveGrains& grains)
{
  if (auto named = columns_by_name(header, PlainForce::normal); !named.empty()) return named;
  return header.columns.size() >= recipe_columns && !grains.force.empty() ? recipe : "";
}

/// Possible values of --columns, the most likely ones first. If several fit equally well, as
/// without friction, the first one is used.
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

/// Opens a `dump custom` of grains and a `dump local` of contacts of LAMMPS (doc/src/dump.rst,
/// compute_pair_local.rst, pair_gran.rst). The contacts come from two computes with the same
/// `cutoff radius`:
///   compute pr all property/local patom1 patom2 cutoff radius
///   compute pl all pair/local dist fx fy fz p1 p2 p3 cutoff radius
///   dump c all local N contacts.dump index c_pr[1] c_pr[2] c_pl[1] c_pl[2] ... c_pl[7]
/// fx fy fz are only the NORMAL part of the force on patom1, p1 p2 p3 its tangential part; the
/// force is their sum. Names like c_pl[3] have no meaning, so --columns sets it. Without --columns
/// the ten columns above are assumed, and the grains' force balances verify this. Columns with
/// meaningful names are recognised (contact_columns.hpp). dx dy dz are never used, because their
/// sign depended on tags until 12Jun2025: the branch is x_patom1 - x_patom2. Contacts of fix
/// wall/gran are in no dump local, but with its keyword `contacts` they may be columns of the dump
/// of grains (wall_contacts.hpp).
std::unique_ptr<Archive> open_lammps(const ArchiveFiles& files)
{
  static const DumpDialect dialect{
      assumed_columns, [](const std::string& columns, const DumpHeader&) { return columns; },
      other_columns,   recipe,
      nullptr,         facts_of_late_forces("LAMMPS")};
  return open_dumps(files, dialect);
}

}  // namespace

const ArchiveFormat lammps_format{
    .name = "lammps",
    .open = open_lammps,
    .role = role_of_dump,
    .is_of_program = is_of_lammps,
    .takes_map = true,
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
