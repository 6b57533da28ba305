// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/import/convert/closing.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace grseg {
namespace {

double median(std::vector<double> values)
{
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace

void Residuals::add(const Residual& residual)
{
  largest_ = std::max(largest_, residual.largest);
  medians_.push_back(residual.median);
  if (!residual.late) return;
  unexplained_ = std::max(unexplained_, residual.unexplained);
  normal_.push_back(residual.late->normal);
  tangential_.push_back(residual.late->tangential);
}

void Residuals::add_to(ImportReport& report, double unit_of_time) const
{
  if (medians_.empty()) return;
  report.largest_residual = largest_;
  report.median_residual = median(medians_);
  if (normal_.empty()) return;
  report.unexplained_residual = unexplained_;
  report.late = {median(normal_) / unit_of_time, median(tangential_) / unit_of_time};
}

void Closing::add(const MomentRecord& record, const std::string& place)
{
  if (record.residual) residuals_.add(*record.residual);
  judgement_.add(record.moment, place);
}

Parameters Closing::close(ImportReport& report, bool strict) const
{
  residuals_.add_to(report, run_.parameters.numbers.at("import_units")[1]);
  report.findings = judgement_.close(strict);
  Parameters last;
  // The first moment may have had no contacts to tell.
  if (run_.grains_come_and_go) last.texts["import_columns"] = report.columns;
  if (report.largest_residual) {
    last.numbers["import_residual_largest"] = {*report.largest_residual};
    last.numbers["import_residual_median"] = {*report.median_residual};
  }
  if (report.unexplained_residual) {
    last.numbers["import_residual_unexplained"] = {*report.unexplained_residual};
    last.numbers["import_late_damping"] = {report.late.normal, report.late.tangential};
  }
  if (report.frames > 1)
    last.numbers["frame_interval"] = {(report.last_time - report.first_time) /
                                      static_cast<double>(report.frames - 1)};
  add_findings(last, report.findings);
  if (!report.remarks.empty())
    last.texts["import_remarks"] = fmt::format("{}", fmt::join(report.remarks, "; "));
  return last;
}

}  // namespace grseg
