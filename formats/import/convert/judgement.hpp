// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/core/parameters.hpp"
#include "formats/import/convert/import_part.hpp"
#include "formats/import/convert/importer.hpp"
#include "formats/import/verify/judge.hpp"
#include "formats/trajectory/run_description.hpp"

#include <string>
#include <vector>

namespace grseg {

/// Judges an import from the records of its moments in order: after 1, 2, 4, 8 ... of them, so that a
/// wrong setting is refused early, and at the end.
class Judgement {
 public:
  /// Judges the run that is written, which it refers to; CheckError where its species are already
  /// wrong.
  explicit Judgement(const RunDescription& run);

  /// Adds one moment, in SI. CheckError naming `place` where a check fails.
  void add(const MomentRecord& record, const std::string& place);
  /// Fills in what the report says of all moments; parameters that say it, too. CheckError where a
  /// check fails, and with `strict` where one is undecided.
  Parameters close(ImportReport& report, bool strict) const;
  /// "; gravity: the archive suggests ..." of the checks over moments that fail with `moment`, too:
  /// what may explain what is wrong with this one.
  std::string also_failed(const CheckMoment& moment) const;

 private:
  void add_residuals_to(Parameters& parameters) const;

  const RunDescription& run_;
  CheckContext context_;
  CheckSeries series_;
  std::vector<Residual> residuals_;
};

}  // namespace grseg
