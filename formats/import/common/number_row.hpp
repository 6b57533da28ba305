// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/import/common/text_source.hpp"

#include <string>
#include <vector>

namespace grseg {

/// The numbers of the current line of `source`, separated by blanks or by `separator`. FormatError
/// naming the line and the first word that is not a finite number.
void read_numbers(const TextSource& source, std::vector<double>& numbers, char separator = ' ');

}  // namespace grseg
