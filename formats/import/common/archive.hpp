// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/core/errors.hpp"
#include "formats/core/frame.hpp"
#include "formats/import/common/archive_files.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

namespace grseg {

/// Something that an import needs and neither the archive nor the command line says.
struct Question {
  std::string what;    // "the length of a time step"
  std::string option;  // "--boundary 3" where the files suggest a value, "--step DT" where they do
                       // not: what is in capitals is for the user to fill in
  std::string reason;  // for the value, or what may be given: "all 35 grains of type 3 are at rest"
};

/// The import cannot go on without answers to these questions. The sentence asks them all.
struct OpenQuestions : UsageError {
  explicit OpenQuestions(std::vector<Question> open);
  explicit OpenQuestions(const Question& open) : OpenQuestions(std::vector<Question>{open}) {}

  /// The options that answer them, in the order of the questions.
  std::string options() const;

  std::vector<Question> questions;
};

/// Collects questions, so that all are asked in one answer.
class Questions {
 public:
  void ask(Question question) { open_.push_back(std::move(question)); }
  /// Runs `answer` and keeps the questions that it throws, each once.
  template <class Function>
  void collect(Function&& answer)
  {
    try {
      answer();
    } catch (const OpenQuestions& open) {
      for (const auto& question : open.questions) {
        const auto is_same = [&](const Question& asked) { return asked.what == question.what; };
        if (std::none_of(open_.begin(), open_.end(), is_same)) ask(question);
      }
    }
  }
  bool any() const { return !open_.empty(); }
  void report() const
  {
    if (any()) throw OpenQuestions(open_);
  }

 private:
  std::vector<Question> open_;
};

/// Runs made with other programs, as their archives hold them: three components, the archive's own
/// axes, ids, order of rows and units. All that follows (turning axes, assigning species, computing
/// branches, verifying balances, writing the trajectory) is the same for every format and not part
/// of its reader.

/// The grains of one moment, in any order; entry g of each array is grain g. Arrays that the
/// archive does not fill stay empty, `id` and `position` are never empty.
struct ArchiveGrains {
  std::vector<std::int64_t> id;
  std::vector<std::int32_t> type;  // the archive's own number of a species
  std::vector<std::string>
      type_names;  // where it has words instead: type k is called type_names[k]
  std::vector<double> radius, mass;
  std::vector<Vec3> position;                      // of the centre; may lie outside a periodic cell
  std::vector<std::array<std::int32_t, 3>> image;  // periods to add to `position`
  std::vector<Vec3> velocity;
  std::vector<Vec3> angular_velocity;  // rad/s, right-handed about the archive's axes
  std::vector<Vec3> force;             // total force on the grain, gravity included
  std::vector<std::uint8_t> fixed;     // 1: the archive marks it as held in place
  std::vector<std::string> missing;    // components of vectors above that the archive lacks, by the
                                       // names of its columns; they are 0 here
  bool unwrapped = false;              // `position` counts the periods that grains have crossed

  std::size_t size() const { return id.size(); }
  /// True where the archive tells how often grains have crossed its periods.
  bool counts_periods() const { return unwrapped || !image.empty(); }
  /// The type as the archive writes it.
  std::string type_word(std::int32_t number) const
  {
    return type_names.empty() ? std::to_string(number)
                              : type_names.at(static_cast<std::size_t>(number));
  }
};

/// The rows of grains by their ids.
std::unordered_map<std::int64_t, std::size_t> rows_by_id(const ArchiveGrains& grains);

/// The contacts of one moment, each once, in any order.
struct ArchiveContacts {
  std::vector<std::int64_t> i, j;  // ids of grains; j is not used at a wall
  std::vector<std::int32_t> wall;  // -1: j is a grain; otherwise the number of a straight wall;
                                   // empty: no contact is one with a wall
  std::vector<Vec3> force;         // ON i FROM j
  std::vector<double> overlap;     // positive where the two overlap; NaN: from the branch
  std::vector<double> distance;    // of the centres; where both are empty it follows from positions
  std::vector<Vec3>
      branch;  // x_i - x_j, at a wall x_i - contact point; empty, or NaN for a contact
               // with a grain: from positions
  std::vector<std::string> missing;  // components, as of grains

