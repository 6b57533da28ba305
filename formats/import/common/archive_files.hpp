// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace grseg {

/// The files meant by `names`, of which one may hold `*` and `%` and stand for many (one per step and
/// one per processor, as LAMMPS writes them), in natural order: atoms.9.dump before atoms.10.dump. UsageError naming
/// `option` where no file is named or one is missing.
std::vector<std::string> archive_files(const std::vector<std::string>& names,
                                       const std::string& option);

/// `names` and the files that those with `*` stand for, whether they exist or not.
std::vector<std::string> files_meant(const std::vector<std::string>& names);

/// True where a sorts before b, runs of digits being compared as numbers.
bool natural_less(const std::string& a, const std::string& b);

/// Files that users name beside archives and that no format reads, told by their first bytes.

/// The kind of a file that begins with `start`, unpacked, and the way out, to follow its name in a
/// sentence: "is a tar archive: unpack it". "" where it may be the text of an archive.
std::string other_kind(std::string_view start);

/// The content of a file of an archive.
enum class FileRole { none, grains, contacts, restart };

/// The beginning of a file, by which a format recognises it as one of its own.
struct FileStart {
  std::string name;                 // of the file, without its folder
  std::vector<std::string> lines;   // of text, the first ones, at most twenty; unpacked
  std::vector<std::string> groups;  // of HDF5: the names in its root
};

/// UsageError where the file is missing or is a trajectory of grseg, FormatError where it is of a kind
/// that no format reads.
void refuse_other_kind(const std::string& path);

/// The beginning of a file. Throws as refuse_other_kind() does, and FormatError where it is damaged.
FileStart read_start(const std::string& path);

}  // namespace grseg
