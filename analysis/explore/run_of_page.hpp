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

/// One run for a page: JSON, arrays, and the tables of sums, which are also needed to fit all runs together.
struct RunOfPage {
  nlohmann::ordered_json content;
  BinaryArrays arrays;
  StressTables sums;
};

/// Largest total size of the arrays of a page, MB. A browser reads the arrays of a run from a base64
/// string, which has four characters for three bytes, and a string in Chromium has at most 2^29
/// characters. While the page opens, memory contains four copies of the arrays.
inline constexpr double most_megabytes = 300;

/// Throws UsageError if the arrays of all runs would exceed most_megabytes. Reads no frames.
void refuse_too_large(const ToolInfo& info, const po::variables_map& values,
                      const std::vector<std::string>& runs, const ExploreSettings& settings);

/// Reads the run in file `path`, several times. `table` is the table of sums that the user gave; if it is
/// null, the sums are made from the run. `command` is the last line of the history of these sums.
RunOfPage run_of_page(const ToolInfo& info, const po::variables_map& values,
                      const std::string& path, const Table* table, const ExploreSettings& settings,
                      const std::string& command);

/// Fits over all runs together, or the sentence that says why there are none.
nlohmann::ordered_json fitted_together(const std::vector<RunOfPage>& runs,
                                       const ExploreSettings& settings, BinaryArrays& arrays);

/// Summary of a run, read from its file:
///
///   name, digest, verified, notes (pairs: incomplete, undecided, waived), history, program,
///   dimension, frames, contacts, begin, end (s), scene (the text of /parameters/scene, or ""),
///   parameters (pairs of name and text), accuracy (pairs of /parameters/summary_*),
///   observables (name, unit, mean and largest value over all frames)
///
/// Texts are not escaped for HTML.
nlohmann::ordered_json run_summary(const TrajectoryReader& run);

/// Lines that `grseg-check --physics` prints for the run in file `path`, which is read completely:
/// {"command", "failures", "undecided", "lines": [{"quantity", "y0", "y1", "measured", "tolerance",
/// "verdict", "remark"}, ...]}.
nlohmann::ordered_json check_run(const std::string& path);

/// Results of grseg-stress, -kinetic, -derive and -balance for a run with default options, by layer. Each
/// number is a mean over all windows, weighted by frames. A window that does not reach up to a layer counts
/// with an empty one: 0 for sums, and left out of the means of quotients. The entry "tables" is a list of
///
///   {"name": "kinetic", "tool": "grseg-kinetic", "note": "...", "columns": ["y0[m]", ...],
///    "shown": ["u[m/s]", ...], "rows": [[...], ...], "frames": [...]}
///
/// `shown` names the columns that the page shows first. `frames` has for each row the number of frames of
/// the windows that reach up to it. The frames are read several times. A table that
/// the run does not allow (not two species, no forces on grains) is left out; the entry "missing" says why.
nlohmann::ordered_json layer_tables(FrameLoop& loop);

/// Results of grseg-segregation for a run of two species: {"numbers": [[name, value, low, high], ...],
/// "remarks": [...], "columns": ["t0[s]", ...], "rows": [[...], ...]}. Numbers and remarks are as --summary
/// prints them for layers between `heights`. A row has the heights of the species' centres of mass,
/// the shear and the mixing in one window. Null if the run has another number of species.
nlohmann::ordered_json segregation_data(FrameLoop& loop, const std::string& heights);

}  // namespace grseg
