// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/import/common/archive.hpp"
#include "formats/import/common/text_source.hpp"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace grseg {

/// The lines of a .restart of MercuryDPM: words, each followed by its values, or values alone.
class MercuryLines {
 public:
  explicit MercuryLines(const std::string& path) : source_({path}) {}

  /// False at the end of the file.
  bool next();
  /// The next line; TruncatedArchive where the file ends before or inside it, `where` being "in its
  /// particles".
  void need_next(const std::string& where);

  bool has(std::string_view key) const { return place_of(key) < words_.size(); }
  /// The first word; empty in an empty line.
  std::string_view kind() const { return words_.empty() ? std::string_view() : words_[0]; }
  const std::vector<std::string_view>& words() const { return words_; }
  /// The `place`-th value behind a word of the line.
  double value(std::string_view key, std::size_t place = 0) const;
  Vec3 vector(std::string_view key) const { return {value(key), value(key, 1), value(key, 2)}; }
  std::int64_t whole_number(std::string_view key, std::size_t place = 0) const;
  /// Where the line is "key count".
  std::optional<std::size_t> count(std::string_view key) const;
  /// The words from the `first`-th on as numbers.
  std::vector<double> numbers(std::size_t first) const;

  [[noreturn]] void fail(const std::string& why) const;

 private:
  std::size_t place_of(std::string_view key) const;
  double number(std::size_t place, std::string_view behind) const;

  TextSource source_;
  std::vector<std::string_view> words_;
};

}  // namespace grseg
