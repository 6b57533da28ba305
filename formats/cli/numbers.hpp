// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string_view>

namespace grseg {

/// A decimal number as grseg writes it ("-1.5e-07", "nan", "inf", "-inf"); nothing where the text
/// is anything else: blanks, a comma, hexadecimal digits, more than a double can hold.
std::optional<double> parse_number(std::string_view text);

}  // namespace grseg
