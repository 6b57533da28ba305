// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/cli/tool.hpp"

#include <cstddef>
#include <optional>
#include <string>
#include <utility>

namespace grseg {

/// One part of an output whose parts are made by separate processes.
struct OutputPart {
  std::size_t number = 1, count = 1;  // number of this part, 1 .. count; number of all parts

  /// Number and count as on the command line: "3/16".
  std::string text() const;
  /// Half-open range [first, second) of the items in this part, if `things` items are divided among
  /// all parts in order. The sizes of the parts differ by at most one.
  std::pair<std::size_t, std::size_t> range(std::size_t things) const;
  /// File name of this part of `output`: "sums.part-03-of-16.tsv" for "sums.tsv" if `extension`,
  /// which replaces the ending of `output`, is ".tsv".
  std::string path(const std::string& output, const std::string& extension) const;
};

/// Options for making a table in parts. --part K/N makes one part of the output. The same command
/// with --join N then joins all parts into the same bytes that a single process would have written.
struct PartOptions {
  std::optional<OutputPart> part;
  std::size_t join = 0;  // number of parts to join; 0: no joining

  /// Adds --part and --join.
  void add_to(po::options_description& options);
  /// Throws UsageError if both options are given, or if `output` is not a file name, from which the
  /// names of the parts derive.
  void check(const std::string& output) const;
};

}  // namespace grseg
