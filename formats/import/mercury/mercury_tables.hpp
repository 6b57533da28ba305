// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/import/common/archive.hpp"
#include "formats/import/common/text_source.hpp"
#include "formats/import/mercury/mercury_restart.hpp"

#include <optional>
#include <string>
#include <vector>

/// Readers of the two tables of a MercuryDPM run, .data and .fstat, and of .restart files.
namespace grseg {

/// Source of the grains of a MercuryDPM run, frame by frame in order of time.
class MercuryGrains {
 public:
  virtual ~MercuryGrains() = default;
  /// Reads the next frame without its contacts; false at the end.
  virtual bool next(ArchiveFrame& frame) = 0;
  /// The .restart (of the current frame, if there are many), with the periodic directions; or null.
  virtual const MercuryRestart* restart() const = 0;
};

/// Reads blocks of .data, with or without a .restart. The number of columns shows the format
/// (DPMBase::outputXBallsData, readNextDataFile); N is the number of grains:
///   format 8 (2D)  N t xmin ymin xmax ymax;            x y vx vy radius angle -omega info
///   format 7       N t xmin ymin zmin xmax ymax zmax;  x z y vx vz vy radius info
///   format 14      header of format 7;  x y z vx vy vz radius alpha beta gamma wx wy wz info
///   format 15      format 14 with one more number before info
/// In formats 8, 14 and 15 parallel builds append two flags to each row. The column info is the
/// species by default, but a program may redefine it.
///
/// The id of a grain is the number of its row, from 0. MercuryDPM appends a row for an inserted
/// grain, but moves the last row to the place of a removed grain, so rows no longer identify
/// grains. Throws FormatError if such a removal is visible, and, naming the line, if a block has
/// none of these formats; TruncatedArchive if the file ends inside a block.
class MercuryData : public MercuryGrains {
 public:
  MercuryData(std::vector<std::string> files, std::string restart_path, bool info_is_species);
  bool next(ArchiveFrame& frame) override;
  const MercuryRestart* restart() const override { return restart_ ? &*restart_ : nullptr; }

 private:
  void read_row(ArchiveGrains& grains);
  void require_rows_that_name_grains(const ArchiveFrame& frame) const;
  void add_restart_facts(const std::string& place, ArchiveGrains& grains) const;

  TextSource source_;
  bool plane_ = false;  // true: a run in a plane, whose header has six numbers
  std::vector<double> numbers_;
  std::string restart_path_;
  std::optional<MercuryRestart> restart_;
  bool info_is_species_;
  std::vector<double> last_radius_;
};

/// Reads a series of .restart files, each of which is a frame. Versions 3 and 2 lack forces on
/// grains. Ids are unchanged; MercuryDPM never uses an id twice.
class MercuryRestarts : public MercuryGrains {
 public:
  explicit MercuryRestarts(std::vector<std::string> files);
  bool next(ArchiveFrame& frame) override;
  const MercuryRestart* restart() const override { return &restart_; }

 private:
  std::vector<std::string> files_;
  std::size_t at_ = 0;  // number of files read so far
  MercuryRestart restart_;
};

/// A row of .fstat (BaseInteraction::writeToFStat).
struct MercuryContact {
  std::int64_t i, j;  // grains as rows of .data; j < 0: wall -j-1
  double overlap, normal_force, tangential_force;
  Vec3 normal, tangent;
  std::size_t line;  // number of the line in its block, from 1
};

/// Reads blocks of .fstat: three lines of comments, the first with the time, then a row per contact
///   t i j cx cy cz delta delta_t fn ft nx ny nz tx ty tz
class MercuryFStat {
 public:
  explicit MercuryFStat(std::vector<std::string> files) : source_(std::move(files)) {}
  /// Reads the next block; false at the end.
  bool next();

  double time = 0;
  std::vector<MercuryContact> contacts;  // rows of the block, unchanged
  std::string place;

 private:
  bool next_line();
  void read_header();

  TextSource source_;
  bool waiting_ = false;  // true: the current line begins the next block
  std::vector<double> numbers_;
};

}  // namespace grseg
