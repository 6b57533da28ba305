// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>

namespace grseg {

/// `word` as a shell's command line writes it, in printable characters: bare where every character
/// is harmless, else in single quotes, and as $'...' (bash, zsh, ksh, POSIX 2024) where it holds a
/// control character or what is not UTF-8.
std::string shell_word(std::string_view word);

}  // namespace grseg
