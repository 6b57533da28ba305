// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <string_view>

/// Text from unknown writers (names of files, words and parameters inside them), made fit for a
/// terminal or for a line of a table.
namespace grseg {

/// The text with bytes as \xNN where they are no printable character of UTF-8: control characters
/// (also newline, tab and U+0080 to U+009F) and anything that is not UTF-8. It is then one line.
std::string printable(std::string_view text);

/// Each line of the text made printable; line ends remain.
std::string printable_lines(std::string_view text);

/// Beginning of a word, made printable, with "..." where it goes on; for messages that quote it.
std::string excerpt(std::string_view text);

/// Three bytes that some programs put before text in UTF-8.
inline constexpr std::string_view byte_order_mark = "\xef\xbb\xbf";

/// The text as it stands in XML, between tags or quotes.
std::string xml_escaped(const std::string& text);

/// A decimal number as grseg writes it ("-1.5e-07", "nan", "inf", "-inf"); nothing where the text
/// is anything else: blanks, a comma, hexadecimal digits, more than a double can hold.
std::optional<double> parse_number(std::string_view text);

}  // namespace grseg
