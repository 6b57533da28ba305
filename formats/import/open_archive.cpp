// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/import/open_archive.hpp"

#include "formats/cli/words.hpp"
#include "formats/core/errors.hpp"
#include "formats/import/common/archive.hpp"
#include "formats/import/csv/csv_archive.hpp"
#include "formats/import/lammps/lammps_archive.hpp"
#include "formats/import/liggghts/liggghts_archive.hpp"
#include "formats/import/mercury/mercury_archive.hpp"
#include "formats/import/siconos/siconos_archive.hpp"

namespace grseg {
namespace {

struct Format {
  const char* name;
  std::unique_ptr<Archive> (*open)(const ArchiveFiles&);
};

/// One line per format.
constexpr Format formats[] = {
    {"lammps", open_lammps},   {"liggghts", open_liggghts}, {"mercury", open_mercury},
    {"siconos", open_siconos}, {"csv", open_csv},
};

}  // namespace

const std::vector<std::string>& archive_formats()
{
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all;
    for (const auto& format : formats) all.emplace_back(format.name);
    return all;
  }();
  return names;
}

std::unique_ptr<Archive> open_archive(const std::string& format, const ArchiveFiles& files)
{
  for (const auto& known : formats)
    if (format == known.name) return known.open(files);
  throw UsageError(unknown_word("--format", format, archive_formats()));
}

}  // namespace grseg
