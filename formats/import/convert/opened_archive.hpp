// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/import/facts/run_facts.hpp"

#include <memory>
#include <string>

namespace grseg {

/// An archive at one of its moments, from the first on, and the facts of its run.
struct OpenedArchive {
  /// Reads the first moment. Throws what readers and facts throw; FormatError where the archive
  /// holds no moment.
  OpenedArchive(const ImportSettings& settings, const std::string& columns);

  /// Reads the next moment; false at the end, which with --drop-incomplete an incomplete one is.
  bool next();

  std::unique_ptr<Archive> archive;
  ArchiveMoment moment;
  RunFacts facts;

 private:
  bool drop_incomplete_;
};

}  // namespace grseg
