// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>
#include <string>
#include <vector>

namespace grseg {

/// The files of a dump, by how they have to be read.
struct DumpParts {
  /// One list of files in order of their first steps or, where several processors wrote files that
  /// begin with the same steps (with % in their names), one list for each of them.
  std::vector<std::vector<std::string>> lists;
  /// By a file with a header, those with more rows of its step: of `dump local` LAMMPS writes the
  /// header for the first processor alone.
  std::map<std::string, std::vector<std::string>> more_rows;
};

/// FormatError where rows without a header may be of several steps.
DumpParts parts_of_dump(const std::vector<std::string>& files);

}  // namespace grseg
