// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/cli/tool.hpp"

#include <cstddef>
#include <optional>
#include <string>
#include <utility>

namespace grseg {

/// One of several parts of an output, each made by a process of its own.
struct OutputPart {
  std::size_t number = 1, count = 1;  // 1 .. count

  /// "3/16"
  std::string text() const;
  /// Half-open range [first, second) of the things in this part. Parts follow each other, and their
  /// sizes differ by at most one.
  std::pair<std::size_t, std::size_t> range(std::size_t things) const;
  /// File of this part of an output: "sums.part-03-of-16.tsv" for "sums.tsv". `extension` replaces
  /// the ending of `output`.
  std::string path(const std::string& output, const std::string& extension) const;
};

/// Options for making a table in parts. --part K/N makes one part of the output. The same command
/// with --join N makes the output of all parts, with the bytes that one process would have written.
struct PartOptions {
  std::optional<OutputPart> part;
  std::size_t join = 0;  // number of parts; 0: no joining

  /// Adds --part and --join.
  void add_to(po::options_description& options);
  /// UsageError where both are given, or there is no file that parts could be named after.
  void check(const std::string& output) const;
};

}  // namespace grseg
