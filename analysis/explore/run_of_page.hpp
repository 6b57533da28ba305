// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/explore/binary_arrays.hpp"
#include "analysis/explore/partition_data.hpp"
#include "analysis/explore/settings.hpp"

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace grseg {

/// What a page has of a run, its arrays, and the sums that those of all runs together are made of.
struct RunOfPage {
  nlohmann::ordered_json content;
  BinaryArrays arrays;
  PartitionInput sums;
};

/// Reads the run in file `path` as often as it takes. `table`: the sums that were given of it, if any;
/// otherwise they are made. `command` is the last line of their history.
RunOfPage run_of_page(const ToolInfo& info, const po::variables_map& values,
                      const std::string& path, const Table* table, const ExploreSettings& settings,
                      const std::string& command);

/// The fits of all runs together, or the sentence that tells why there is none.
nlohmann::ordered_json fitted_together(const std::vector<RunOfPage>& runs,
                                       const ExploreSettings& settings, BinaryArrays& arrays);

}  // namespace grseg
