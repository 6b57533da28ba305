// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/import/dump/dump_parts.hpp"
#include "formats/import/dump/dump_reader.hpp"

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace grseg {

/// Dumps in one file or many, in order of their first steps. Blocks of a step that several processors
/// wrote to files of their own (dump_parts.hpp) are joined.
class JoinedDumps {
 public:
  explicit JoinedDumps(const std::vector<std::string>& files);

  /// Advances to the next step; false at the end. What DumpReader throws, and FormatError naming the
  /// parts where they hold different steps or columns.
  bool next();
  /// Of the first part, with the rows of all that have a header.
  const DumpHeader& header() const { return header_; }
  const std::optional<std::string>& units() const { return parts_.front().units(); }
  /// The rows of all parts, one after the other, as DumpReader reads them.
  void read_rows(std::span<const std::size_t> wanted, std::vector<std::vector<double>>& values,
                 const TypeColumn& types = {});

 private:
  std::vector<DumpReader> parts_;
  std::map<std::string, std::vector<std::string>> more_rows_;  // as of DumpParts
  DumpHeader header_;
};

}  // namespace grseg
