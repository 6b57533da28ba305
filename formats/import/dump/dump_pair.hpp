// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/import/dump/dump_reader.hpp"

#include <optional>
#include <string>
#include <vector>

namespace grseg {

/// The dump of the grains beside that of the contacts: blocks of the same time step, whatever else
/// stands in either.
class DumpPair {
 public:
  DumpPair(const std::vector<std::string>& grain_files,
           const std::vector<std::string>& contact_files);

  /// Goes to the next step that both have; false at the end. Rows are then to be read.
  bool next();
  DumpReader& grains() { return grains_; }
  DumpReader& contacts() { return contacts_; }

  /// The length of a step as ITEM: TIME of the grains' first blocks tells it, if it does.
  const std::optional<double>& step() const { return step_; }
  /// Of ITEM: UNITS of either. FormatError where they differ.
  std::optional<std::string> units() const;
  /// One sentence per dump that has steps which the other has not.
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
  DumpReader grains_, contacts_;
  Unmatched grains_alone_, contacts_alone_;
  std::optional<double> step_;
};

}  // namespace grseg
