// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace grseg {

/// What --cite prints: BibTeX of this version of grseg, of the paper whose method it follows, and of
/// the sources of the rules that share out a mixed contact, each under a line on what it is for.
std::string citations();

}  // namespace grseg
