// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/import/convert/importer.hpp"

#include "formats/cli/interruption.hpp"
#include "formats/cli/output.hpp"
#include "formats/cli/progress.hpp"
#include "formats/cli/tool.hpp"
#include "formats/cli/words.hpp"
#include "formats/core/frame.hpp"
#include "formats/core/text.hpp"
#include "formats/core/version.hpp"
#include "formats/import/common/archive_files.hpp"
#include "formats/import/common/frame_tools.hpp"
#include "formats/import/common/text_values.hpp"
#include "formats/import/convert/judgement.hpp"
#include "formats/import/convert/verified_frames.hpp"
#include "formats/trajectory/run_description.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace grseg {
namespace {

constexpr const char* program = "grseg-import";

/// Mean of the smallest and the largest diameter of a species; 0 if it has no grains.
double mid_range(const Grains& grains, Species species)
{
  Range diameters;
  for (std::size_t g = 0; g < grains.size(); ++g)
    if (grains.species[g] == species) diameters.add(2 * grains.radius[g]);
  return diameters.high > 0 ? diameters.middle() : 0;
}

/// Adds nominal diameters, m, to the species. Of two, one without grains gets the other's diameter.
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

/// Facts of the run for its checks: what it is, and who states it.
CheckContext context_of(const RunDescription& run, const VerifiedFrames& frames,
                        const ImportSettings& settings)
{
  const auto& archive = frames.archive().facts();
  const auto& facts = frames.facts();
  const auto& frame = frames.scanned().frame;
  const auto& mass = frames.scanned().all_grains().grains.mass;
  const bool has_masses = !mass.empty() && std::all_of(mass.begin(), mass.end(), [](double m) {
    return std::isfinite(m) && m > 0;
  });
  CheckContext context;
  context.dimension = run.box.dimension;
  context.has_force = run.has_force;
  const auto& gravity = run.parameters.numbers.at("gravity");
  std::copy(gravity.begin(), gravity.end(), context.gravity.begin());
  for (Eigen::Index k = 0; k < 3; ++k)
    for (int axis = 0; axis < 3; ++axis)
      context.axes[static_cast<std::size_t>(k)][axis] =
          frames.bed().axes.components(Vec3::Unit(axis))[k];
  context.units = facts.units;
  context.step = facts.step * facts.units.time;
  context.frame_interval = settings.interval.value_or(0) * facts.units.time;
  context.gravity_is_given = !archive.gravity || settings.gravity;
  context.masses_are_given = !archive.density && !has_masses;
  context.doubt_of_masses = facts.doubt_of_masses;
  context.step_is_given = !archive.step && facts.knows_step;
  context.times_are_own = frame.time.has_value();
  context.steps_are_own = !frame.time || frame.step;
  context.tolerance = archive.tolerance;
  context.reason = archive.tolerance_reason;
  const auto& [small, large] = std::pair(settings.species.small, settings.species.large);
  context.species =
      species_sizes(run.grains, species_of(run),
                    small || large ? small.value_or("") + "\n" + large.value_or("") : "");
  context.size_ratio = ratio_of_sizes(run.grains);
  context.waivers = frames.waivers();
  return context;
}

/// Description of the run, in SI, as far as it is known before its first frame.
RunDescription describe(const VerifiedFrames& frames, const ImportSettings& settings,
                        const std::string& command_line)
{
  const auto& facts = frames.facts();
  const auto& units = facts.units;
  const auto& bed = frames.bed();
  RunDescription run;
  run.grains = bed.grains;
  units.convert(run.grains);
  run.box = bed.box;
  for (auto* length :
       {&run.box.length_x, &run.box.length_y, &run.box.length_z, &run.box.low_x, &run.box.low_z})
    *length *= units.length;
  run.has_force = bed.has_force;
  run.grains_come_and_go = bed.grains_come_and_go;
  auto& numbers = run.parameters.numbers;
  const Vec3 gravity = bed.gravity * units.acceleration();
  numbers["gravity"] = {gravity.begin(), gravity.begin() + bed.box.dimension};
  numbers["slope"] = {std::atan2(gravity.x(), -gravity.y()) * 180 / std::numbers::pi};
  numbers["step"] = {facts.step * units.time};
  numbers["density"] = {
      with_dimension(facts.dimension, [&](auto d) { return mean_density<d>(run.grains); })};
  run.species = with_diameters(bed.species.list, run.grains, units);
  numbers["small_diameter"] = {run.species.front().diameter};
  numbers["large_diameter"] = {run.species.back().diameter};
  numbers["import_tolerance"] = {
      frames.waivers().limit("balance", frames.archive().facts().tolerance)};
  numbers["import_origin"] = {bed.origin};
  if (run.box.low_x != 0 || run.box.low_z != 0)
    numbers["import_low"] = {run.box.low_x, run.box.low_z};
  numbers["import_units"] = {units.length, units.time, units.mass};
  if (bed.has_new_ids) numbers["import_ids"] = {bed.known.id.begin(), bed.known.id.end()};
  if (settings.interval) numbers["import_frame_interval"] = {*settings.interval * units.time};
  auto& texts = run.parameters.texts;
  texts["program"] = "grseg-import " + version_with_hash();
  texts["command_line"] = command_line;
  texts["history"] = command_line;
  texts["origin"] = settings.origin;
  texts["import_format"] = settings.format;
  texts["import_axes"] = facts.axes;
  texts["import_units_as_told"] = facts.units_as_given;
  texts["import_grains"] = facts.discs ? "discs" : "spheres";
  texts["import_base"] = bed.species.base;
  texts["import_sizes"] = bed.species.sizes;
  texts["import_cell"] = bed.cell;
  texts["import_coordinates"] = bed.coordinates() + " of the archive, in its units";
  texts["import_columns"] = frames.archive().columns();
  if (run.box.periodic_x || run.box.periodic_z)
    texts["import_images"] = bed.counts_periods ? "known" : "unknown";
  if (!facts.walls.empty()) texts["import_walls"] = fmt::format("{}", fmt::join(facts.walls, ", "));
  if (settings.begin) texts["import_begin"] = *settings.begin;
  if (settings.end) texts["import_end"] = *settings.end;
  if (settings.repeated) texts["import_repeated"] = *settings.repeated;
  texts["import_instant"] =
      frames.archive().facts().at_detection
          ? "positions are those at which the contacts of the step were found, velocities those of "
            "its end"
          : "positions, velocities and forces are those of the archive at `time`, not of the middle "
            "of a step";
  texts["import_tolerance_reason"] = frames.archive().facts().tolerance_reason;
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
        facts.orientation.gravity.dot(facts.orientation.axes.components(Vec3::Unit(axis)));
  return gravity;
}

[[noreturn]] void refuse(const VerifiedFrames& frames, const Judgement& judgement)
{
  const auto& complaint = *frames.complaint();
  const auto fit = complaint.of_columns
                       ? frames.archive().fitting_columns(gravity_in_archive(frames.facts()))
                       : std::nullopt;
  const auto fitting =
      fit ? fmt::format("; with --columns {} they balance to {:.2g}", fit->columns, fit->residual)
          : std::string();
  const auto others = fitting.empty() && !complaint.spoils_gravity
                          ? judgement.also_failed(in_si(frames.numbers(), frames.facts().units))
                          : std::string();
  const bool offer = fitting.empty() && complaint.check == "balance";
  throw CheckError(fmt::format(
      "{}: {}{}{}{}{}", frames.place(), complaint.sentence, frames.scanned().about_digits(),
      fitting, others, offer ? "; --accept-residual balance=R accepts residuals up to R" : ""));
}

/// Sentences about all data of the archive that are left out or changed. Complete once the archive
/// has been read to its end.
std::vector<std::string> remarks_of(const VerifiedFrames& frames)
{
  auto remarks = frames.scanned().remarks();
  if (frames.bed().has_new_ids)
    remarks.emplace_back(
        "ids beyond 2^31 are numbered 1, 2, 3, ... in their order; /parameters/import_ids has the "
        "archive's ids");
  if (frames.walls())
    for (auto& remark : frames.walls()->remarks()) remarks.push_back(std::move(remark));
  if (!frames.bed().has_force)
    remarks.emplace_back("the archive has no forces on grains; the trajectory has none either");
  if (!frames.bed().has_angular_velocity)
    remarks.emplace_back("the archive has no angular velocities; they are written as 0");
  return remarks;
}

/// Counts a frame in the report; `time` in s.
void count(ImportReport& report, double time, std::size_t contacts)
{
  if (report.frames == 0) report.first_time = time;
  report.last_time = time;
  ++report.frames;
  report.contacts += contacts;
}

/// Copies the components of a frame in the plane of the flow.
void flatten(const Frame<3>& from, Frame<2>& to)
{
  const auto take = [](const std::vector<Vec3>& vectors, std::vector<Vec2>& flat) {
    flat.clear();
    for (const auto& vector : vectors) flat.emplace_back(vector.head<2>());
  };
  to.step = from.step;
  to.time = from.time;
  take(from.position, to.position);
  take(from.velocity, to.velocity);
  take(from.force, to.force);
  to.image.clear();
  for (const auto& image : from.image) to.image.push_back({image[0], image[1]});
  to.angular_velocity.clear();
  for (const auto& spin : from.angular_velocity) to.angular_velocity.push_back(spin.z());
  const auto& contacts = from.contacts;
  to.contacts.i = contacts.i;
  to.contacts.j = contacts.j;
  to.contacts.gap = contacts.gap;
  take(contacts.force, to.contacts.force);
  take(contacts.branch, to.contacts.branch);
}

/// The observables of an imported run, and their values in a frame.
std::vector<Observable> import_observables()
{
  auto all = check_observables();
  all.insert(all.begin(), {"momentum_defect", ""});
  return all;
}
std::vector<double> import_values(const FrameRecord& record)
{
  auto values = check_values(record.numbers);
  values.insert(values.begin(), record.residual ? record.residual->largest : 0);
  return values;
}

/// Verifies all frames and writes them to the file `path`.
ImportReport convert(VerifiedFrames frames, const ImportSettings& settings,
                     const std::string& command_line, const std::string& path)
{
  auto run = describe(frames, settings, command_line);
  ImportReport report{run.box.dimension, 0, run.grains.size(), 0, 0, 0, run.parameters, {}, {}};
  Judgement judgement(run, context_of(run, frames, settings));
  run.observables = import_observables();
  TrajectoryWriter writer(path, run, settings.storage);
  ProgressBar progress(program, {.things = "frames"}, settings.quiet);
  Frame<3> frame;
  Frame<2> flat;
  while (frames.next(frame)) {
    stop_if_interrupted();
    if (frames.complaint()) refuse(frames, judgement);
    frames.facts().units.convert(frame);
    count(report, frame.time, frame.contacts.size());
    const FrameRecord record{frames.residual(), in_si(frames.numbers(), frames.facts().units)};
    const auto values = import_values(record);
    judgement.add(record, frames.place());
    if (run.box.dimension == 2) flatten(frame, flat);
    run.box.dimension == 2 ? writer.append(flat, values) : writer.append(frame, values);
    progress.show(static_cast<double>(report.frames));
  }
  report.parameters.texts["import_columns"] = frames.archive().columns();
  report.remarks = remarks_of(frames);
  writer.add_parameters(judgement.close(report, settings.strict));
  writer.close();
  return report;
}

}  // namespace

