// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace grseg {

/// The files that match `names`, in natural order (atoms.9.dump before atoms.10.dump). In a name
/// `*` and `%` match any text: LAMMPS writes a file per step (`*`) and per processor (`%`). Throws
/// UsageError naming `option` if no file is named or one is missing.
std::vector<std::string> archive_files(const std::vector<std::string>& names,
                                       const std::string& option);

/// `names` themselves, whether such files exist or not, and all files that match them.
std::vector<std::string> files_meant(const std::vector<std::string>& names);

/// True if a sorts before b. Sequences of digits are compared as numbers.
bool natural_less(const std::string& a, const std::string& b);

/// Kind and remedy of a file that no format reads, recognised by its first bytes. The text follows
/// the file's name in a message: "is a tar archive: unpack it". "" if the file may be text of an
/// archive. `start` is the beginning of the file, decompressed.
std::string other_kind(std::string_view start);

/// Kind and remedy, like other_kind(), of a file whose content nothing tells, by its name; "" if the
/// name tells nothing either.
std::string kind_by_name(const std::string& path);

/// The kind of data that a file of an archive contains.
enum class FileRole { none, grains, contacts, restart };

/// The beginning of a file, by which a format recognises it as one of its own.
struct FileStart {
  std::string name;                 // name of the file, without its folder
  std::vector<std::string> lines;   // first lines of a text file, decompressed, at most twenty
  std::vector<std::string> groups;  // names in the root of an HDF5 file
};

/// Throws UsageError if the file is missing or is a trajectory of grseg, FormatError if no format
/// reads this kind of file.
void refuse_other_kind(const std::string& path);

/// Beginning of a file. Throws the errors of refuse_other_kind(), FormatError if it is damaged.
FileStart read_start(const std::string& path);

}  // namespace grseg
