// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/cli/words.hpp"
#include "formats/import/common/archive.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <string_view>
#include <vector>

namespace grseg {
namespace {

/// One line per format.
constexpr const ArchiveFormat* formats[] = {
    &lammps_format,    //
    &liggghts_format,  //
    &mercury_format,   //
    &siconos_format,   //
    &lmgc90_format,    //
    &csv_format,
};

}  // namespace

std::span<const ArchiveFormat* const> archive_formats()
{
  return formats;
}

std::vector<std::string> names_of_formats()
{
  std::vector<std::string> names;
  for (const auto* format : formats) names.emplace_back(format->name);
  return names;
}

const ArchiveFormat& format_of(const std::string& name)
{
  for (const auto* format : formats)
    if (name == format->name) return *format;
  throw UsageError(unknown_word("--format", name, names_of_formats()));
}

std::unique_ptr<Archive> open_archive(const std::string& name, const ArchiveFiles& files)
{
  const auto& format = format_of(name);
  const auto refuse_unless = [&](bool applies, bool given, std::string_view option) {
    if (given && !applies)
      throw UsageError(
          fmt::format("{} does not apply to --format {}; leave it out", option, format.name));
  };
  refuse_unless(format.takes_contacts, !files.contacts.empty(), "--contacts");
  refuse_unless(format.takes_columns, !files.columns.empty(), "--columns");
  refuse_unless(format.takes_wall_contacts, !files.wall_contacts.empty(), "--wall-contacts");
  refuse_unless(format.takes_wall_columns, !files.wall_columns.empty(), "--wall-columns");
  refuse_unless(format.takes_map, !files.map.empty(), "--map");
  refuse_unless(format.takes_restart, !files.restart.empty(), "--restart");
  if (!files.grains.empty() && std::filesystem::is_regular_file(files.grains.front()))
    refuse_other_kind(files.grains.front());
  return format.open(files);
}

}  // namespace grseg
