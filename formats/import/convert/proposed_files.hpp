// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/import/common/questions.hpp"
#include "formats/import/facts/import_settings.hpp"

namespace grseg {

/// The settings where --format names the program, and files that were named without an option are
/// taken for what they hold. UsageError where one does not show it.
ImportSettings with_known_files(const ImportSettings& settings);

/// The settings with what files by themselves show: the format, and which of the files that were
/// named without an option hold grains and which contacts. All of it is asked for in `questions`, as
/// is a missing output. UsageError where a file is missing.
ImportSettings with_proposed_files(const ImportSettings& settings, Questions& questions);

}  // namespace grseg