  std::size_t size() const { return i.size(); }
  /// Adds one, in an archive that states overlaps and branches.
  void add(std::int64_t first, std::int64_t second, std::int32_t number_of_wall,
           const Vec3& on_first, const Vec3& between, double depth)
  {
    i.push_back(first);
    j.push_back(second);
    wall.push_back(number_of_wall);
    force.push_back(on_first);
    branch.push_back(between);
    overlap.push_back(depth);
  }
  bool at_wall(std::size_t c) const { return !wall.empty() && wall[c] >= 0; }
};

/// Where the cell along an axis comes from.
enum class CellSource : std::uint8_t {
  archive,  // it states it
  told,     // --cell
  grains    // their extent at this moment: the archive states none, or one that follows them
};

/// One moment of an archive: grains and contacts of the same time. At least one of step and time is
/// set; the other follows from the length of a step, which the archive or the command line gives.
struct ArchiveMoment {
  std::optional<std::int64_t> step;
  std::optional<double> time;
  Vec3 low = Vec3::Zero(), high = Vec3::Zero();  // of the cell
  std::array<bool, 3> periodic{};
  std::array<CellSource, 3> cell{};
  ArchiveGrains grains;
  ArchiveContacts contacts;
  std::string place;                // "atoms.dump, line 12": for sentences about this moment
  std::vector<Question> questions;  // what the reader has to be told; what it could not read for
                                    // lack of an answer is empty

  /// The shortest of the vectors that differ from this one by periods of the cell.
  Vec3 minimum_image(Vec3 between) const;
};

/// Sets the cell of a moment to one that encloses its grains along the axes that are not periodic.
/// For archives that state no cell; there must be grains.
void enclose_grains(ArchiveMoment& moment);

/// Moments that one of the tables of an archive has and another lacks: times or steps.
struct Unmatched {
  std::size_t count = 0;
  std::vector<double> first;  // three at most

  void add(double moment);
};

/// Matches the tables of grains and of contacts of an archive, each in order of time, by moment.
class Matching {
 public:
  struct Table {
    std::function<bool()> next;   // advances to its next moment; false at the end
    std::function<double()> now;  // the time or the step of this moment
  };
  /// Advances both to the next moment that both have; false at the end. `order` is negative where the
  /// grains are at an earlier moment, 0 where both are at one. Then the rest of a longer table is read
  /// if `to_the_end`, for remarks(). FormatError where both have moments, but none in common.
  bool next(const Table& grains, const Table& contacts, const std::function<int()>& order,
            bool to_the_end = false);
  /// A sentence for each table with moments that are left out; `unit` is "step" or "t =".
  std::vector<std::string> remarks(const char* unit) const;

 private:
  Unmatched grains_alone_, contacts_alone_;
  bool any_of_both_ = false;
};

/// "12 moments have grains but no contacts and are left out, ..."; nothing where there are none.
void add_remark(std::vector<std::string>& remarks, const Unmatched& alone, const char* what,
                const char* without, const char* unit);

/// Facts that an archive states once about its run. A fact that it does not state stays empty and
/// must come from the command line; nothing is guessed.
struct ArchiveFacts {
  std::optional<double> step;     // of the integration, in units of time
  std::optional<double> density;  // of the grains' matter, per area (discs) or volume (spheres)
  std::optional<Vec3> gravity;
  std::optional<bool> discs;         // false: spheres
  std::vector<std::string> walls;    // names of those whose contacts it has
  std::optional<std::string> units;  // the program's name for them: "si", "cgs", "lj"
  /// The archive's contact forces were evaluated with velocities half a step later than the
  /// velocities that moved the grains (imbalance.hpp).
  bool forces_are_late = false;
  /// Every pair that overlaps has a row, as soft grains have. Contact dynamics may list only the
  /// pairs that bear a force.
  bool lists_all = true;
  /// Largest residual of a grain's balance that correct output of this program can have, relative
  /// to the largest force of the moment and after subtraction of late damping; and why (digits of
  /// its text, float32).
  double tolerance = 0;
  std::string tolerance_reason;
};

/// A value of --columns, and to what part of the contact forces the forces on grains then add up.
struct ColumnFit {
  std::string columns;
  double residual;
};

/// Reads an archive moment by moment, in order of time, holding one moment in memory.
class Archive {
 public:
  virtual ~Archive() = default;
  /// Complete after the first `next`.
  virtual const ArchiveFacts& facts() const = 0;
  /// Fills in the next moment that has both grains and contacts; false at the end.
  /// FormatError naming file, line and remedy where the archive is damaged.
  virtual bool next(ArchiveMoment& moment) = 0;
  /// Like `next`, but the contacts need not be read: faster where the format lets them be skipped.
  virtual bool next_grains(ArchiveMoment& moment) { return next(moment); }

