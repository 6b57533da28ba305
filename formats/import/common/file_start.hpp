// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

namespace grseg {

/// What a file of an archive holds.
enum class FileRole { none, grains, contacts, restart };

/// The beginning of a file, by which a format recognises it as one of its own.
struct FileStart {
  std::string name;                 // of the file, without its folder
  std::vector<std::string> lines;   // of text, the first ones, at most twenty; unpacked
  std::vector<std::string> groups;  // of HDF5: the names in its root
};

/// UsageError where the file is missing or is a trajectory of grseg, FormatError where it is of a kind
/// that no format reads (file_kind.hpp).
void refuse_other_kind(const std::string& path);

/// The same, and FormatError where the file is damaged.
FileStart read_start(const std::string& path);

}  // namespace grseg
