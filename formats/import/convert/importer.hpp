// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/core/parameters.hpp"
#include "formats/import/facts/import_settings.hpp"
#include "formats/import/verify/check_context.hpp"

#include <cstddef>
#include <string>
#include <vector>

namespace grseg {

/// Result of an import.
struct ImportReport {
  int dimension = 2;
  std::size_t frames = 0, grains = 0, contacts = 0;
  double first_time = 0, last_time = 0;  // s
  /// The parameters of the file. If the archive allows a check of the grains' force balances
  /// (verification.hpp), import_residual_largest and _median are its residuals: the largest, and
  /// the median over frames of the median over grains. If the program's forces are half a step late
  /// (imbalance.hpp), import_residual_unexplained is the largest residual that late damping does
  /// not explain, and import_late_damping this damping (1/s, medians over frames).
  Parameters parameters;
  std::vector<std::string> remarks;
  std::vector<Finding> findings;  // results of all checks
};

/// Imports the archive frame by frame into the trajectory file `settings.output`, which appears
/// only when it is complete; `command_line` becomes part of its history. Throws the errors of
/// readers, collect_facts() and ImportedBed. Throws CheckError if a frame fails the verification
/// (and names a value of --columns that would pass), if a check over all frames fails, or, with
/// --strict, is undecided.
ImportReport import_archive(const ImportSettings& settings, const std::string& command_line);

/// A summary for the user, several lines.
std::string to_text(const ImportReport& report);

}  // namespace grseg
