// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/import/common/archive.hpp"
#include "formats/import/dump/dump_reader.hpp"

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace grseg {

/// Reads a dump in one file or many, in order of their first steps. If several processors wrote the
/// blocks of a step to separate files, joins these blocks.
class JoinedDumps {
 public:
  explicit JoinedDumps(const std::vector<std::string>& files);

  /// Advances to the next step; false at the end. Throws the errors of DumpReader, and FormatError
  /// naming the parts if they have different steps or columns.
  bool next();
  /// The header of the first part; `rows` is the sum over all parts that have a header.
  const DumpHeader& header() const { return header_; }
  const std::optional<std::string>& units() const { return parts_.front().units(); }
  /// Reads the rows of all parts in sequence, like DumpReader::read_rows().
  void read_rows(std::span<const std::size_t> wanted, std::vector<std::vector<double>>& values,
                 const TypeColumn& types = {});

 private:
  std::vector<DumpReader> parts_;
  /// Maps a file with a header to the files with further rows of its step. For `dump local` LAMMPS
  /// writes the header only in the file of the first processor.
  std::map<std::string, std::vector<std::string>> more_rows_;
  DumpHeader header_;
};

/// Reads a dump block by block, and counts the jobs that wrote it.
struct DumpOfJobs {
  explicit DumpOfJobs(const std::vector<std::string>& names) : files(names), dump(names) {}
  /// Advances to the next block; false at the end.
  bool next();
  /// True if the step is not later than the previous one: a job began from an earlier checkpoint.
  bool begins_job = false;

  std::vector<std::string> files;
  JoinedDumps dump;
  std::pair<int, std::int64_t> at{0, 0};  // number of the job, from 0, and step of the block
  bool waits = false;                     // true: the next pair uses this block again
};

/// Reads the dumps of grains and of contacts, and matches their blocks by time step, and by job if
/// all dumps have the same number of jobs. Blocks without a match are skipped.
class DumpPair {
 public:
  /// `wall_files` are dumps of contacts with walls, which every step then needs; may be empty.
  DumpPair(const std::vector<std::string>& grain_files,
           const std::vector<std::string>& contact_files,
           const std::vector<std::string>& wall_files = {});

  /// Advances to the next step that all dumps have; false at the end. Then the rows can be read.
  /// Throws FormatError with their first steps if they have no step in common.
  bool next();
  /// False if this pair has the grains of the previous pair, because its contacts were incomplete.
  bool grains_are_new() const { return grains_are_new_; }
  /// Call this if the block of the other dump is incomplete: the next pair uses this block again.
  void keep_contacts() { contacts_.waits = true; }
  void keep_grains() { grains_.waits = true; }
  JoinedDumps& grains() { return grains_.dump; }
  JoinedDumps& contacts() { return contacts_.dump; }
  /// The dump of contacts with walls; null if there is none.
  JoinedDumps* walls() { return walls_ ? &walls_->dump : nullptr; }

  /// Length of a time step, from ITEM: TIME of the grains' first two blocks; empty if they lack it.
  const std::optional<double>& step() const { return step_; }
  /// The units by ITEM: UNITS of either dump. Throws FormatError if they differ.
  std::optional<std::string> units() const;
  /// One sentence for each dump with steps that another dump lacks.
  std::vector<std::string> remarks() const;

 private:
  bool walls_have_it();
  bool advance(DumpOfJobs& dump);

  DumpOfJobs grains_, contacts_;
  std::optional<DumpOfJobs> walls_;
  bool more_walls_ = false, walls_begun_ = false;
  bool any_ = false;  // true: all dumps have had a common step
  bool grains_are_new_ = true;
  std::optional<bool> by_jobs_;  // true: blocks are matched by job; set when the first job ends
  Matching matching_;
  Unmatched without_walls_;
  std::optional<double> step_;
};

}  // namespace grseg
