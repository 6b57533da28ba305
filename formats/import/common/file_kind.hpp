// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>
#include <vector>

/// Files that users name beside archives and that no format reads, told by their first bytes.
namespace grseg {

/// What a file is that begins with `start`, unpacked, and the way out, to follow its name in a sentence:
/// "is a tar archive: unpack it". "" where it may be the text of an archive.
std::string other_kind(std::string_view start);

/// The same of an HDF5 file that has these names in its root, but for one of grseg's own.
std::string other_kind_of_hdf5(const std::vector<std::string>& groups);

}  // namespace grseg
