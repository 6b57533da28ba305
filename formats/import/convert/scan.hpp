// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/import/common/archive.hpp"
#include "formats/import/convert/moments.hpp"
#include "formats/import/facts/import_settings.hpp"
#include "formats/import/facts/run_facts.hpp"

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

/// Reads the grains of all moments between --begin and --end. FormatError naming moment and grain
/// where an id occurs twice at a moment or changes what a grain keeps (require_same_grain).
Roster read_roster(const ImportSettings& settings);

/// Whether the grains of the first few moments differ.
bool grains_change_early(const ImportSettings& settings);

/// What a grain keeps for as long as it has its id: radius, mass, type, and whether it is fixed, as
/// far as the archive has them. FormatError naming `place`, with what to do, where grain g of `now`
/// is not the same as grain `row` of `known`.
void require_same_grain(const ArchiveGrains& known, std::size_t row, const ArchiveGrains& now,
                        std::size_t g, const std::string& place);

/// A moment has other grains than the first one: the import begins anew, with a roster.
struct OtherGrains : FormatError {
  using FormatError::FormatError;
};

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
