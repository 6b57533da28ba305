// SPDX-License-Identifier: GPL-3.0-or-later
#include "sim/run/run.hpp"

#include "formats/cli/interruption.hpp"
#include "formats/cli/progress.hpp"
#include "formats/core/errors.hpp"
#include "formats/core/files.hpp"
#include "sim/run/earlier_run.hpp"
#include "sim/run/expected_cost.hpp"
#include "sim/run/recorder.hpp"
#include "sim/run/run_files.hpp"
#include "sim/run/summary.hpp"
#include "sim/scene/deposition.hpp"
#include "sim/scene/geometry.hpp"
#include "sim/scene/keys/keys.hpp"

#include <fmt/format.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <limits>

namespace grseg {
namespace {

constexpr const char* program = "grseg-sim";

/// Time of a monotonic clock, s.
double seconds_now()
{
  using namespace std::chrono;
  return duration<double>(steady_clock::now().time_since_epoch()).count();
}

/// A simulation that is ready to run, and the file of its frames.
template <int D>
struct Run {
  Simulation<D> simulation;
  TrajectoryWriter writer;
  TrajectoryProgress progress;
  double deposited_height;  // m, height of the deposited bed
  std::string history;
};

/// Settings without compression, which happens when the run is finished (formats/README.md).
StorageSettings storage_while_running(const Scene& scene)
{
  return {.float32 = scene.float32, .live = true};
}

template <int D>
TrajectoryWriter new_trajectory(const Scene& scene, const Simulation<D>& simulation,
                                Parameters parameters, const std::string& part)
{
  add_unknown_summary(parameters);
  return {part,
          {simulation.world().grains, simulation.world().box, parameters, Recorder::observables(D)},
          storage_while_running(scene)};
}

/// Writes checkpoints of `run` when they are due.
template <int D>
struct Checkpoints {
  const Scene& scene;
  const RunOptions& options;
  Run<D>& run;
  const Recorder& recorder;
  double begin = seconds_now();
  double last = -std::numeric_limits<double>::infinity();

  void write_if_due()
  {
    if (seconds_now() - last >= options.checkpoint_every) write();
  }
  void write()
  {
    if (options.checkpoint.empty()) return;
    last = seconds_now();
    // The frames that a checkpoint counts must be on the disk before the checkpoint.
    run.writer.flush();
    flush_to_disk(part_of(options.output));
    const auto& world = run.simulation.world();
    write_checkpoint(options.checkpoint,
                     Checkpoint<D>{{to_text(scene),
                                    program_of_run(),
                                    run.history,
                                    world.grains,
                                    world.box,
                                    run.deposited_height,
                                    {run.writer.frames(), run.writer.digest(), recorder.state(),
                                     run.progress.begin, run.progress.wall + last - begin}},
                                   world.walls,
                                   run.simulation.state()});
  }
};

/// Writes frames and checkpoints until the end or a signal. Checkpoints are written just before a
/// frame, so that a restart may change the step; after a signal, a checkpoint is written at once.
/// Returns the motion a second before the end, or at the beginning if that was later.
template <int D>
MeanMotion flow(const Scene& scene, Simulation<D>& simulation, Recorder& recorder,
                Checkpoints<D>& checkpoints, ProgressBar& progress)
{
  const auto every = scene.steps_per_frame(), end = scene.steps_in_all();
  const auto of_a_second = std::llround(1 / scene.step);
  auto earlier = motion_of(simulation);
  Frame<D> frame;
  while (simulation.steps_done() < end && !interrupted()) {
    if (simulation.steps_done() == end - of_a_second) earlier = motion_of(simulation);
    const auto since_due = simulation.steps_done() % every;
    const bool due = since_due < scene.burst;
    if (since_due == 0) checkpoints.write_if_due();
    recorder.add(due ? simulation.advance(frame) : simulation.advance());
    if (!due) continue;
    recorder.write(frame, simulation);
    progress.show(simulation.time());
  }
  checkpoints.write();
  return earlier;
}

/// Exception for a run that a signal stops.
Interruption stopped_at(double time, const RunOptions& options)
{
  const auto continuation =
      options.checkpoint.empty() ? "" : fmt::format(", --restart {} continues", options.checkpoint);
  return interruption(fmt::format("interrupted at t = {:.6g} s; the frames so far are in {}{}",
                                  time, part_of(options.output), continuation));
}

/// Throws CheckError if the solver missed its tolerance or an overlap was too large.
void refuse_errors(const StepTotals& totals, double small_diameter)
{
  if (totals.missed > 0)
    throw CheckError(fmt::format(
        "the solver missed its tolerance in {} of {} steps; choose a larger --max-sweeps or a "
        "smaller --step",
        totals.missed, totals.steps));
  if (totals.passed_into(small_diameter))
    throw CheckError(fmt::format(
        "a grain overlapped another one or a wall by {:.2g} d_S, more than {}; choose a larger "
        "--min-sweeps or a smaller --step",
        totals.largest_overlap / small_diameter, deep_overlap));
}

/// Runs `run` to its end, prints the summary and renames the trajectory to its final name.
template <int D>
void finish(const Scene& scene, const RunOptions& options, Run<D>& run)
{
  auto& simulation = run.simulation;
  Recorder recorder(run.writer, scene.small_diameter, run.progress.recorder);
  Checkpoints<D> checkpoints{scene, options, run, recorder};
  ProgressBar progress(
      program,
      {.things = "s of flow", .total = scene.duration, .from = simulation.time(), .digits = 2},
      options.quiet);
  const double begin = seconds_now(), from = simulation.time();
  const auto earlier = flow(scene, simulation, recorder, checkpoints, progress);
  progress.clear();
  const RunSummary summary{simulation.time() - from,
                           simulation.time(),
                           seconds_now() - begin,
                           from - run.progress.begin,
                           run.progress.wall,
                           run.deposited_height,
                           recorder.totals(),
                           stiffness_of(scene, recorder.totals()),
                           end_of_flow(simulation, scene, earlier)};
  run.writer.add_parameters(to_parameters(summary));
  run.writer.close();
  if (!options.quiet) tell(to_text(summary, scene, simulation.world().grains));
  if (interrupted()) throw stopped_at(simulation.time(), options);
  publish_trajectory(options.output, options.overwrite,
                     {.compression = scene.compression, .float32 = scene.float32});
  if (!options.quiet) tell(next_steps(options.output, scene));
  if (options.strict) refuse_errors(recorder.totals(), scene.small_diameter);
}

/// From now on signals end the run with a checkpoint, except for a closed pipe, which is ignored.
void listen()
{
  listen_to_signals();
  std::signal(SIGPIPE, SIG_IGN);
}

/// Shows how far a deposition is, and ends it on a signal.
class DepositionProgress {
 public:
  /// `purpose`: "" or what the deposition is for, such as ", repeated for --keep-deposition".
  DepositionProgress(const Scene& scene, const RunOptions& options, std::string purpose)
      : total_(expected_time_to_rest(scene)),
        purpose_(std::move(purpose)),
        bar_(program, work(), options.quiet)
  {
    bar_.say("depositing the bed" + purpose_);
  }

