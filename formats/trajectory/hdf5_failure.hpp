// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace grseg::hdf5 {

/// Why the last call of the library failed, as the system told it ("No space left on device"), where
/// the library knows; to be asked before the next call.
std::string reason_of_failure();

}  // namespace grseg::hdf5
