// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/explore/settings.hpp"
#include "formats/cli/table.hpp"

#include <nlohmann/json.hpp>

#include <cstddef>
#include <string>

namespace grseg {

/// The commands that print the B of a page, for a shell, as far as they do not depend on the rule:
///
///   {"sums": "grseg-stress run.h5 --window 2", "file": "sums.tsv", "fit": " --heights 4dS:"}
///
/// `sums` is empty where the sums came in a table, `given`, whose name is `file` then. `number`: of the run
/// among several; 0 of a single one.
nlohmann::ordered_json commands_of(const std::string& run, const Table* given,
                                   const ExploreSettings& settings, std::size_t number);

}  // namespace grseg
