// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

namespace grseg {

/// The files meant by `names`, of which one may hold `*` and `%` and stand for many (one per step and
/// one per processor, as LAMMPS writes them), in natural order: atoms.9.dump before atoms.10.dump. UsageError naming
/// `option` where no file is named or one is missing.
std::vector<std::string> archive_files(const std::vector<std::string>& names,
                                       const std::string& option);

/// `names` and the files that those with `*` stand for, whether they exist or not.
std::vector<std::string> files_meant(const std::vector<std::string>& names);

/// Whether a sorts before b where runs of digits are compared as numbers.
bool natural_less(const std::string& a, const std::string& b);

}  // namespace grseg
