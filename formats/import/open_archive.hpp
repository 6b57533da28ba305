// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/import/common/archive.hpp"

#include <memory>
#include <span>
#include <string>

namespace grseg {

/// The known formats, in the order in which --help names them.
std::span<const ArchiveFormat* const> archive_formats();

/// UsageError where there is no such format.
void require_format(const std::string& name);

/// UsageError where `format` is unknown, an option does not apply to it or a file is missing,
/// FormatError where a file is damaged.
std::unique_ptr<Archive> open_archive(const std::string& format, const ArchiveFiles& files);

}  // namespace grseg
