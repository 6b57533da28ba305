// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/import/common/questions.hpp"
#include "formats/import/convert/moments.hpp"
#include "formats/import/convert/roster.hpp"
#include "formats/import/facts/run_facts.hpp"

#include <memory>
#include <string>

namespace grseg {

/// An archive at one of its moments, from the first on, and the facts of its run. Where grains come
/// and go there is a roster of them, and facts are found from it.
class OpenedArchive {
 public:
  /// Reads the first moment. Throws what readers and facts throw; OpenQuestions with `questions` and
  /// all that is missing; FormatError where the archive holds no moment, OtherGrains where it begins
  /// without grains and there is no roster.
  OpenedArchive(const ImportSettings& settings, const std::string& columns,
                std::shared_ptr<const Roster> roster = nullptr, Questions questions = {});

  /// Reads the next moment; false at the end. OpenQuestions where the reader cannot go on.
  bool next();
  /// The same without its contacts.
  bool next_grains() { return moments_.next_grains(moment); }

  const Archive& archive() const { return moments_.archive(); }
  std::vector<std::string> remarks() const { return moments_.remarks(); }
  /// Of all moments; null where they all have the grains of the first one.
  const std::shared_ptr<const Roster>& roster() const { return roster_; }
  /// A moment with all grains of the run: the roster's, or as long as it has not been left the first.
  const ArchiveMoment& all_grains() const { return roster_ ? roster_->all : moment; }

  ArchiveMoment moment;
  RunFacts facts;

 private:
  std::vector<bool> resting_grains_of(const ImportSettings& settings,
                                      const std::string& columns) const;
  ArchiveMoment full_moment(const ImportSettings& settings, const std::string& columns) const;
  void ask_for_the_bed(const ImportSettings& settings, const std::vector<bool>& resting,
                       Questions& questions) const;

  void ask_for_the_cell(const ImportSettings& settings, Questions& questions) const;
  Question question_of_cell(const ImportSettings& settings, int axis) const;

  Moments moments_;
  std::shared_ptr<const Roster> roster_;
};

/// Opens an archive, of which the command line may name files only. Where its facts cannot be found
/// from the grains of the first moment, and other moments have others, with a roster.
OpenedArchive open_with_grains(const ImportSettings& settings);
/// Opens an archive with a roster.
OpenedArchive open_with_roster(const ImportSettings& settings);

}  // namespace grseg
