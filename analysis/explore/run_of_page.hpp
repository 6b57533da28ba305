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

/// What a page has of a run, its arrays, and the sums that those of all runs together are made of.
struct RunOfPage {
  nlohmann::ordered_json content;
  BinaryArrays arrays;
  StressTables sums;
};

/// The arrays of a page are no larger than this, in MB. A browser reads each run's from a string of base64,
/// four bytes for three, and strings end at 2^29 characters in Chromium; while it opens the page it holds
/// them four times.
inline constexpr double most_megabytes = 300;

/// UsageError, before frames are read, where those to be shown of all runs would be more.
void refuse_too_large(const ToolInfo& info, const po::variables_map& values,
                      const std::vector<std::string>& runs, const ExploreSettings& settings);

/// Reads the run in file `path` as often as it takes. `table`: the sums that were given of it, if any;
/// otherwise they are made. `command` is the last line of their history.
RunOfPage run_of_page(const ToolInfo& info, const po::variables_map& values,
                      const std::string& path, const Table* table, const ExploreSettings& settings,
                      const std::string& command);

/// The fits of all runs together, or the sentence that tells why there is none.
nlohmann::ordered_json fitted_together(const std::vector<RunOfPage>& runs,
                                       const ExploreSettings& settings, BinaryArrays& arrays);

/// What was run, with which settings and how accurately, as far as the file says so:
///
///   name, digest, verified, notes (pairs: incomplete, undecided, waived), history, program,
///   dimension, frames, contacts, begin, end (s), scene (the text of /parameters/scene, or ""),
///   parameters (pairs of name and text), accuracy (pairs of /parameters/summary_*),
///   observables (name, unit, mean and largest over all frames)
///
/// No text is fit for a page as it is: what makes a page of it has to escape it.
nlohmann::ordered_json run_summary(const TrajectoryReader& run);

/// The lines of `grseg-check --physics` of the run in file `path`, which is read as a whole:
/// {"command", "failures", "undecided", "lines": [{"quantity", "y0", "y1", "measured", "tolerance",
/// "verdict", "remark"}, ...]}.
nlohmann::ordered_json check_run(const std::string& path);

/// What grseg-stress, -kinetic, -derive and -balance tell of a run with their defaults, by layer:
/// means of the rows of all windows, weighted by frames. A list of
///
///   {"name": "kinetic", "tool": "grseg-kinetic", "note": "...", "columns": ["y0[m]", ...],
///    "shown": ["u[m/s]", ...], "rows": [[...], ...]}
///
/// `shown` are the columns to read first. The frames are read several times. What a run does not allow
/// (one species, no forces on grains) is left out; `missing` then says why.
nlohmann::ordered_json layer_tables(FrameLoop& loop);

/// What grseg-segregation tells of a run of two species: {"numbers": [[name, value, low, high], ...],
/// "remarks": [...], "columns": ["t0[s]", ...], "rows": [[...], ...]}: those of --summary between
/// `heights`, and of each window the heights of the species' centres, the shear and how well grains are
/// mixed. Null of a run of another number of species.
nlohmann::ordered_json segregation_data(FrameLoop& loop, const std::string& heights);

}  // namespace grseg
