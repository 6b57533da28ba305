// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace grseg {

/// One word of a shell's command line: in single quotes where it holds what a shell would change.
std::string shell_word(const std::string& word);

/// Tells on a terminal what is run next: "next: grseg-fit stress.tsv". Nothing in a file, in a pipe
/// or with `quiet`.
void say_next(const std::string& command, bool quiet);

}  // namespace grseg
