// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/import/convert/importer.hpp"

#include "formats/cli/interruption.hpp"
#include "formats/cli/output.hpp"
#include "formats/cli/progress.hpp"
#include "formats/cli/tool.hpp"
#include "formats/core/frame.hpp"
#include "formats/core/text.hpp"
#include "formats/core/version.hpp"
#include "formats/import/common/archive_files.hpp"
#include "formats/import/convert/import_part.hpp"
#include "formats/import/convert/judgement.hpp"
#include "formats/import/convert/verified_frames.hpp"
#include "formats/trajectory/run_description.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <sstream>

namespace grseg {
namespace {

namespace fs = std::filesystem;

constexpr const char* program = "grseg-import";

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
  run.observables = import_observables();

  auto& numbers = run.parameters.numbers;
  const Vector<D> gravity = facts.orientation.gravity.template head<D>() * units.acceleration();
  numbers["gravity"] = {gravity.begin(), gravity.end()};
  numbers["slope"] = {std::atan2(gravity.x(), -gravity.y()) * 180 / std::numbers::pi};
  numbers["step"] = {facts.step * units.time};
  numbers["density"] = {mean_density<D>(run.grains)};
  run.species = with_diameters(frames.builder().bed().species.list, run.grains, units);
  numbers["small_diameter"] = {run.species.front().diameter};
  numbers["large_diameter"] = {run.species.back().diameter};
  numbers["import_tolerance"] = {frames.tolerance()};
  numbers["import_origin"] = {frames.builder().bed().origin};
  numbers["import_units"] = {units.length, units.time, units.mass};
  const auto& bed = frames.builder().bed();
  if (bed.has_new_ids) numbers["import_ids"] = {bed.known.id.begin(), bed.known.id.end()};

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
  texts["import_cell"] = frames.builder().bed().cell;
  texts["import_columns"] = frames.archive().columns();
  if (run.box.periodic_x || run.box.periodic_z)
    texts["import_images"] = frames.builder().counts_periods() ? "known" : "unknown";
  if (!facts.walls.empty()) texts["import_walls"] = fmt::format("{}", fmt::join(facts.walls, ", "));
  if (settings.interval) numbers["import_frame_interval"] = {*settings.interval * units.time};
  if (settings.begin) texts["import_begin"] = *settings.begin;
  if (settings.end) texts["import_end"] = *settings.end;
  if (settings.repeated) texts["import_repeated"] = *settings.repeated;
  texts["import_instant"] =
      "positions, velocities and forces are those of the archive at `time`, not of the middle of a "
      "step";
  add_check_parameters(run.parameters, frames, settings);
  return run;
}

/// All files that an import reads.
std::vector<std::string> inputs_of(const ArchiveFiles& files)
{
  std::vector<std::string> names{files.restart};
  for (const auto* some : {&files.grains, &files.contacts, &files.wall_contacts})
    names.insert(names.end(), some->begin(), some->end());
  return files_meant(names);
}

Vec3 gravity_in_archive(const RunFacts& facts)
{
  Vec3 gravity;
  for (Eigen::Index axis = 0; axis < 3; ++axis)
    gravity[axis] =
        facts.orientation.gravity.dot(facts.orientation.axes.components<3>(Vec3::Unit(axis)));
  return gravity;
}

template <int D>
[[noreturn]] void refuse(const VerifiedFrames<D>& frames, const Judgement& judgement)
{
  const auto& complaint = *frames.complaint();
  const auto fit = complaint.of_columns
                       ? frames.archive().fitting_columns(gravity_in_archive(frames.facts()))
                       : std::nullopt;
  const auto fitting =
      fit ? fmt::format("; with --columns {} they balance to {:.2g}", fit->columns, fit->residual)
          : std::string();
  const auto others = fitting.empty() && !complaint.spoils_gravity
                          ? judgement.also_failed(in_si(frames.moment(), frames.facts().units))
                          : std::string();
  const bool offer = fitting.empty() && complaint.check == "balance";
  throw CheckError(
      fmt::format("{}: {}{}{}{}", frames.place(), complaint.sentence, fitting, others,
                  offer ? "; --accept-residual balance=R imports what balances to R" : ""));
}

/// What is left out of the archive, and the like: complete once it has been read to its end.
template <int D>
std::vector<std::string> remarks_of(const VerifiedFrames<D>& frames)
{
  auto remarks = frames.remarks();
  if (const auto& roster = frames.roster())
    remarks.push_back(fmt::format("grains come and go: {} ids in all, between {} and {} present",
                                  roster->all.grains.size(), roster->fewest, roster->most));
  if (frames.builder().bed().has_new_ids)
    remarks.emplace_back(
        "ids beyond 2^31 are 1, 2, 3, ... in their order; /parameters/import_ids has those of the "
        "archive");
  if (frames.walls()) remarks.push_back(frames.walls()->remark());
  if (!frames.has_force())
    remarks.emplace_back("the archive has no forces on grains, and the trajectory none");
  if (!frames.has_angular_velocity())
    remarks.emplace_back("the archive has no angular velocities; they are written as 0");
  return remarks;
}

/// What the report says of a run before its first moment.
ImportReport report_of(const RunDescription& run)
{
  ImportReport report;
  report.dimension = run.box.dimension;
  report.grains = run.grains.size();
  report.tolerance = run.parameters.numbers.at("import_tolerance")[0];
  report.columns = run.parameters.text("import_columns");
  report.base = run.parameters.text("import_base");
  report.cell = run.parameters.text("import_cell");
  report.sizes = run.parameters.text("import_sizes");
  return report;
}

/// `frame` in SI.
template <int D>
void count(ImportReport& report, const Frame<D>& frame)
{
  if (report.frames == 0) report.first_time = frame.time;
  report.last_time = frame.time;
  ++report.frames;
  report.contacts += frame.contacts.size();
}

/// Of the moment that has just been read.
template <int D>
MomentRecord record_of(const VerifiedFrames<D>& frames)
{
  return {frames.residual(), in_si(frames.moment(), frames.facts().units)};
}

/// Verifies and writes all frames to the file `path`.
template <int D>
ImportReport write_frames(VerifiedFrames<D> frames, const ImportSettings& settings,
                          const std::string& command_line, const std::string& path)
{
  const auto run = describe(frames, settings, command_line);
  auto report = report_of(run);
  report.tolerance_reason = frames.archive().facts().tolerance_reason;
  TrajectoryWriter writer(path, run, settings.storage);
  Closing closing(run);
  ProgressBar progress(program, {.things = "moments"}, settings.quiet);
  for (Frame<D> frame; frames.next(frame);) {
    stop_if_interrupted();
    if (frames.complaint()) refuse(frames, closing.judgement());
    frames.facts().units.convert(frame);
    count(report, frame);
    const auto record = record_of(frames);
    closing.add(record, frames.place());
    writer.append(frame, import_values(record));
    progress.show(static_cast<double>(report.frames));
  }
  report.columns = frames.archive().columns();
  report.remarks = remarks_of(frames);
  writer.add_parameters(closing.close(report, settings.strict));
  writer.close();
  if (frames.walls())
    for (auto& count : frames.walls()->counts()) report.remarks.push_back(std::move(count));
  return report;
}

/// The same of a part, whose moments are only judged one by one.
template <int D>
ImportReport write_part(VerifiedFrames<D> frames, PartPlace place, const ImportSettings& settings,
                        const std::string& command_line, const std::string& path)
{
  auto run = describe(frames, settings, command_line);
  const Judgement judgement(run);
  const auto more = part_observables();
  run.observables.insert(run.observables.end(), more.begin(), more.end());
  auto report = report_of(run);
  TrajectoryWriter writer(path, run, settings.storage);
  Frame<D> frame;
  if (place.begin > 0) {  // what is verified with velocities needs the moment before
    frames.skip(place.begin - 1);
    frames.next(frame);
  }
  ProgressBar progress(program,
                       {.things = "moments", .total = static_cast<double>(place.end - place.begin)},
                       settings.quiet);
  for (auto left = place.end - place.begin; left > 0 && frames.next(frame); --left) {
    stop_if_interrupted();
    if (frames.complaint()) refuse(frames, judgement);
    frames.facts().units.convert(frame);
    count(report, frame);
    const auto record = record_of(frames);
    auto values = import_values(record);
    const auto of_part = part_values(record);
    values.insert(values.end(), of_part.begin(), of_part.end());
    writer.append(frame, values);
    progress.show(static_cast<double>(report.frames));
  }
  if (report.frames != place.end - place.begin ||
      (place.part.number == place.part.count && frames.next(frame)))
    throw RunError(fmt::format("{}: the archive changes while it is read", frames.place()));
  place.tolerance_reason = frames.archive().facts().tolerance_reason;
  place.columns = frames.archive().columns();
  place.remarks = remarks_of(frames);
  writer.add_parameters(place.parameters());
  writer.close();
  report.remarks.push_back(
      fmt::format("part {}: moments {} to {} of {}; checks of all moments are "
                  "made when parts are joined",
                  place.part.text(), place.begin + 1, place.end, place.moments));
  return report;
}

ImportReport import_whole(const ImportSettings& settings, const std::string& command_line)
{
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

/// Each part reads the grains of all moments first: how many moments there are, and whether grains
/// come and go.
ImportReport import_part(const ImportSettings& settings, const std::string& command_line)
{
  const auto& part = *settings.parts.part;
  Output output(part.path(settings.output, fs::path(settings.output).extension().string()),
                settings.overwrite, inputs_of(settings.files));
  const auto write = [&](OpenedArchive opened, std::size_t moments) {
    const auto range = part.range(moments);
    return with_dimension(opened.facts.dimension, [&](auto d) {
      return write_part(VerifiedFrames<d>(std::move(opened), settings),
                        {part, range.first, range.second, moments, {}, {}, {}}, settings,
                        command_line, output.temporary());
    });
  };
  auto opened = open_with_grains(settings);
  const auto roster =
      opened.roster() ? opened.roster() : std::make_shared<const Roster>(read_roster(settings));
  const bool is_complete = opened.roster() || !roster->grains_change();
  auto report =
      write(is_complete ? std::move(opened) : open_with_roster(settings), roster->moments);
  output.publish();
  return report;
}

/// FormatError unless the part continues what the parts before it hold.
void require_next_part(const ImportPart& first, const ImportPart& part, std::size_t begin,
                       const std::string& command_line)
{
  const auto& ours = part.run().parameters().text("command_line");
  if (ours != command_line)
    part.fail(fmt::format("is a part of another import, by '{}'", printable(ours)));
  if (static_digest(part.description()) != static_digest(first.description()) ||
      part.place().moments != first.place().moments || part.place().begin != begin)
    part.fail("is a part of another archive");
}

template <int D>
void append_part(TrajectoryWriter& writer, const ImportPart& part, Closing& closing,
                 ImportReport& report, ProgressBar& progress)
{
  Frame<D> frame;
  for (std::size_t k = 0; k < part.run().size(); ++k) {
    stop_if_interrupted();
    part.run().read(k, frame, {.velocity = true, .contacts = true, .force = true});
    count(report, frame);
    const auto record = part.record(k);
    closing.add(record, fmt::format("{}, frame {}", part.run().path(), k));
    writer.append(frame, import_values(record));
    progress.show(static_cast<double>(report.frames));
  }
}

ImportReport join_parts(const ImportSettings& settings, const std::string& command_line)
{
  const std::size_t parts = settings.parts.join;
  const ImportPart first(settings.output, {1, parts});
  auto inputs = inputs_of(settings.files);
  inputs.push_back(first.run().path());
  Output output(settings.output, settings.overwrite, inputs);
  const auto run = first.description();
  auto report = report_of(run);
  TrajectoryWriter writer(output.temporary(), run, settings.storage);
  Closing closing(run);
  ProgressBar progress(program,
                       {.things = "moments", .total = static_cast<double>(first.place().moments)},
                       settings.quiet);
  for (std::size_t k = 1; k <= parts; ++k) {
    const ImportPart part(settings.output, {k, parts});
    require_next_part(first, part, report.frames, command_line);
    with_dimension(run.box.dimension,
                   [&](auto d) { append_part<d>(writer, part, closing, report, progress); });
    report.columns = part.place().columns;
    report.remarks = part.place().remarks;
    report.tolerance_reason = part.place().tolerance_reason;
  }
  if (report.frames != first.place().moments) first.fail("is a part of another archive");
  writer.add_parameters(closing.close(report, settings.strict));
  writer.close();
  output.publish();
  return report;
}

}  // namespace

ImportReport import_archive(const ImportSettings& settings, const std::string& command_line)
{
  if (settings.output.empty()) open_with_grains(settings);  // asks for it
  settings.parts.check(settings.output);
  if (settings.parts.part) return import_part(settings, command_line);
  if (settings.parts.join > 0) return join_parts(settings, command_line);
  return import_whole(settings, command_line);
}

std::string to_text(const ImportReport& report)
{
  std::string text =
      fmt::format("{} frames from {:g} to {:g} s, {} grains, {} contacts{}\n", report.frames,
                  report.first_time, report.last_time, report.grains, report.contacts,
                  report.dimension == 3 ? ", in three dimensions" : "");
  if (!report.columns.empty()) text += fmt::format("columns: {}\n", report.columns);
  text += fmt::format("base: {}; {}\n", report.base, report.sizes);
  std::istringstream cell(report.cell);
  for (std::string line; std::getline(cell, line);) text += fmt::format("cell: {}\n", line);
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