  /// How the columns of the contacts are read, as --columns would give it; "" where the format
  /// fixes it.
  virtual std::string columns() const { return ""; }
  /// The value of --columns with which the forces on grains add up best, under this gravity (in the
  /// archive's axes), if it is known. Nothing where they add up with `columns()`, or with no other
  /// value. Valid after `next`.
  virtual std::optional<ColumnFit> fitting_columns(const std::optional<Vec3>& /*gravity*/) const
  {
    return std::nullopt;
  }
  /// Sentences about everything left out so far: unmatched moments, rows.
  virtual std::vector<std::string> remarks() const { return {}; }
};

/// The archive ends in the middle of a moment, or a job did, behind whose last moment the next job
/// goes on; all moments before are complete. With --drop-incomplete this one is left out.
struct TruncatedArchive : FormatError {
  using FormatError::FormatError;
  TruncatedArchive(const std::string& sentence, bool more) : FormatError(sentence), goes_on(more) {}
  bool goes_on = false;  // `next`, given the same moment, reads the one behind it
};

/// Files and columns as the command line gives them to a reader.
struct ArchiveFiles {
  std::vector<std::string> grains, contacts;  // may hold `*`; archive_files.hpp
  std::string restart;                        // with what the other files lack
  std::string columns;                        // contact_columns.hpp
  std::vector<std::string> wall_contacts;     // files, likewise
  std::string wall_columns;                   // of the contacts with walls
  std::vector<std::string> unnamed;           // named without an option: scan.hpp
  std::vector<std::string> map;               // other names of columns; csv_map.hpp
};

/// All that is known of a format outside its own folder.
struct ArchiveFormat {
  const char* name;  // as --format gives it
  std::unique_ptr<Archive> (*open)(const ArchiveFiles&);
  /// The role of a file with this beginning; FileRole::none where it does not look like this
  /// format.
  FileRole (*role)(const FileStart&);
  /// True for a file of this program rather than of another one that writes such files, too; null
  /// where there is no other. Asked where --format does not say.
  bool (*is_of_program)(const FileStart&) = nullptr;
  /// Which of these options apply to it; the others are refused.
  bool takes_contacts = true, takes_columns = true, takes_restart = false, takes_map = false,
       takes_wall_contacts = false, takes_wall_columns = false;
  const char* examples;    // for --help: whole command lines, indented
  const char* notes = "";  // for --help: what its files and its --columns are, indented; may be ""
};

/// Each stands in the folder of its program.
extern const ArchiveFormat lammps_format, liggghts_format, mercury_format, siconos_format,
    csv_format;

/// The known formats, in the order in which --help names them.
std::span<const ArchiveFormat* const> archive_formats();
std::vector<std::string> names_of_formats();

/// UsageError where there is no such format.
const ArchiveFormat& format_of(const std::string& name);

/// UsageError where `format` is unknown, an option does not apply to it or a file is missing,
/// FormatError where a file is damaged.
std::unique_ptr<Archive> open_archive(const std::string& format, const ArchiveFiles& files);

}  // namespace grseg
