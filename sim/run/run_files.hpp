// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/trajectory/writer.hpp"

#include <string>

/// The files that a run writes: how they are called while it runs, and how they get their names.
namespace grseg {

/// What the file is called while it is written: PATH.part.
std::string part_of(const std::string& path);

/// RunError where no file can be written at `path`, before time is spent on a run rather than after
/// it. Leaves an empty file where there was none.
void require_writable(const std::string& path);

/// Whether there is a file with something in it.
bool holds_something(const std::string& path);

/// Renames the finished trajectory `part` to `output`, compressed where `storage` asks for it.
void publish_trajectory(const std::string& part, const std::string& output,
                        const StorageSettings& storage);

}  // namespace grseg
