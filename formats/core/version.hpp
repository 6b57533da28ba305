// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace grseg {

/// Version, "1.0.0", and version with git hash, "1.0.0 (1a2b3c4)".
std::string version();
std::string version_with_hash();

}  // namespace grseg
