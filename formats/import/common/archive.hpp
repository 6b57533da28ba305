// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/core/errors.hpp"
#include "formats/core/frame.hpp"
#include "formats/import/common/archive_files.hpp"

#include <Eigen/Geometry>
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

/// A fact that an import needs, and that neither the archive nor the command line states.
struct Question {
  std::string what;    // the missing fact: "the length of a time step"
  std::string option;  // option that answers: "--boundary 3" if the files suggest a value; if not,
                       // "--step DT", where the user replaces the word in capitals
  std::string reason;  // reason for the value ("all 35 grains of type 3 are at rest"), or choices
};

/// Error: the import needs answers to these questions. The message lists all of them.
struct OpenQuestions : UsageError {
  explicit OpenQuestions(std::vector<Question> open);
  explicit OpenQuestions(const Question& open) : OpenQuestions(std::vector<Question>{open}) {}

  /// The options that answer the questions, in the order of the questions.
  std::string options() const;

  std::vector<Question> questions;
};

/// Collects questions, so that one error message asks all of them.
class Questions {
 public:
  void ask(Question question) { open_.push_back(std::move(question)); }
  /// Runs `answer` and stores the questions that it throws; repeated questions are stored once.
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

/// Archives are runs of other programs. A reader returns them unchanged: vectors of three
/// components, and the archive's own axes, ids, order of rows and units. The code behind the
/// readers (axes, species, branches, balances, writing) is the same for every format.

/// The grains of one frame of an archive, in any order; entry g of each array is grain g. Arrays
/// that the archive does not fill stay empty; `id` and `position` are never empty.
struct ArchiveGrains {
  std::vector<std::int64_t> id;
  std::vector<std::int32_t> type;  // number that the archive gives to the grain's species
  std::vector<std::string>
      type_names;  // names of the types if the archive has words: type k is type_names[k]
  std::vector<double> radius, mass;
  std::vector<Vec3> position;                      // centre; may lie outside a periodic cell
  std::vector<std::array<std::int32_t, 3>> image;  // number of periods to add to `position`
  std::vector<Vec3> velocity;
  std::vector<Vec3> angular_velocity;  // rad/s, right-handed about the archive's axes
  std::vector<Vec3> force;             // total force on the grain, gravity included
  std::vector<std::uint8_t> fixed;     // 1: the archive marks the grain as immobile
  std::vector<std::string> missing;    // names of columns (components of the vectors above) that
                                       // the archive lacks; these components are 0 here
  bool unwrapped = false;              // true: `position` includes the periods that grains crossed

  std::size_t size() const { return id.size(); }
  /// True if the archive states how often grains have crossed the periodic cell.
  bool counts_periods() const { return unwrapped || !image.empty(); }
  /// The type as the archive writes it.
  std::string type_word(std::int32_t number) const
  {
    return type_names.empty() ? std::to_string(number)
                              : type_names.at(static_cast<std::size_t>(number));
  }
};

/// Map from the id of a grain to its row in the arrays.
std::unordered_map<std::int64_t, std::size_t> rows_by_id(const ArchiveGrains& grains);

/// Text behind a message about an id that ends in zeros as %g writes it, with six digits; else "".
std::string hint_of_digits(std::int64_t id);

/// The contacts of one frame of an archive, each once, in any order.
struct ArchiveContacts {
  std::vector<std::int64_t> i, j;  // ids of the two grains; j is not used at a wall
  std::vector<std::int32_t> wall;  // number of a straight wall, or -1 if j is a grain;
                                   // empty if no grain touches a wall
  std::vector<Vec3> force;         // contact force ON i FROM j
  std::vector<double> overlap;     // depth of overlap, positive; NaN: compute it from the branch
  std::vector<double> distance;    // distance of centres; both empty: it follows from positions
  std::vector<Vec3>
      branch;  // x_i - x_j, at a wall x_i - contact point. Compute it from positions if
               // this array is empty, or NaN for a contact of two grains
  std::vector<std::string> missing;  // names of missing columns, as in ArchiveGrains

