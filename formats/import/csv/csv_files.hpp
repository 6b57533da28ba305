// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace grseg {

/// One file of a table, and the moment that its name states: what stands for `*` is a time if it is
/// a number with a decimal point, and otherwise ends in the digits of a step.
struct CsvFile {
  std::string path;
  std::optional<double> time;
  std::optional<std::int64_t> step;
};

/// The files that `names` stand for (file_list.hpp), in natural order. In names without `*` (which a
/// shell may have replaced) the digits are the last ones before the ending.
std::vector<CsvFile> csv_files(const std::vector<std::string>& names, const std::string& option);

}  // namespace grseg
