// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/import/facts/run_facts.hpp"

#include <memory>
#include <string>

namespace grseg {

/// An archive at one of its moments, from the first on, and the facts of its run.
struct OpenedArchive {
  /// Reads the first moment. Throws what readers and facts throw; OpenQuestions with all that is
  /// missing; FormatError where the archive holds no moment.
  OpenedArchive(const ImportSettings& settings, const std::string& columns);

  /// Reads the next moment; false at the end, which with --drop-incomplete an incomplete one is.
  bool next();

  std::unique_ptr<Archive> archive;
  ArchiveMoment moment;
  RunFacts facts;

 private:
  std::vector<bool> resting_at_first(const SpeciesSettings& settings);
  void ask_for_the_bed(const ImportSettings& settings, const std::vector<bool>& resting,
                       Questions& questions) const;

  bool drop_incomplete_;
};

}  // namespace grseg
