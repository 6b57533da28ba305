// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/import/common/archive.hpp"

#include <memory>
#include <string>
#include <vector>

namespace grseg {

/// The formats that open_archive knows, in the order in which --help names them.
const std::vector<std::string>& archive_formats();

/// UsageError where `format` is not among them or a file is missing, FormatError where one is
/// damaged.
std::unique_ptr<Archive> open_archive(const std::string& format, const ArchiveFiles& files);

}  // namespace grseg
