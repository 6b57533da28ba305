// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/import/convert/judgement.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace grseg {
namespace {

const char* source(bool of_the_archive)
{
  return of_the_archive ? "archive" : "command line";
}

/// One sentence of what has failed; nothing where nothing has.
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
  return fmt::format("{} ({} would import it all the same)", fmt::join(all, "; "),
                     fmt::join(names, " "));
}

}  // namespace

template <int D>
void add_check_parameters(Parameters& parameters, const VerifiedFrames<D>& frames,
                          const ImportSettings& settings)
{
  const auto& archive = frames.archive().facts();
  const auto& own = frames.own();
  auto& directions = parameters.numbers["import_directions"];
  for (int k = 0; k < 3; ++k)
    for (int axis = 0; axis < 3; ++axis)
      directions.push_back(
          frames.facts().orientation.axes.template components<3>(Vec3::Unit(axis))[k]);
  parameters.numbers["import_tolerance_of_program"] = {archive.tolerance};
  auto& texts = parameters.texts;
  texts["import_tolerance_reason"] = archive.tolerance_reason;
  texts["import_gravity"] = source(archive.gravity && !settings.gravity);
  texts["import_masses"] = source(archive.density.has_value() || own.masses);
  texts["import_step"] = source(archive.step.has_value());
  texts["import_times"] = own.times;
  if (!frames.facts().doubt_of_masses.empty())
    texts["import_masses_doubt"] = frames.facts().doubt_of_masses;
  texts["import_accepted"] = frames.waivers().text();
  const auto& species = settings.species;
  if (species.small || species.large)
    texts["import_types"] =
        fmt::format("{}\n{}", species.small.value_or(""), species.large.value_or(""));
}

template void add_check_parameters<2>(Parameters&, const VerifiedFrames<2>&, const ImportSettings&);
template void add_check_parameters<3>(Parameters&, const VerifiedFrames<3>&, const ImportSettings&);

void add_findings(Parameters& parameters, const std::vector<Finding>& findings)
{
  const std::pair<const char*, Verdict> kinds[] = {{"import_undecided", Verdict::undecided},
                                                   {"import_waived", Verdict::waived}};
  for (const auto& [name, verdict] : kinds)
    if (auto lines = lines_with(findings, verdict); !lines.empty())
      parameters.texts[name] = std::move(lines);
}

Judgement::Judgement(const RunDescription& run)
    : context_(check_context(run.grains, species_of(run), run.parameters, run.has_force))
{
  const auto sizes = context_.waivers.applied_to(judge_sizes(context_));
  if (const auto text = failures({sizes}); !text.empty()) throw CheckError(text);
}

void Judgement::add(const CheckMoment& moment, const std::string& place)
{
  series_.push_back(moment);
  const auto n = series_.size();
  if ((n & (n - 1)) != 0) return;
  if (const auto text = failures(judge(series_, context_)); !text.empty())
    throw CheckError(fmt::format("{}: {}", place, text));
}

std::vector<Finding> Judgement::close(bool strict) const
{
  auto findings = judge(series_, context_);
  if (const auto text = failures(findings); !text.empty()) throw CheckError(text);
  if (strict && any_with(findings, Verdict::undecided)) {
    auto lines = lines_with(findings, Verdict::undecided);
    for (auto end = lines.find('\n'); end != std::string::npos; end = lines.find('\n', end))
      lines.replace(end, 1, "; ");
    throw CheckError(fmt::format("undecided, and --strict is given: {}", lines));
  }
  return findings;
}

std::string Judgement::also_failed(const CheckMoment& moment) const
{
  auto series = series_;
  series.push_back(moment);
  std::string text;
  for (const auto& finding : judge(series, context_))
    if (finding.verdict == Verdict::failed && finding.check != "contacts" &&
        finding.check != "completeness" && finding.check != "overlap" && finding.check != "pull" &&
        finding.check != "balance")
      text += fmt::format("; {}: {}", finding.check, finding.sentence);
  return text;
}

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
