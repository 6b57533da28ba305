// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/import/common/archive.hpp"
#include "formats/import/facts/number_list.hpp"

#include <string>
#include <vector>

namespace grseg {

/// Types of grains as an option lists them: numbers and ranges (number_list.hpp) or, where the archive
/// has words for them, these words, separated by commas; or "none".
class TypeList {
 public:
  /// UsageError naming `option` where the text is not such a list, or where no grain has the word.
  TypeList(const std::string& text, const std::string& option, const ArchiveGrains& grains);
  bool contains(std::int32_t type) const;

 private:
  NumberList numbers_;
  std::vector<bool> named_;  // by type
};

}  // namespace grseg
