// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace grseg {

/// Bytes that programs of this machine can still get (MemAvailable of /proc/meminfo); infinity where
/// that is not known.
double free_memory();

}  // namespace grseg
