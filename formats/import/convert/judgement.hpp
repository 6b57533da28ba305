// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/core/parameters.hpp"
#include "formats/import/convert/import_part.hpp"
#include "formats/import/convert/importer.hpp"
#include "formats/import/convert/verified_frames.hpp"
#include "formats/import/verify/judge.hpp"
#include "formats/trajectory/run_description.hpp"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace grseg {

/// What check_context() wants to know and no other parameter says: which facts are the archive's
/// own, its axes, the types of species, tolerance, waivers.
template <int D>
void add_check_parameters(Parameters& parameters, const VerifiedFrames<D>& frames,
                          const ImportSettings& settings);

/// `import_undecided` and `import_waived`, a line "check: sentence" each, where there are any.
void add_findings(Parameters& parameters, const std::vector<Finding>& findings);

/// Judges the moments of an import, after 1, 2, 4, 8 ... of them and at the end, so that a wrong
/// setting is refused early.
class Judgement {
 public:
  /// Of the run that is written; CheckError where its species are already wrong.
  explicit Judgement(const RunDescription& run);

  /// Of one moment, in SI. CheckError naming `place` where a check fails.
  void add(const CheckMoment& moment, const std::string& place);
  /// The findings of all moments; CheckError where a check fails, and with `strict` where one is
  /// undecided.
  std::vector<Finding> close(bool strict) const;

  /// "; gravity: the archive suggests ..." of the checks over moments that fail with `moment`, too:
  /// what may explain what is wrong with this one.
  std::string also_failed(const CheckMoment& moment) const;

 private:
  CheckContext context_;
  CheckSeries series_;
};

/// Residuals of all moments.
class Residuals {
 public:
  void add(const Residual& residual);
  /// `unit_of_time`: of the archive, s.
  void add_to(ImportReport& report, double unit_of_time) const;

 private:
  double largest_ = 0, unexplained_ = 0;
  std::vector<double> medians_, normal_, tangential_;
};

/// What of an import is known only at its end, from the records of its moments in order.
class Closing {
 public:
  /// Of the run that is written; CheckError where its species are already wrong.
  explicit Closing(const RunDescription& run) : run_(run), judgement_(run) {}

  const Judgement& judgement() const { return judgement_; }
  /// In SI. CheckError naming `place` where a check fails.
  void add(const MomentRecord& record, const std::string& place);
  /// Fills in what the report says of all moments; parameters that say it, too. CheckError where a
  /// check fails, and with `strict` where one is undecided.
  Parameters close(ImportReport& report, bool strict) const;

 private:
  const RunDescription& run_;
  Judgement judgement_;
  Residuals residuals_;
};

}  // namespace grseg
