// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/explore/binary_arrays.hpp"
#include "analysis/explore/partition_data.hpp"
#include "analysis/explore/settings.hpp"
#include "formats/trajectory/reader.hpp"

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace grseg {

/// One run for a page: JSON and arrays, and its sums, from which the sums of all runs are made.
struct RunOfPage {
  nlohmann::ordered_json content;
  BinaryArrays arrays;
  StressTables sums;
};

/// Largest size of all arrays of a page, MB. A browser reads the arrays of a run from a string of base64,
/// four bytes for three, and a string of Chromium has at most 2^29 characters. While the page opens, the
/// arrays are in memory four times.
inline constexpr double most_megabytes = 300;

/// UsageError where the arrays of all runs would be larger than that. Reads no frames.
void refuse_too_large(const ToolInfo& info, const po::variables_map& values,
                      const std::vector<std::string>& runs, const ExploreSettings& settings);

/// Reads the run in file `path`, several times. `table`: its sums if they were given; null: they are
/// made. `command` is the last line of their history.
RunOfPage run_of_page(const ToolInfo& info, const po::variables_map& values,
                      const std::string& path, const Table* table, const ExploreSettings& settings,
                      const std::string& command);

/// The fits of all runs together, or the sentence that tells why there are none.
nlohmann::ordered_json fitted_together(const std::vector<RunOfPage>& runs,
                                       const ExploreSettings& settings, BinaryArrays& arrays);

/// Summary of a run, as its file states it:
///
///   name, digest, verified, notes (pairs: incomplete, undecided, waived), history, program,
///   dimension, frames, contacts, begin, end (s), scene (the text of /parameters/scene, or ""),
///   parameters (pairs of name and text), accuracy (pairs of /parameters/summary_*),
///   observables (name, unit, mean and largest over all frames)
///
/// Texts are not escaped for HTML.
nlohmann::ordered_json run_summary(const TrajectoryReader& run);

/// The lines of `grseg-check --physics` of the run in file `path`, which is read as a whole:
/// {"command", "failures", "undecided", "lines": [{"quantity", "y0", "y1", "measured", "tolerance",
/// "verdict", "remark"}, ...]}.
nlohmann::ordered_json check_run(const std::string& path);

/// Results of grseg-stress, -kinetic, -derive and -balance for a run, with their defaults, by layer: means
/// over all windows, weighted by frames. A list of
///
///   {"name": "kinetic", "tool": "grseg-kinetic", "note": "...", "columns": ["y0[m]", ...],
///    "shown": ["u[m/s]", ...], "rows": [[...], ...]}
///
/// `shown` names the columns to read first. The frames are read several times. A table that the run does
/// not allow (one species, no forces on grains) is left out, and `missing` has a sentence that says why.
nlohmann::ordered_json layer_tables(FrameLoop& loop);

/// Results of grseg-segregation for a run of two species: {"numbers": [[name, value, low, high], ...],
/// "remarks": [...], "columns": ["t0[s]", ...], "rows": [[...], ...]}. Numbers and remarks are as --summary
/// prints them for layers between `heights`; a row has the heights of the species' centres, the shear
/// and the mixing in one window. Null if the run has another number of species.
nlohmann::ordered_json segregation_data(FrameLoop& loop, const std::string& heights);

}  // namespace grseg
