// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/import/convert/import_part.hpp"
#include "formats/import/convert/importer.hpp"
#include "formats/import/convert/judgement.hpp"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace grseg {

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
