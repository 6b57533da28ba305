// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>

/// Text of which nobody knows who wrote it (names of files, words and parameters inside them), made
/// fit for a terminal or for a line of a table.
namespace grseg {

/// The text with every byte as \xNN that is not a printable character of UTF-8: control characters
/// (also newline, tab and those from U+0080 on) and what is not UTF-8. It is then one line.
std::string printable(std::string_view text);

/// The same of each line of a text of several.
std::string printable_lines(std::string_view text);

/// The same of the beginning of a word, with "..." where it goes on; for messages that quote it.
std::string excerpt(std::string_view text);

}  // namespace grseg
