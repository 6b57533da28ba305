// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/import/convert/opened_archive.hpp"

#include "formats/import/convert/imported_bed.hpp"

#include <fmt/format.h>

namespace grseg {

OpenedArchive::OpenedArchive(const ImportSettings& settings, const std::string& columns,
                             std::shared_ptr<const Roster> roster)
    : moments_(settings, columns), roster_(std::move(roster))
{
  if (!next()) throw FormatError("the archive holds no moment with grains and contacts");
  if (!roster_ && moment.grains.size() == 0)
    throw OtherGrains(fmt::format("{}: there are no grains", moment.place));
  facts = collect_facts(archive().facts(), all_grains(), settings);
}

OpenedArchive open_with_roster(const ImportSettings& settings)
{
  return {settings, settings.files.columns, std::make_shared<const Roster>(read_roster(settings))};
}

OpenedArchive open_with_grains(const ImportSettings& settings)
{
  try {
    OpenedArchive opened(settings, settings.files.columns);
    ImportedBed(opened.all_grains(), opened.facts, settings);
    return opened;
  } catch (const OtherGrains&) {
  } catch (const UsageError&) {
    if (!grains_change_early(settings)) throw;
  }
  return open_with_roster(settings);
}

}  // namespace grseg
