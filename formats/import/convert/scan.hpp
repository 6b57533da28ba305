// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/import/common/archive.hpp"
#include "formats/import/convert/moments.hpp"
#include "formats/import/facts/import_settings.hpp"
#include "formats/import/facts/run_facts.hpp"

#include <cstddef>
#include <limits>
#include <memory>
#include <string>

namespace grseg {

/// The settings where --format names the program, and files that were named without an option are
/// taken for what they hold. UsageError where one does not show it.
ImportSettings with_known_files(const ImportSettings& settings);

/// The settings with what files by themselves show: the format, and which of the files that were
/// named without an option hold grains and which contacts. All of it is asked for in `questions`, as
/// is a missing output. UsageError where a file is missing.
ImportSettings with_proposed_files(const ImportSettings& settings, Questions& questions);

/// All grains of an archive in which grains come and go.
struct Roster {
  /// A moment that never was, with every grain that ever occurs in the range of the import: its
  /// type, radius, mass and fixed flag, the mean of its positions and the fastest of its velocities.
  /// Where the cell is open it holds all grains of all moments. No contacts. Facts that would
  /// otherwise be found from the first moment are found from this one.
  ArchiveMoment all;
  std::size_t fewest = 0, most = 0;  // grains at a moment
  std::size_t moments = 0;

  bool grains_change() const { return fewest < all.grains.size(); }
};

/// Checks that a grain keeps its radius, mass, type and fixed flag for as long as it has its id, as
/// far as the archive has them. FormatError naming `place`, with a remedy, where grain g of `now`
/// differs from grain `row` of `known`.
void require_same_grain(const ArchiveGrains& known, std::size_t row, const ArchiveGrains& now,
                        std::size_t g, const std::string& place);

/// A moment has other grains than the first one, so that all moments have to be scanned.
struct OtherGrains : FormatError {
  using FormatError::FormatError;
};

/// A scanned archive: the facts of its run, and, where grains come and go, a roster of them; and
/// the archive itself at one of its moments, from the first on.
class ScannedArchive {
 public:
  /// From the grains of the first moments alone, without a roster. Throws what readers and facts
  /// throw; OpenQuestions with `questions` and all that is missing; FormatError where the archive
  /// holds no moment, OtherGrains where it begins without grains and there is no roster.
  explicit ScannedArchive(const ImportSettings& settings,
                          std::shared_ptr<const Roster> roster = nullptr, Questions questions = {});

  /// Reads the next moment; false at the end. OpenQuestions where the reader cannot go on.
  bool next();
  /// Like `next`, without the contacts of the moment.
  bool next_grains() { return moments_.next_grains(moment); }
  const Archive& archive() const { return moments_.archive(); }
  /// Sentences on what is left out so far.
  std::vector<std::string> remarks() const;
  /// The grains of all moments; null where they all have the grains of the first one.
  const std::shared_ptr<const Roster>& roster() const { return roster_; }
  /// A moment with all grains of the run: the roster's, or as long as it has not been left the first.
  const ArchiveMoment& all_grains() const { return roster_ ? roster_->all : moment; }

  ArchiveMoment moment;
  RunFacts facts;

 private:
  std::vector<bool> resting_grains_of(const ImportSettings& settings) const;
  ArchiveMoment full_moment(const ImportSettings& settings) const;
  void ask_for_the_bed(const ImportSettings& settings, const std::vector<bool>& resting,
                       Questions& questions) const;
  void ask_for_the_cell(const ImportSettings& settings, Questions& questions) const;
  Question question_of_cell(const ImportSettings& settings, int axis) const;

  Moments moments_;
  std::shared_ptr<const Roster> roster_;
};

/// How far a scan goes. All moments are read where they are needed: it takes as long as half an import.
enum class Scan { first_moments, all_moments };

/// Scans an archive, of which the command line may name files only. Where its facts cannot be found
/// from the grains of the first moment, and other moments have others, of all moments. FormatError
/// naming moment and grain where an id occurs twice at a moment or changes what a grain keeps.
ScannedArchive scan(const ImportSettings& settings, Scan how_far = Scan::first_moments);

/// The grains of the first moments in the range of the import, `most` at most.
Roster read_roster(const ImportSettings& settings,
                   std::size_t most = std::numeric_limits<std::size_t>::max());

}  // namespace grseg
