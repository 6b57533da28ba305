// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/core/parameters.hpp"
#include "formats/import/convert/importer.hpp"
#include "formats/import/verify/check_series.hpp"
#include "formats/import/verify/judge.hpp"
#include "formats/import/verify/verification.hpp"
#include "formats/trajectory/run_description.hpp"

#include <optional>
#include <string>
#include <vector>

namespace grseg {

/// Numbers that describe a frame for the checks: the residuals of the grains' force balances (their
/// late damping in the archive's units), and the sums that the checks accumulate, in SI.
struct FrameRecord {
  std::optional<Residual> residual;
  CheckNumbers numbers;
};

/// Applies the checks to the records of an import's frames, in order: after 1, 2, 4, 8 ... frames,
/// so that a wrong setting is refused early, and at the end.
class Judgement {
 public:
  /// Stores a reference to the run that is written. Throws CheckError if its species are wrong.
  Judgement(const RunDescription& run, CheckContext context);

  /// Adds one frame, in SI. Throws CheckError naming `place` if a check fails.
  void add(const FrameRecord& record, const std::string& place);
  /// Fills in the report's results over all frames, and returns them as parameters. Throws
  /// CheckError if a check fails or, with `strict`, is undecided.
  Parameters close(ImportReport& report, bool strict) const;
  /// Messages of the checks over all frames that fail once the `numbers` of a frame are included: a
  /// possible cause of this frame's error. Example: "; gravity: the archive suggests ...".
  std::string also_failed(const CheckNumbers& numbers) const;

 private:
  void add_residuals_to(Parameters& parameters) const;

  const RunDescription& run_;
  CheckContext context_;
  CheckSeries series_;
  std::vector<Residual> residuals_;
};

}  // namespace grseg
