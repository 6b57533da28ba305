// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/core/frame.hpp"
#include "formats/import/common/text_values.hpp"

#include <fmt/format.h>

#include <map>

namespace grseg {

/// The numbers of some lines of a text of LMGC90, by their keys. A key has 5 characters, its number
/// 14 (Fortran's D14.7): "X(1)= 0.1000000D-02  X(2)=-0.2000000D-02".
struct Lmgc90Fields : std::map<std::string, double, std::less<>> {
  void read(std::string_view line)
  {
    constexpr std::size_t key = 5, width = 14;
    for (std::size_t at = 0; at + key < line.size(); ++at) {
      if (line[at] == ' ' || (at > 0 && line[at - 1] != ' ')) continue;
      const auto words = words_of(line.substr(at + key, width));
      double number = 0;
      if (words.size() != 1 || !read_number(words[0], number)) continue;
      insert_or_assign(std::string(line.substr(at, key)), number);
      at += key + words[0].size();
    }
  }

  /// Throws FormatError with the place in `text` if the key is missing.
  double number(std::string_view key, const TextSource& text) const
  {
    const auto found = find(key);
    if (found == end())
      text.fail(fmt::format("'{}' and its number are missing before this line", key));
    return found->second;
  }
  /// The numbers of `count` keys, such as X(1)=, X(2)=, X(3)= of X({})=; the others are 0.
  Vec3 vector(const char* keys, int first, int count, const TextSource& text) const
  {
    Vec3 v = Vec3::Zero();
    for (int k = 0; k < count; ++k) v[k] = number(fmt::format(fmt::runtime(keys), first + k), text);
    return v;
  }
};

}  // namespace grseg
