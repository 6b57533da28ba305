// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/import/convert/importer.hpp"

#include "formats/cli/interruption.hpp"
#include "formats/cli/output.hpp"
#include "formats/cli/tool.hpp"
#include "formats/core/dimension.hpp"
#include "formats/core/version.hpp"
#include "formats/import/common/file_list.hpp"
#include "formats/import/convert/judgement.hpp"
#include "formats/import/convert/verified_frames.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace grseg {
namespace {

/// Mean of the smallest and the largest diameter of a species; 0 where it has no grains.
double mid_range(const Grains& grains, Species species)
{
  double low = INFINITY, high = 0;
  for (std::size_t g = 0; g < grains.size(); ++g) {
    if (grains.species[g] != species) continue;
    low = std::min(low, 2 * grains.radius[g]);
    high = std::max(high, 2 * grains.radius[g]);
  }
  return high > 0 ? (low + high) / 2 : 0;
}

/// Mass over area or volume of the mobile grains, kg/m^2 or kg/m^3.
template <int D>
double density(const Grains& grains)
{
  double mass = 0, content = 0;
  for (std::size_t g = 0; g < grains.size(); ++g) {
    if (grains.species[g] == Species::boundary) continue;
    mass += grains.mass[g];
    content += grain_volume<D>(grains.radius[g]);
  }
  return content > 0 ? mass / content : 0;
}

/// The species with nominal diameters in m. Of small and large, one without grains gets the
/// diameter of the other.
SpeciesList with_diameters(SpeciesList list, const Grains& grains, const Units& units)
{
  for (std::size_t k = 0; k < list.size(); ++k)
    list[k].diameter = list[k].diameter > 0 ? list[k].diameter * units.length
                                            : mid_range(grains, static_cast<Species>(k));
  if (list.size() == 2)
    for (std::size_t k = 0; k < 2; ++k)
      if (!(list[k].diameter > 0)) list[k].diameter = list[1 - k].diameter;
  return list;
}

/// The description of the run, in SI.
template <int D>
RunDescription describe(const VerifiedFrames<D>& frames, const ImportSettings& settings,
                        const std::string& command_line)
{
  const auto& facts = frames.facts();
  const auto& units = facts.units;
  RunDescription run;
  run.grains = frames.builder().bed().grains;
  units.convert(run.grains);
  run.box = frames.builder().bed().box;
  run.box.length_x *= units.length;
  run.box.length_y *= units.length;
  run.box.length_z *= units.length;
  run.has_force = frames.has_force();
  run.grains_come_and_go = frames.roster() != nullptr;
  run.observables = check_observables();
  run.observables.insert(run.observables.begin(), {"momentum_defect", ""});

  auto& numbers = run.parameters.numbers;
  const Vector<D> gravity = facts.orientation.gravity.template head<D>() * units.acceleration();
  numbers["gravity"] = {gravity.begin(), gravity.end()};
  numbers["slope"] = {std::atan2(gravity.x(), -gravity.y()) * 180 / std::numbers::pi};
  numbers["step"] = {facts.step * units.time};
  numbers["density"] = {density<D>(run.grains)};
  run.species = with_diameters(frames.builder().bed().species.list, run.grains, units);
  numbers["small_diameter"] = {run.species.front().diameter};
  numbers["large_diameter"] = {run.species.back().diameter};
  numbers["import_tolerance"] = {frames.tolerance()};
  numbers["import_origin"] = {frames.builder().bed().origin};
  numbers["import_units"] = {units.length, units.time, units.mass};

  auto& texts = run.parameters.texts;
  texts["program"] = "grseg-import " + version_with_hash();
  texts["command_line"] = command_line;
  texts["history"] = command_line;
  texts["origin"] = settings.origin;
  texts["import_format"] = settings.format;
  texts["import_axes"] = facts.axes;
  texts["import_units_as_told"] = facts.units_as_given;
  texts["import_grains"] = facts.discs ? "discs" : "spheres";
  texts["import_base"] = frames.builder().bed().species.base;
  texts["import_sizes"] = frames.builder().bed().species.sizes;
  texts["import_columns"] = frames.archive().columns();
  if (!facts.walls.empty()) texts["import_walls"] = fmt::format("{}", fmt::join(facts.walls, ", "));
  if (settings.from) texts["import_from"] = *settings.from;
  if (settings.to) texts["import_to"] = *settings.to;
  texts["import_instant"] =
      "positions, velocities and forces are those of the archive at `time`, not of the middle of a "
      "step";
  add_check_parameters(run.parameters, frames, settings);
  return run;
}

/// All files that an import reads.
std::vector<std::string> inputs_of(const ArchiveFiles& files)
{
  auto names = files.grains;
  names.insert(names.end(), files.contacts.begin(), files.contacts.end());
  names.push_back(files.restart);
  return files_meant(names);
}

template <int D>
[[noreturn]] void refuse(const VerifiedFrames<D>& frames, const ImportSettings& settings,
                         const Judgement& judgement, std::size_t moments)
{
  const auto& complaint = *frames.complaint();
  const auto fitting = complaint.of_columns
                           ? columns_that_fit(settings, frames.archive(), moments, frames.roster())
                           : std::string();
  const auto others = fitting.empty()
                          ? judgement.also_failed(in_si(frames.moment(), frames.facts().units))
                          : std::string();
  const bool offer = fitting.empty() && complaint.check == "balance";
  throw CheckError(
      fmt::format("{}: {}{}{}{}", frames.place(), complaint.sentence, fitting, others,
                  offer ? "; --accept-residual balance=R imports what balances to R" : ""));
}

double median(std::vector<double> values)
{
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Residuals of all moments.
class Residuals {
 public:
  void add(const Residual& residual)
  {
    largest_ = std::max(largest_, residual.largest);
    medians_.push_back(residual.median);
    if (!residual.late) return;
    unexplained_ = std::max(unexplained_, residual.unexplained);
    normal_.push_back(residual.late->normal);
    tangential_.push_back(residual.late->tangential);
  }
  void add_to(ImportReport& report, const Units& units) const
  {
    if (medians_.empty()) return;
    report.largest_residual = largest_;
    report.median_residual = median(medians_);
    if (normal_.empty()) return;
    report.unexplained_residual = unexplained_;
    report.late = {median(normal_) / units.time, median(tangential_) / units.time};
  }

 private:
  double largest_ = 0, unexplained_ = 0;
  std::vector<double> medians_, normal_, tangential_;
};

/// What is known only at the end.
template <int D>
void finish(TrajectoryWriter& writer, const VerifiedFrames<D>& frames, ImportReport& report)
{
  report.remarks = frames.archive().remarks();
  if (!frames.range().is_all())
    report.remarks.push_back(
        fmt::format("only moments in the range {} are imported", frames.range().text()));
  if (const auto roster = frames.roster())
    report.remarks.push_back(
        fmt::format("grains come and go: {} ids in all, between {} and {} present",
                    roster->all.grains.size(), roster->fewest, roster->most));
  if (frames.walls())
    for (auto& remark : frames.walls()->remarks()) report.remarks.push_back(std::move(remark));
  if (!frames.has_force())
    report.remarks.emplace_back("the archive has no forces on grains, and the trajectory none");
  if (!frames.has_angular_velocity())
    report.remarks.emplace_back("the archive has no angular velocities; they are written as 0");
  Parameters last;
  if (frames.roster()) {  // the first moment may have had no contacts to tell
    report.columns = frames.archive().columns();
    last.texts["import_columns"] = report.columns;
  }
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
  writer.add_parameters(last);
}

/// Verifies and writes all frames to the file `path`.
template <int D>
ImportReport write_frames(VerifiedFrames<D> frames, const ImportSettings& settings,
                          const std::string& command_line, const std::string& path)
{
  const auto run = describe(frames, settings, command_line);
  ImportReport report;
  report.dimension = D;
  report.grains = run.grains.size();
  report.tolerance = frames.tolerance();
  report.tolerance_reason = frames.archive().facts().tolerance_reason;
  report.columns = frames.archive().columns();
  report.base = frames.builder().bed().species.base;
  report.sizes = frames.builder().bed().species.sizes;
  TrajectoryWriter writer(path, run, settings.storage);
  Judgement judgement(run);
  Residuals residuals;
  for (Frame<D> frame; frames.next(frame);) {
    stop_if_interrupted();
    if (frames.complaint()) refuse(frames, settings, judgement, report.frames + 1);
    const double defect = frames.residual() ? frames.residual()->largest : 0;
    if (frames.residual()) residuals.add(*frames.residual());
    frames.facts().units.convert(frame);
    if (report.frames == 0) report.first_time = frame.time;
    report.last_time = frame.time;
    ++report.frames;
    report.contacts += frame.contacts.size();
    const auto moment = in_si(frames.moment(), frames.facts().units);
    judgement.add(moment, frames.place());
    auto observables = check_values(moment);
    observables.insert(observables.begin(), defect);
    writer.append(frame, observables);
  }
  residuals.add_to(report, frames.facts().units);
  report.findings = judgement.close(settings.strict);
  finish(writer, frames, report);
  writer.close();
  return report;
}

}  // namespace

ImportReport import_archive(const ImportSettings& settings, const std::string& command_line)
{
  if (settings.output.empty()) open_with_grains(settings);  // asks for it
  Output output(settings.output, settings.overwrite, inputs_of(settings.files));
  const auto write = [&](OpenedArchive opened) {
    return with_dimension(opened.facts.dimension, [&](auto d) {
      return write_frames(VerifiedFrames<d>(std::move(opened), settings), settings, command_line,
                          output.temporary());
    });
  };
  ImportReport report;
  try {
    report = write(open_with_grains(settings));
  } catch (const OtherGrains&) {
    report = write(open_with_roster(settings));
  }
  output.publish();
  return report;
}

std::string to_text(const ImportReport& report)
{
  std::string text =
      fmt::format("{} frames from {:g} to {:g} s, {} grains, {} contacts{}\n", report.frames,
                  report.first_time, report.last_time, report.grains, report.contacts,
                  report.dimension == 3 ? ", in three dimensions" : "");
  if (!report.columns.empty()) text += fmt::format("columns: {}\n", report.columns);
  text += fmt::format("base: {}; {}\n", report.base, report.sizes);
  if (report.largest_residual)
    text +=
        fmt::format("grains balance: largest residual {:.3g}, median {:.3g} of the largest force\n",
                    *report.largest_residual, *report.median_residual);
  if (report.unexplained_residual)
    text += fmt::format(
        "of the largest, {:.3g} is not explained by damping of {:.4g} 1/s (normal) and {:.4g} 1/s "
        "(tangential) half a step late\n",
        *report.unexplained_residual, report.late.normal, report.late.tangential);
  if (report.largest_residual)
    text += fmt::format("tolerance {:g}: {}\n", report.tolerance, report.tolerance_reason);
  for (const auto& [check, verdict, sentence, measure] : report.findings)
    text += fmt::format("check {}: {} ({:.2g}): {}\n", check, to_text(verdict), measure, sentence);
  for (const auto& remark : report.remarks) text += remark + "\n";
  return text;
}

}  // namespace grseg
