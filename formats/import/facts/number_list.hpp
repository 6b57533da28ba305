// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace grseg {

/// Numbers and ranges such as "1,4-9", or "none".
class NumberList {
 public:
  /// UsageError naming `option` where the text is not such a list.
  NumberList(const std::string& text, const std::string& option);
  bool contains(std::int64_t number) const;

 private:
  std::vector<std::pair<std::int64_t, std::int64_t>> ranges_;  // first and last
};

}  // namespace grseg