  /// Called after each step. The time begins at 0 in each attempt; it is negative while the
  /// accepted one is recorded.
  void step_to(double time)
  {
    if (interrupted()) throw interruption("interrupted during the deposition of the bed");
    if (time <= 0) return;
    if (time < last_) {
      ++attempt_;
      bar_.begin(work());
    }
    last_ = time;
    bar_.show(time);
  }

 private:
  Work work() const
  {
    return {.things = fmt::format("s of deposition{}{}", purpose_,
                                  attempt_ == 1 ? "" : fmt::format(", attempt {}", attempt_)),
            .total = total_,
            .digits = 2};
  }

  double total_, last_ = 0;
  int attempt_ = 1;  // at a bed of the depth asked for
  std::string purpose_;
  ProgressBar bar_;
};

template <int D>
void record_deposition(const Scene& scene, const RunOptions& options, TrajectoryWriter& writer)
{
  DepositionProgress progress(scene, options, " for --keep-deposition");
  Recorder recorder(writer, scene.small_diameter);
  const auto record = [&](const StepReport& report, const Simulation<D>& now,
                          const Frame<D>* frame) {
    recorder.add(report);
    if (frame != nullptr) recorder.write(*frame, now);
  };
  deposit<D>(
      scene,
      {.each_step = [&](double time) { progress.step_to(time); }, .slowed = {}, .record = record});
}

/// Prints the expected cost of the run from `begin`, s, on, with `kept` bytes of earlier frames.
/// Throws UsageError if it is too large.
void announce(const Scene& scene, double begin, const RunOptions& options, double kept = 0)
{
  auto cost = expected_cost(scene, begin);
  cost.disk += kept;  // copied before the run goes on, or packed with the others when it ends
  if (!options.quiet) tell(fmt::format("grseg-sim: {}\n", to_text(cost)));
  if (!options.force) require_room(cost, options.output);
}

/// Remarks on a deposition, for the user.
struct DepositionRemarks {
  double lasted = 0;       // s, duration of the last attempt
  double slowed_from = 0;  // s, time from which its grains were slowed down; 0: they were not
  bool layered = false;    // mixed grains fell in layers of one species

  /// Called after each step; the time begins at 0 in each attempt.
  void step_to(double time)
  {
    if (time < lasted) slowed_from = 0;
    lasted = time;
  }

  void add_to(Parameters& parameters) const
  {
    if (slowed_from > 0) parameters.numbers["deposition_slowed_from"] = {slowed_from - lasted};
  }

