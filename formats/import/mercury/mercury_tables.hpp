// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/import/common/archive.hpp"
#include "formats/import/common/text_source.hpp"
#include "formats/import/mercury/mercury_restart.hpp"

#include <optional>
#include <string>
#include <vector>

/// The two tables of a MercuryDPM run, block by block.
namespace grseg {

/// Where the grains of a MercuryDPM run come from, moment by moment in order of time.
class MercuryGrains {
 public:
  virtual ~MercuryGrains() = default;
  /// Fills all of the next moment but its contacts; false at the end.
  virtual bool next(ArchiveMoment& moment) = 0;
  /// The .restart that says what is periodic; the one of the moment at hand where there are many.
  virtual const MercuryRestart* restart() const = 0;
};

/// Blocks of .data, beside one .restart or none, by the number of columns (DPMBase::outputXBallsData,
/// readNextDataFile):
///   format 8 (2D)  N t xmin ymin xmax ymax;            x y vx vy radius angle -omega info
///   format 7       N t xmin ymin zmin xmax ymax zmax;  x z y vx vz vy radius info
///   format 14      the same header;  x y z vx vy vz radius alpha beta gamma wx wy wz info
///   format 15      the same with one more number before info
/// and formats 8, 14 and 15 also with the two flags that parallel builds append to each row. info is
/// the species by default, but a program may redefine it.
///
/// Grain g is row g, and g its id: a program that inserts grains appends rows, but one that removes a
/// grain moves the last row to its place, so that rows name no grain any more: this is refused where it
/// shows. FormatError naming the line where a block has none of these formats, TruncatedArchive where
/// the file ends inside a block.
class MercuryData : public MercuryGrains {
 public:
  MercuryData(std::vector<std::string> files, std::string restart_path, bool info_is_species);
  bool next(ArchiveMoment& moment) override;
  const MercuryRestart* restart() const override { return restart_ ? &*restart_ : nullptr; }

 private:
  void read_row(ArchiveGrains& grains);
  void require_rows_that_name_grains(const ArchiveMoment& moment) const;
  void add_restart_facts(const std::string& place, ArchiveGrains& grains) const;

  TextSource source_;
  bool plane_ = false;  // six numbers in the header
  std::vector<double> numbers_;
  std::string restart_path_;
  std::optional<MercuryRestart> restart_;
  bool info_is_species_;
  std::vector<double> last_radius_;
};

/// A series of .restart files, each a moment with everything but, in versions 3 and 2, forces on
/// grains. Ids are the program's, which it never uses twice.
class MercuryRestarts : public MercuryGrains {
 public:
  explicit MercuryRestarts(std::vector<std::string> files);
  bool next(ArchiveMoment& moment) override;
  const MercuryRestart* restart() const override { return &restart_; }

 private:
  std::vector<std::string> files_;
  std::size_t at_ = 0;  // files handed out
  MercuryRestart restart_;
};

/// A row of .fstat (BaseInteraction::writeToFStat).
struct MercuryContact {
  std::int64_t i, j;  // rows of .data; j < 0: wall -j-1
  double overlap, normal_force, tangential_force;
  Vec3 normal, tangent;
  std::size_t line;  // within its block, from 1
};

/// Blocks of .fstat: three lines of comments, the first with the time, then a row per contact
///   t i j cx cy cz delta delta_t fn ft nx ny nz tx ty tz
class MercuryFStat {
 public:
  explicit MercuryFStat(std::vector<std::string> files) : source_(std::move(files)) {}
  /// Reads the next block; false at the end.
  bool next();

  double time = 0;
  std::vector<MercuryContact> contacts;  // as they stand there
  std::string place;

 private:
  bool next_line();
  void read_header();

  TextSource source_;
  bool waiting_ = false;  // the line at hand begins the next block
  std::vector<double> numbers_;
};

}  // namespace grseg
