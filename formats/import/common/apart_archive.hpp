// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/import/common/archive.hpp"

#include <functional>
#include <memory>
#include <string>

namespace grseg {

/// The archive that `open` opens, of one `file` and of a format without --columns, read in a process
/// of its own (apart.hpp).
std::unique_ptr<Archive> open_apart(const std::string& file,
                                    const std::function<std::unique_ptr<Archive>()>& open);

}  // namespace grseg