  std::string text() const
  {
    std::string lines;
    if (layered)
      lines +=
          "remark     mixed grains had too little room to fall; they fell in layers of one species "
          "in random order\n";
    if (slowed_from > 0)
      lines += fmt::format(
          "remark     the bed had not come to rest after {:.3g} s of deposition; its grains were "
          "slowed down\n",
          slowed_from);
    return lines;
  }
};

template <int D>
Simulation<D> deposit_visibly(const Scene& scene, const RunOptions& options,
                              DepositionRemarks& remarks)
{
  DepositionProgress progress(scene, options, "");
  const auto step = [&](double time) {
    progress.step_to(time);
    remarks.step_to(time);
  };
  const auto slowed = [&](double time) {
    if (remarks.slowed_from == 0) remarks.slowed_from = time;
  };
  const auto layered = [&] { remarks.layered = true; };
  return deposit<D>(scene, {.each_step = step, .slowed = slowed, .record = {}, .layered = layered});
}

/// The output, where it is a link the file to which it leads: its disk has room for the temporary
/// files. Throws UsageError if there is no such file and the link may not be followed.
std::string followed(const RunOptions& options)
{
  refuse_input_as_output(options.output, {options.scene_file, options.restart});
  auto target = behind_links(options.output);
  if (!is_taken(target)) check_output(options.output, options.overwrite, {});
  return target;
}

template <int D>
void simulate_in(const Scene& scene, const RunOptions& options)
{
  const auto part = part_of(options.output);
  require_no_output(options);
  check_outputs(options);
  const RunLocks locks(options);
  const bool again = begins_again(scene, options);
  require_writable(part);
  const RemoveAtEnd clean_up(part, RemoveAtEnd::If::empty);
  listen();

  if (again && !options.quiet)
    tell(fmt::format("grseg-sim: begins again, because {} has no frame of the flow\n", part));
  announce(scene, 0, options);
  DepositionRemarks remarks;
  const auto deposited = deposit_visibly<D>(scene, options, remarks);
  const auto simulation = release(deposited, scene);
  auto parameters = provenance(scene, options);
  remarks.add_to(parameters);
  Run<D> run{simulation,
             new_trajectory(scene, simulation, parameters, part),
             {},
             bed_height(deposited, scene.geometry->boundaries(scene).top),
             options.command_line};
  if (scene.keep_deposition) record_deposition<D>(scene, options, run.writer);
  finish(scene, options, run);
  if (!options.quiet) tell(remarks.text());
}

template <int D>
void resume_in(const Checkpoint<D>& checkpoint, const Scene& given, RunOptions options)
{
  options.output = followed(options);
  const auto part = part_of(options.output);
  const auto before = scene_of(checkpoint.scene, options.restart);
  const auto scene = without_round_off(given, before);
  if (options.continues) require_same_run(before, scene, options);
  require_same_bed(before, scene);
  const bool perturbed = options.perturbation.size > 0;
  const bool unchanged = !perturbed && to_text(scene) == to_text(before);
  const bool same_run = unchanged || (options.continues && same_steps(before, scene));
  // A finished run may be replaced by its prolongation, which contains all of its frames.
  const bool is_begun = options.continues && same_run && begins_the_run(options.output, checkpoint);
  options.overwrite = options.overwrite || is_begun;
  check_outputs(options);
  const RunLocks locks(options);
  const bool has_part = is_continued(part, checkpoint);
  const bool in_place = same_run && (has_part || is_begun);
  auto simulation = restored_simulation<D>(checkpoint, before, scene, options.perturbation);
  if (!(in_place && unchanged) && simulation.steps_done() >= scene.steps_in_all())
    throw UsageError(
        fmt::format("{} is at t = {:g} s, and the run ends at {:g} s; choose a larger --duration",
                    options.restart, simulation.time(), scene.duration));
  if (!in_place) begins_again(scene, options);
  require_writable(part);
  const RemoveAtEnd clean_up(part, RemoveAtEnd::If::empty);
  listen();
  if (!options.quiet)
    tell(fmt::format("grseg-sim: continues {} from t = {:g} s\n", options.restart,
                     simulation.time()));
  std::error_code none;
  const auto kept =
      in_place ? std::filesystem::file_size(has_part ? part : options.output, none) : 0;
  announce(scene, simulation.time(), options, none ? 0 : static_cast<double>(kept));

  const auto history = fmt::format("{}\n{} (from t = {:g} s)", checkpoint.history,
                                   options.command_line, simulation.time());
  TrajectoryProgress progress;
  progress.begin = simulation.time();
  if (!perturbed && same_steps(before, scene))
    progress.recorder.since_frame = checkpoint.trajectory.recorder.since_frame;
  if (in_place) progress = checkpoint.trajectory;
  start_flow(simulation, scene);
  const auto parameters = provenance_of_restart(scene, options, simulation.time(), history);
  Run<D> run{simulation,
             in_place ? truncate_to_checkpoint(
                            {has_part ? part : options.output, part, to_text(scene), history},
                            checkpoint, options.restart, storage_while_running(scene))
                      : new_trajectory(scene, simulation, parameters, part),
             progress, checkpoint.deposited_height, history};
  finish(scene, options, run);
}

}  // namespace

void simulate(const Scene& scene, const RunOptions& given)
{
  auto options = given;
  options.output = followed(given);
  with_dimension(scene.dimension, [&](auto d) { simulate_in<d>(scene, options); });
}

void resume(const AnyCheckpoint& checkpoint, const Scene& given, const RunOptions& options)
{
  std::visit([&](const auto& of_dimension) { resume_in(of_dimension, given, options); },
             checkpoint);
}

}  // namespace grseg
