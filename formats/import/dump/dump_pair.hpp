// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/import/dump/joined_dumps.hpp"

#include <optional>
#include <string>
#include <vector>

namespace grseg {

/// The dumps of grains and of contacts, matched by time step; other blocks of either are skipped.
class DumpPair {
 public:
  /// `wall_files` of contacts with walls, which then every step needs, too; may be empty.
  DumpPair(const std::vector<std::string>& grain_files,
           const std::vector<std::string>& contact_files,
           const std::vector<std::string>& wall_files = {});

  /// Advances to the next step that both have; false at the end. Then the rows can be read. FormatError
  /// with their first steps where there is no such step at all.
  bool next();
  JoinedDumps& grains() { return grains_; }
  JoinedDumps& contacts() { return contacts_; }
  /// Null where there are no files of contacts with walls.
  JoinedDumps* walls() { return walls_ ? &*walls_ : nullptr; }

  /// The length of a step from ITEM: TIME of the first blocks of the grains, if they have it.
  const std::optional<double>& step() const { return step_; }
  /// From ITEM: UNITS of either dump. FormatError where they differ.
  std::optional<std::string> units() const;
  /// One sentence for each dump with steps that the other lacks.
  std::vector<std::string> remarks() const;

 private:
  struct Unmatched {
    std::size_t count = 0;
    std::int64_t first = 0;
    void add(std::int64_t step)
    {
      if (count++ == 0) first = step;
    }
  };
  bool next_pair();
  void require_no_steps();
  bool walls_have(std::int64_t step);

  JoinedDumps grains_, contacts_;
  std::optional<JoinedDumps> walls_;
  bool more_walls_ = false, walls_begun_ = false;
  std::vector<std::int64_t> grain_steps_, contact_steps_;  // the first three
  bool any_ = false;                                       // step that all have
  Unmatched grains_alone_, contacts_alone_, without_walls_;
  std::optional<double> step_;
};

}  // namespace grseg
