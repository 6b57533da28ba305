// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/import/convert/opened_archive.hpp"

#include "formats/import/open_archive.hpp"

namespace grseg {
namespace {

ArchiveFiles with_columns(ArchiveFiles files, const std::string& columns)
{
  files.columns = columns;
  return files;
}

}  // namespace

OpenedArchive::OpenedArchive(const ImportSettings& settings, const std::string& columns)
    : archive(open_archive(settings.format, with_columns(settings.files, columns))),
      drop_incomplete_(settings.drop_incomplete)
{
  if (!next()) throw FormatError("the archive holds no moment with grains and contacts");
  facts = collect_facts(archive->facts(), moment, settings);
}

bool OpenedArchive::next()
{
  try {
    return archive->next(moment);
  } catch (const TruncatedArchive&) {
    if (!drop_incomplete_) throw;
    return false;
  }
}

}  // namespace grseg
