// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace grseg {

/// Tells on a terminal what is run next: "next: grseg-fit stress.tsv". Nothing in a file, in a pipe
/// or with `quiet`.
void say_next(const std::string& command, bool quiet);

}  // namespace grseg