  std::size_t size() const { return i.size(); }
  /// Adds a contact, for archives that state overlaps and branches.
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

/// Source of the cell's bounds along an axis.
enum class CellSource : std::uint8_t {
  archive,  // stated by the archive
  told,     // given by --cell
  grains    // extent of the grains in this frame: the archive states no cell, or one fitted to them
};

/// One frame of an archive: grains and contacts at the same time. At least one of step and time is
/// set; the other follows from the length of a time step.
struct ArchiveFrame {
  std::optional<std::int64_t> step;
  std::optional<double> time;
  Vec3 low = Vec3::Zero(), high = Vec3::Zero();  // bounds of the cell
  std::array<bool, 3> periodic{};
  std::array<CellSource, 3> cell{};
  ArchiveGrains grains;
  ArchiveContacts contacts;
  std::string place;                // file and line for messages: "atoms.dump, line 12"
  std::vector<Question> questions;  // questions that this frame raises; arrays that cannot be read
                                    // without an answer are empty

  /// The shortest vector that differs from `between` by whole periods of the cell.
  Vec3 minimum_image(Vec3 between) const;
};

/// Largest number of significant decimal digits with which the components are written, 17 for
/// numbers in binary; 0 if all are 0. The first thousand vectors decide.
int digits_of(const std::vector<Vec3>& values);

/// The box around the grains, with their radii if these are known.
Eigen::AlignedBox3d box_around(const ArchiveGrains& grains);

/// Sets the cell of a frame to the extent of its grains, along the axes that are not periodic. For
/// archives that state no cell; the frame must have grains.
void enclose_grains(ArchiveFrame& frame);

/// Frames that are in one table of an archive and missing in the other, by their times or steps.
struct Unmatched {
  std::size_t count = 0;
  std::vector<std::string> first;  // times or steps of the first of these frames, three at most

  void add(const std::string& when);
};

/// Finds the frames that an archive's tables of grains and of contacts have in common. Both tables
/// must be in order of time.
class Matching {
 public:
  struct Table {
    std::function<bool()> next;        // advances to the table's next frame; false at the end
    std::function<std::string()> now;  // time or step of the current frame, for messages
  };
  /// Advances both tables to their next common frame; false at the end. `order` returns a negative
  /// number if the grains' frame is the earlier one, 0 if it is the same. At the end, `to_the_end`
  /// reads the rest of a longer table for remarks(). Throws FormatError if no frame is in both.
  bool next(const Table& grains, const Table& contacts, const std::function<int()>& order,
            bool to_the_end = false);
  /// A sentence for each table with frames that the other lacks; `unit` is "step" or "t =".
  std::vector<std::string> remarks(const char* unit) const;

 private:
  Unmatched grains_alone_, contacts_alone_;
  bool any_of_both_ = false;
};

/// Adds "12 frames have grains but no contacts and are left out, ..." if `alone` has any frames.
void add_remark(std::vector<std::string>& remarks, const Unmatched& alone, const char* what,
                const char* without, const char* unit);

/// Facts that an archive states once about its run. A fact that it does not state stays empty and
/// must come from the command line; nothing is guessed.
struct ArchiveFacts {
  std::optional<double> step;     // length of an integration step, in the archive's unit of time
  std::optional<double> density;  // density of the grains' material, per area (discs) or volume
  std::optional<Vec3> gravity;
  std::optional<bool> discs;         // true: discs, false: spheres
  std::vector<std::string> walls;    // names of the walls whose contacts the archive contains
  std::optional<std::string> units;  // the program's name of its system of units: "si", "cgs", "lj"
  /// True if the contact forces were evaluated with velocities half a step later than the
  /// velocities that moved the grains ("late damping", imbalance.hpp).
  bool forces_are_late = false;
  /// True if every overlapping pair has a row, as for soft grains. Contact dynamics may list only
  /// the pairs that transmit a force.
  bool lists_all = true;
  /// True if contacts were found at the positions given, while velocities and the time belong to the
  /// end of the step.
  bool at_detection = false;
  /// Largest residual of a grain's force balance that correct output of this program can have,
  /// relative to the largest force, after subtraction of late damping; and its reason (digits of
  /// text, float32).
  double tolerance = 0;
  std::string tolerance_reason;
};

/// A value of --columns, and the residual of the grains' force balances that it gives (relative).
struct ColumnFit {
  std::string columns;
  double residual;
};

/// Reads an archive frame by frame, in order of time, with one frame in memory.
class Archive {
 public:
  virtual ~Archive() = default;
  /// Facts about the run, complete after the first call of `next`.
  virtual const ArchiveFacts& facts() const = 0;
  /// Reads the next frame that has both grains and contacts; false at the end. Throws FormatError
  /// with file, line and remedy if the archive is damaged.
  virtual bool next(ArchiveFrame& frame) = 0;
  /// Reads the grains of the next frame; may skip its contacts, which some formats do faster.
  virtual bool next_grains(ArchiveFrame& frame) { return next(frame); }

