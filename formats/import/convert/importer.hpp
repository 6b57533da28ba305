// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/core/parameters.hpp"
#include "formats/import/facts/import_settings.hpp"
#include "formats/import/verify/check_context.hpp"

#include <cstddef>
#include <string>
#include <vector>

namespace grseg {

/// How an import went.
struct ImportReport {
  int dimension = 2;
  std::size_t frames = 0, grains = 0, contacts = 0;
  double first_time = 0, last_time = 0;  // s
  /// The parameters of the file. Where there was something to compare with, import_residual_largest
  /// and _median are the residuals of grains' balances (verification.hpp): the largest, and the median
  /// over the moments of the median over grains. Where the program's forces are late (imbalance.hpp),
  /// import_residual_unexplained is the largest that late damping does not explain, and
  /// import_late_damping this damping (1/s, medians over the moments).
  Parameters parameters;
  std::vector<std::string> remarks;
  std::vector<Finding> findings;  // of all checks
};

/// Imports the archive moment by moment into the trajectory file `settings.output`, which appears
/// whole or not at all; `command_line` goes into its history. Throws what readers, facts and
/// builder throw, and CheckError where a moment fails the verification, with another --columns that
/// would pass, where a check over all moments fails, and with --strict where one is undecided.
ImportReport import_archive(const ImportSettings& settings, const std::string& command_line);

/// A summary for the user, several lines.
std::string to_text(const ImportReport& report);

}  // namespace grseg
