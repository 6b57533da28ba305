// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/import/convert/judgement.hpp"

#include "formats/import/common/frame_tools.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <set>
#include <utility>

namespace grseg {
namespace {

/// One sentence that lists all failed checks; "" if none has failed.
std::string failures(const std::vector<Finding>& findings)
{
  std::vector<std::string> all, names;
  for (const auto& finding : findings) {
    if (finding.verdict != Verdict::failed) continue;
    all.push_back(fmt::format("{}: {}", finding.check, finding.sentence));
    names.push_back(
        fmt::format("--accept-residual {}={:.2g}", finding.check, 1.05 * finding.measure));
  }
  if (all.empty()) return "";
  return fmt::format("{} ({} would import the run in spite of this)", fmt::join(all, "; "),
                     fmt::join(names, " "));
}

}  // namespace

Judgement::Judgement(const RunDescription& run, CheckContext context)
    : run_(run), context_(std::move(context))
{
  const auto sizes = context_.waivers.applied_to(judge_sizes(context_));
  if (const auto text = failures({sizes}); !text.empty()) throw CheckError(text);
}

void Judgement::add(const FrameRecord& record, const std::string& place)
{
  if (record.residual) residuals_.push_back(*record.residual);
  series_.push_back(record.numbers);
  const auto n = series_.size();
  if ((n & (n - 1)) != 0) return;
  if (const auto text = failures(judge(series_, context_)); !text.empty())
    throw CheckError(fmt::format("{}: {}", place, text));
}

void Judgement::add_residuals_to(Parameters& parameters) const
{
  if (residuals_.empty()) return;
  const double unit_of_time = run_.parameters.numbers.at("import_units")[1];
  double largest = 0, unexplained = 0;
  std::vector<double> medians, normal, tangential;
  for (const auto& residual : residuals_) {
    largest = std::max(largest, residual.largest);
    medians.push_back(residual.median);
    if (!residual.late) continue;
    unexplained = std::max(unexplained, residual.unexplained);
    normal.push_back(residual.late->normal);
    tangential.push_back(residual.late->tangential);
  }
  auto& numbers = parameters.numbers;
  numbers["import_residual_largest"] = {largest};
  numbers["import_residual_median"] = {median(medians)};
  if (normal.empty()) return;
  numbers["import_residual_unexplained"] = {unexplained};
  numbers["import_late_damping"] = {median(normal) / unit_of_time,
                                    median(tangential) / unit_of_time};
}

Parameters Judgement::close(ImportReport& report, bool strict) const
{
  report.findings = judge(series_, context_);
  if (const auto text = failures(report.findings); !text.empty()) throw CheckError(text);
  if (const auto all = lines_with(report.findings, Verdict::undecided, "; ");
      strict && !all.empty())
    throw CheckError(fmt::format("undecided, and --strict is given: {}", all));
  Parameters last;
  // The first frame may have had no contacts, so the columns are known only at the end.
  if (run_.grains_come_and_go)
    last.texts["import_columns"] = report.parameters.text("import_columns");
  add_residuals_to(last);
  if (report.frames > 1)
    last.numbers["frame_interval"] = {(report.last_time - report.first_time) /
                                      static_cast<double>(report.frames - 1)};
  const std::pair<const char*, Verdict> kinds[] = {{"import_undecided", Verdict::undecided},
                                                   {"import_waived", Verdict::waived}};
  for (const auto& [name, verdict] : kinds)
    if (auto lines = lines_with(report.findings, verdict); !lines.empty())
      last.texts[name] = std::move(lines);
  if (!report.remarks.empty())
    last.texts["import_remarks"] = fmt::format("{}", fmt::join(report.remarks, "; "));
  report.parameters.numbers.insert(last.numbers.begin(), last.numbers.end());
  return last;
}

std::string Judgement::also_failed(const CheckNumbers& numbers) const
{
  static const std::set<std::string> of_one_frame{"contacts", "completeness", "overlap", "pull",
                                                  "balance"};
  auto series = series_;
  series.push_back(numbers);
  std::string text;
  for (const auto& finding : judge(series, context_))
    if (finding.verdict == Verdict::failed && !of_one_frame.contains(finding.check))
      text += fmt::format("; {}: {}", finding.check, finding.sentence);
  return text;
}

}  // namespace grseg