  /// Value of --columns by which the contacts are read; "" if the format fixes the columns.
  virtual std::string columns() const { return ""; }
  /// Value of --columns with which the forces on grains balance best, given gravity in the
  /// archive's axes (if known). Empty if they balance with `columns()`, or with no other value.
  /// Valid after `next`.
  virtual std::optional<ColumnFit> fitting_columns(const std::optional<Vec3>& /*gravity*/) const
  {
    return std::nullopt;
  }
  /// Sentences about the data left out so far: frames without contacts or grains, rows.
  virtual std::vector<std::string> remarks() const { return {}; }
};

/// Error: the archive, or one of the jobs that wrote it, ends in the middle of a frame. All earlier
/// frames are complete. With --drop-incomplete the incomplete frame is left out.
struct TruncatedArchive : FormatError {
  using FormatError::FormatError;
  TruncatedArchive(const std::string& sentence, bool more) : FormatError(sentence), goes_on(more) {}
  bool goes_on = false;  // true: another job follows, and `next` reads its first frame
};

/// Files and columns of an archive, as given on the command line.
struct ArchiveFiles {
  std::vector<std::string> grains, contacts;  // names of files, may contain `*`: archive_files.hpp
  std::string restart;                        // file with the facts that the other files lack
  std::string columns;                        // columns of the contacts: contact_columns.hpp
  std::vector<std::string> wall_contacts;     // names of files with contacts at walls
  std::string wall_columns;                   // columns of the files with contacts at walls
  std::vector<std::string> unnamed;           // files given without an option: scan.hpp
  std::vector<std::string> map;               // the user's names of columns: csv_map.hpp
};

/// Description of a format, for the code outside the format's own folder.
struct ArchiveFormat {
  const char* name;  // value of --format
  std::unique_ptr<Archive> (*open)(const ArchiveFiles&);
  /// Returns the role of a file with this beginning, FileRole::none if it does not look like this
  /// format.
  FileRole (*role)(const FileStart&);
  /// Returns true if this program wrote the file, rather than another program with the same format
  /// of files; null if no other program writes such files. Used if --format is not given.
  bool (*is_of_program)(const FileStart&) = nullptr;
  /// Options that apply to the format; the import refuses the others.
  bool takes_contacts = true, takes_columns = true, takes_restart = false, takes_map = false,
       takes_wall_contacts = false, takes_wall_columns = false;
  const char* examples;    // text of --help: whole command lines, indented
  const char* notes = "";  // text of --help: its files and its --columns, indented; may be ""
};

/// The formats, each defined in the folder of its program.
extern const ArchiveFormat lammps_format, liggghts_format, mercury_format, siconos_format,
    lmgc90_format, csv_format;

/// The known formats, in the order of --help.
std::span<const ArchiveFormat* const> archive_formats();
std::vector<std::string> names_of_formats();

/// The format of this name. Throws UsageError if there is none.
const ArchiveFormat& format_of(const std::string& name);

/// Opens an archive. Throws UsageError if `format` is unknown, an option does not apply to it or a
/// file is missing, FormatError if a file is damaged.
std::unique_ptr<Archive> open_archive(const std::string& format, const ArchiveFiles& files);

}  // namespace grseg
