// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/import/dump/dump_reader.hpp"

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

  /// Advances to the next step that both have; false at the end. Then the rows can be read.
  bool next();
  DumpReader& grains() { return grains_; }
  DumpReader& contacts() { return contacts_; }
  /// Null where there are no files of contacts with walls.
  DumpReader* walls() { return walls_ ? &*walls_ : nullptr; }

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
  bool walls_have(std::int64_t step);

  DumpReader grains_, contacts_;
  std::optional<DumpReader> walls_;
  bool more_walls_ = false, walls_begun_ = false;
  Unmatched grains_alone_, contacts_alone_, without_walls_;
  std::optional<double> step_;
};

}  // namespace grseg
