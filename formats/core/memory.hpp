// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace grseg {

/// Memory that this process may still use, bytes: the least of MemAvailable (/proc/meminfo) and of
/// what the control groups above it leave (cgroups(7), version 1 and 2); infinity if nothing is
/// known. `root` is the folder that holds /proc and /sys.
double free_memory(const std::string& root = "");

}  // namespace grseg
