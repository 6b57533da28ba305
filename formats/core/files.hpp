// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace grseg {

/// Refuses a path that is no readable file (UsageError).
void require_file(const std::string& path);

/// Refuses to write where a folder is, or a file unless `overwrite` (UsageError).
void refuse_to_overwrite(const std::string& path, bool overwrite);

/// Has the system write what it keeps of `path` to the disk. RunError where that fails.
void bring_to_disk(const std::string& path);

/// Brings the closed file `beside` to the disk and renames it to `path`, so that `path` is whole or
/// not there. RunError where that fails; `beside` is then still there.
void publish_file(const std::string& beside, const std::string& path);

}  // namespace grseg
