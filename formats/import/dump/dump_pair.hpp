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

/// Dumps in one file or many, in order of their first steps. Blocks of a step that several processors
/// wrote to files of their own are joined.
class JoinedDumps {
 public:
  explicit JoinedDumps(const std::vector<std::string>& files);

  /// Advances to the next step; false at the end. What DumpReader throws, and FormatError naming the
  /// parts where they hold different steps or columns.
  bool next();
  /// The header of the first part, with the rows of all parts that have a header.
  const DumpHeader& header() const { return header_; }
  const std::optional<std::string>& units() const { return parts_.front().units(); }
  /// The rows of all parts, one after the other, as DumpReader reads them.
  void read_rows(std::span<const std::size_t> wanted, std::vector<std::vector<double>>& values,
                 const TypeColumn& types = {});

 private:
  std::vector<DumpReader> parts_;
  /// By a file with a header, those with more rows of its step: of `dump local` LAMMPS writes the
  /// header for the first processor alone.
  std::map<std::string, std::vector<std::string>> more_rows_;
  DumpHeader header_;
};

/// A dump block by block.
struct DumpOfJobs {
  explicit DumpOfJobs(const std::vector<std::string>& names) : files(names), dump(names) {}
  /// Advances to the next block; false at the end.
  bool next();
  /// Where a step is not later than the one before: the next job, which began from an earlier checkpoint.
  bool begins_job = false;

  std::vector<std::string> files;
  JoinedDumps dump;
  std::pair<int, std::int64_t> at{0, 0};  // job, from 0, and step of the block; in this order
  bool waits = false;                     // the block belongs to the next pair, too
};

/// The dumps of grains and of contacts, matched by time step, and by job where all dumps have as many;
/// other blocks of either are skipped.
class DumpPair {
 public:
  /// `wall_files` of contacts with walls, which then every step needs, too; may be empty.
  DumpPair(const std::vector<std::string>& grain_files,
           const std::vector<std::string>& contact_files,
           const std::vector<std::string>& wall_files = {});

  /// Advances to the next step that both have; false at the end. Then the rows can be read. FormatError
  /// with their first steps where there is no such step at all.
  bool next();
  /// False where the grains are still the grains of the pair before, whose contacts were
  /// incomplete.
  bool grains_are_new() const { return grains_are_new_; }
  /// Called where the block of one dump is incomplete: the block of the other dump stays for the
  /// next pair.
  void keep_contacts() { contacts_.waits = true; }
  void keep_grains() { grains_.waits = true; }
  JoinedDumps& grains() { return grains_.dump; }
  JoinedDumps& contacts() { return contacts_.dump; }
  /// Null where there are no files of contacts with walls.
  JoinedDumps* walls() { return walls_ ? &walls_->dump : nullptr; }

  /// The length of a step from ITEM: TIME of the first blocks of the grains, if they have it.
  const std::optional<double>& step() const { return step_; }
  /// From ITEM: UNITS of either dump. FormatError where they differ.
  std::optional<std::string> units() const;
  /// One sentence for each dump with steps that the other lacks.
  std::vector<std::string> remarks() const;

 private:
  bool walls_have_it();
  bool advance(DumpOfJobs& dump);

  DumpOfJobs grains_, contacts_;
  std::optional<DumpOfJobs> walls_;
  bool more_walls_ = false, walls_begun_ = false;
  bool any_ = false;  // step that all have
  bool grains_are_new_ = true;
  std::optional<bool> by_jobs_;  // once a job has ended
  Matching matching_;
  Unmatched without_walls_;
  std::optional<double> step_;
};

}  // namespace grseg
