// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/import/common/text_source.hpp"

#include <string>
#include <vector>

namespace grseg {

/// Takes the numbers of the line that `source` stands at; they are set apart by blanks or, where
/// `separator` is none, by that, too. FormatError naming the line and the word that is no finite
/// number.
void read_numbers(const TextSource& source, std::vector<double>& numbers, char separator = ' ');

}  // namespace grseg
