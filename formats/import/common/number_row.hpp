// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/import/common/text_source.hpp"

#include <string_view>
#include <vector>

namespace grseg {

/// A finite number as C or Fortran writes it: 1e-5, +.5, 1.0D-05, 1.0-105; one too small to be held is 0.
/// False for other words.
bool read_number(std::string_view word, double& number);

/// The numbers of the current line of `source`, separated by blanks or by `separator`. FormatError
/// naming the line and the first word that is not a finite number.
void read_numbers(const TextSource& source, std::vector<double>& numbers, char separator = ' ');

}  // namespace grseg
