// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace grseg {

/// Which of `words` was given. UsageError, naming them all, where none.
std::size_t choose(const std::string& word, const char* option,
                   const std::vector<std::string>& words);

/// The known word nearest to `word`, or "" where none is near.
std::string nearest(const std::string& word, const std::vector<std::string>& known);

}  // namespace grseg
