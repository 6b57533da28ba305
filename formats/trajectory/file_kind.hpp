// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>

/// Names of files that were given to the wrong program, for messages.
namespace grseg {

struct FileKind {
  std::string name;  // "a checkpoint of grseg-sim"; "" if the content is not known
  std::string use;   // what to do with it: "grseg-sim --restart continues it"

  /// "is a checkpoint of grseg-sim, not a run: grseg-sim --restart continues it" if `wanted` is "a
  /// run"; `otherwise` if the content is unknown, or if its name begins with `wanted`.
  std::string instead_of(std::string_view wanted, const std::string& otherwise) const;
};

/// Kind of a file by its first bytes, without looking into an HDF5 file: a table, a scene, a dump.
FileKind kind_of_start(std::string_view start);

/// Kind of the file `path` by its content. A file that cannot be read has no known kind.
FileKind kind_of_file(const std::string& path);

}  // namespace grseg
