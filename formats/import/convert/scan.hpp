// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/import/common/archive.hpp"
#include "formats/import/convert/archive_frames.hpp"
#include "formats/import/facts/import_settings.hpp"
#include "formats/import/facts/run_facts.hpp"

#include <cstddef>
#include <memory>
#include <string>

namespace grseg {

/// Settings in which each file that was named without an option has a role (grains, contacts, ...),
/// recognised by its content. --format must be known. Throws UsageError if a file's role cannot be
/// recognised.
ImportSettings with_known_files(const ImportSettings& settings);

/// Settings completed from the content of the files: the format, and which files named without an
/// option contain grains or contacts. `questions` asks the user to confirm each of these, and for a
/// missing output. Throws UsageError if a file is missing.
ImportSettings with_proposed_files(const ImportSettings& settings, Questions& questions);

/// List of all grains of an archive in which grains enter and leave.
struct Roster {
  /// An artificial frame with every grain that occurs in the range of the import: its type, radius,
  /// mass and fixed flag, its mean position and its velocity of largest magnitude; no contacts.
  /// Along open directions the cell encloses all grains of all frames. Facts that are otherwise
  /// found from the first frame are found from this one.
  ArchiveFrame all;
  std::size_t fewest = 0, most = 0;  // smallest and largest number of grains in a frame
  std::size_t frames = 0;
  Eigen::AlignedBox3d bed;  // around the grains of all frames

  bool grains_change() const { return fewest < all.grains.size(); }
};

/// Checks that radius, mass, type and fixed flag of a grain are constant, as far as the archive has
/// them. Throws FormatError with `place` and a remedy if grain g of `now` differs from grain `row`
/// of `known`, which has the same id.
void require_same_grain(const ArchiveGrains& known, std::size_t row, const ArchiveGrains& now,
                        std::size_t g, const std::string& place);

/// Error: a frame has other grains than the first one, so all frames have to be scanned.
struct OtherGrains : FormatError {
  using FormatError::FormatError;
};

/// An open archive with the facts of its run. `frame` is the current one, the first one after
/// construction. If grains enter and leave, a roster lists them.
class ScannedArchive {
 public:
  /// Finds the facts from `roster`, or from the first frame if it is null. Throws the errors of
  /// readers and collect_facts(); OpenQuestions with `questions` and all missing facts; FormatError
  /// if there is no frame; OtherGrains if the first frame has no grains and `roster` is null.
  explicit ScannedArchive(const ImportSettings& settings,
                          std::shared_ptr<const Roster> roster = nullptr, Questions questions = {});

  /// Reads the next frame; false at the end. Throws OpenQuestions if the reader needs an answer.
  bool next();
  const Archive& archive() const { return frames_.archive(); }
  /// Sentences about the data left out so far.
  std::vector<std::string> remarks() const;
  /// "; coordinates have 6 digits: ..." if they are too few to know overlaps well, otherwise "".
  std::string about_digits() const { return few_digits_.empty() ? "" : "; " + few_digits_; }
  /// The grains of all frames; null if all frames have the grains of the first one.
  const std::shared_ptr<const Roster>& roster() const { return roster_; }
  /// A frame with all grains of the run: Roster::all, or without a roster the current frame.
  const ArchiveFrame& all_grains() const { return roster_ ? roster_->all : frame; }

  ArchiveFrame frame;
  RunFacts facts;

 private:
  std::vector<bool> resting_grains_of(const ImportSettings& settings) const;
  ArchiveFrame full_frame(const ImportSettings& settings) const;
  void ask_for_the_bed(const ImportSettings& settings, const std::vector<bool>& resting,
                       Questions& questions) const;
  void ask_for_the_cell(const ImportSettings& settings, Questions& questions) const;
  std::optional<Question> question_of_cell(const ImportSettings& settings, int axis) const;

  ArchiveFrames frames_;
  std::shared_ptr<const Roster> roster_;
  std::string few_digits_;  // remark on the digits of coordinates; may be empty
};

/// Number of frames that a scan reads. Reading all of them takes half as long as an import.
enum class Scan { first_frames, all_frames };

/// Opens an archive and finds the facts of its run; the command line may name its files only. All
/// frames are scanned if the grains of the first one do not suffice and other frames have other
/// grains. Throws FormatError naming frame and grain if an id occurs twice in a frame, or if a
/// property of a grain changes (require_same_grain()).
ScannedArchive scan(const ImportSettings& settings, Scan how_far = Scan::first_frames);

/// The grains of all frames in the range of the import.
Roster read_roster(const ImportSettings& settings);

}  // namespace grseg
