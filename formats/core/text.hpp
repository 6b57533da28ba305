// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <string_view>

/// Functions that make text from unknown sources (file names, words and parameters in files) safe
/// to print on a terminal or in one line of a table.
namespace grseg {

/// The text as one line, with \xNN for each byte that is not part of a printable UTF-8 character:
/// control characters (also newline, tab and U+0080 to U+009F) and invalid UTF-8.
std::string printable(std::string_view text);

/// The text with each line made printable; line ends remain.
std::string printable_lines(std::string_view text);

/// First 60 bytes of a word, made printable, with "..." if it is longer; for quotes in messages.
std::string excerpt(std::string_view text);

/// Three bytes that some programs write before UTF-8 text.
inline constexpr std::string_view byte_order_mark = "\xef\xbb\xbf";

/// The text with & < > " escaped for XML, between tags or in quotes.
std::string xml_escaped(const std::string& text);

/// Number from decimal text as grseg writes it ("-1.5e-07", "nan", "inf", "-inf"). Empty for any
/// other text: blanks, a comma, hexadecimal digits, or a number outside the range of double.
std::optional<double> parse_number(std::string_view text);

}  // namespace grseg
