// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/cli/interruption.hpp"
#include "formats/cli/tool.hpp"
#include "formats/core/errors.hpp"
#include "formats/import/convert/importer.hpp"

#include <fmt/format.h>

#include <cstdio>

using namespace grseg;

namespace {

constexpr ToolInfo info{
    "grseg-import", "archived runs of other programs become trajectories, verified on the way.",
    "grseg-import --format NAME --grains FILES --contacts FILES [options] -o run.h5",
    "  grseg-import --format lammps --grains atoms.dump --contacts contacts.dump \\\n"
    "    --columns i=2,j=3,dist=4,force=5,tangential=8 --units si --step 1e-5 \\\n"
    "    --gravity 9.8 --slope 23 --boundary 3 -o run.h5\n"
    "  grseg-import --format lammps --grains 'atoms.*.gz' --contacts 'contacts.*.gz' --units si "
    "\\\n"
    "    --step 1e-5 --gravity 3.83,-9.02,0 --small 1 --large 2 --boundary 3 -o run.h5\n"
    "  grseg-import --format liggghts --grains 'atoms_*' --contacts 'contacts_*' --units si "
    "\\\n"
    "    --columns pos,id,force,delta --step 5e-6 --gravity 9.81 --slope 23 --axes xz \\\n"
    "    --boundary 3 -o run.h5\n"
    "  grseg-import --format mercury --grains run.data --contacts run.fstat \\\n"
    "    --restart run.restart --units si -o run.h5\n"
    "  grseg-import --format siconos --grains run.hdf5 --units si --gravity 9.81 --slope 23 "
    "-o run.h5\n"
    "  grseg-import --format csv --grains grains.csv --contacts contacts.csv --units si \\\n"
    "    --step 1e-5 --gravity 9.81 --slope 23 -o run.h5\n\n"
    "  csv: tables of named columns (grains: time id x y vx vy radius|diameter; and z vz omega "
    "mass\n"
    "  type fixed fx fy fz; contacts: time i j fx fy; and fz overlap bx by bz); more names and "
    "all\n"
    "  formats: docs/studies/archives.md\n"};

void check(const ImportSettings& settings, const po::variables_map& values)
{
  if (values.count("input") > 0)
    throw UsageError(
        fmt::format("'{}' belongs to no option; name files with --grains and --contacts",
                    values["input"].as<std::vector<std::string>>()[0]));
  if (settings.format.empty()) throw UsageError("name the program with --format; --help lists all");
  if (settings.storage.compression < 0 || settings.storage.compression > 9)
    throw UsageError("--compression is a deflate level from 0 (none) to 9");
  if (settings.accept_residual && !(*settings.accept_residual > 0))
    throw UsageError("--accept-residual must be positive");
}

}  // namespace

int main(int argc, char** argv)
{
  ImportSettings settings;
  const auto options = import_options(settings);
  return run_tool(argc, argv, info, options, [&](const po::variables_map& values) {
    check(settings, values);
    listen_to_signals();
    const auto report = import_archive(settings, command_line(argc, argv));
    if (!settings.quiet) fmt::print(stderr, "{}", to_text(report));
  });
}