ImportReport import_archive(const ImportSettings& settings, const std::string& command_line)
{
  if (settings.output.empty()) scan(settings);  // throws the question for the output file
  Output output(settings.output, settings.overwrite, inputs_of(settings.files));
  const auto run = [&](Scan how_far) {
    return convert(VerifiedFrames(scan(settings, how_far), settings), settings, command_line,
                   output.temporary());
  };
  ImportReport report;
  try {
    report = run(Scan::first_frames);
  } catch (const OtherGrains&) {  // a frame has other grains: start with a scan of all frames
    report = run(Scan::all_frames);
  }
  output.publish();
  return report;
}

std::string to_text(const ImportReport& report)
{
  std::string text = fmt::format(
      "{} from {:g} to {:g} s, {}, {}{}\n", counted(report.frames, "frame"), report.first_time,
      report.last_time, counted(report.grains, "grain"), counted(report.contacts, "contact"),
      report.dimension == 3 ? ", in three dimensions" : "");
  const auto& parameters = report.parameters;
  const auto number = [&](const char* name) { return parameters.find_number(name); };
  const auto columns = parameters.text("import_columns");
  if (!columns.empty()) text += fmt::format("columns: {}\n", columns);
  text += fmt::format("base: {}; {}\n", parameters.text("import_base"),
                      parameters.text("import_sizes"));
  for (const auto& line : parts_of(parameters.text("import_cell"), '\n'))
    text += fmt::format("cell: {}\n", line);
  text += fmt::format("coordinates: {}\n", parameters.text("import_coordinates"));
  const auto largest = number("import_residual_largest");
  if (largest)
    text +=
        fmt::format("grains balance: largest residual {:.3g}, median {:.3g} of the largest force\n",
                    *largest, *number("import_residual_median"));
  if (const auto unexplained = number("import_residual_unexplained")) {
    const auto& late = parameters.numbers.at("import_late_damping");
    text += fmt::format(
        "largest residual that damping half a step late does not explain: {:.3g}, "
        "with damping of {:.4g} 1/s (normal) and {:.4g} 1/s (tangential)\n",
        *unexplained, late[0], late[1]);
  }
  if (largest)
    text += fmt::format("tolerance {:g}: {}\n", *number("import_tolerance"),
                        parameters.text("import_tolerance_reason"));
  for (const auto& [check, verdict, sentence, measure] : report.findings)
    text += fmt::format("check {}: {} ({:.2g}): {}\n", check, to_text(verdict), measure, sentence);
  for (const auto& remark : report.remarks) text += remark + "\n";
  return text;
}

}  // namespace grseg
