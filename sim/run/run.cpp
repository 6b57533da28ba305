// SPDX-License-Identifier: GPL-3.0-or-later
#include "sim/run/run.hpp"

#include "formats/cli/interruption.hpp"
#include "formats/cli/tool.hpp"
#include "formats/core/errors.hpp"
#include "formats/core/files.hpp"
#include "formats/core/version.hpp"
#include "formats/trajectory/repack.hpp"
#include "sim/run/effects_report.hpp"
#include "sim/run/recorder.hpp"
#include "sim/run/summary.hpp"
#include "sim/run/truncate_to_checkpoint.hpp"
#include "sim/scene/boundaries.hpp"
#include "sim/scene/deposition.hpp"
#include "sim/solver/sweep.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <limits>

namespace grseg {
namespace {

double seconds_now()
{
  using namespace std::chrono;
  return duration<double>(steady_clock::now().time_since_epoch()).count();
}

/// Says on a terminal how far the run is.
class Progress {
 public:
  /// Of a run that goes from `from` to `duration`, s.
  Progress(double from, double duration, bool quiet)
      : from_(from), duration_(duration), shown_(!quiet && isatty(2) != 0)
  {
  }
  ~Progress() { clear(); }
  void clear() const
  {
    if (shown_) fmt::print(stderr, "\r\033[K");
  }
  void say(const std::string& words) const
  {
    if (shown_) fmt::print(stderr, "\r\033[K{}", words);
  }
  void at(double time)
  {
    const double now = seconds_now();
    if (!shown_ || now - last_ < 0.2) return;
    last_ = now;
    const double left = time > from_ ? (now - begin_) * (duration_ - time) / (time - from_) : 0;
    say(fmt::format("t = {:.2f} of {:g} s, {:.0f}:{:02.0f} left", time, duration_,
                    std::floor(left / 60), std::floor(std::fmod(left, 60))));
  }

 private:
  double from_, duration_;
  bool shown_;
  double begin_ = seconds_now(), last_ = 0;
};

Parameters describe(const Scene& scene, const RunOptions& options)
{
  auto parameters = to_parameters(scene);
  parameters.texts["program"] = "grseg-sim " + version_with_hash();
  parameters.texts["instruction_set"] = instruction_set();
  parameters.texts["command_line"] = options.command_line;
  parameters.texts["history"] = options.command_line;
  parameters.texts["effects_left_out"] = effects_left_out(scene);
  return parameters;
}

/// The finished run under its own name, compressed if that is asked for.
void publish(const std::string& part, const std::string& output, const StorageSettings& storage)
{
  std::string whole = part;
  if (storage.compression > 0) {
    whole = temporary_path(output);
    repack(part, whole, storage);
  }
  publish_file(whole, output);
  std::error_code ignored;
  if (whole != part) std::filesystem::remove(part, ignored);
}

/// Finds out before the bed is made, rather than after, that the file cannot be.
void require_writable(const std::string& path)
{
  const int file = open(path.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0666);
  if (file < 0) throw RunError(fmt::format("cannot create {}: {}", path, std::strerror(errno)));
  close(file);
}

/// A trajectory that nothing has been written to is not left behind.
class RemoveIfEmpty {
 public:
  explicit RemoveIfEmpty(std::string path) : path_(std::move(path)) {}
  RemoveIfEmpty(const RemoveIfEmpty&) = delete;
  RemoveIfEmpty& operator=(const RemoveIfEmpty&) = delete;
  ~RemoveIfEmpty()
  {
    std::error_code ignored;
    if (std::filesystem::file_size(path_, ignored) == 0) std::filesystem::remove(path_, ignored);
  }

 private:
  std::string path_;
};

/// What must hold before time is spent on a run.
void check_outputs(const RunOptions& options)
{
  refuse_to_overwrite(options.output, options.overwrite);
  if (options.checkpoint.empty()) return;
  if (options.checkpoint == options.output)
    throw UsageError("checkpoint and trajectory cannot be one file; name another for --checkpoint");
  if (options.checkpoint != options.restart)
    refuse_to_overwrite(options.checkpoint, options.overwrite);
  const RemoveIfEmpty trial(options.checkpoint + ".part");
  require_writable(options.checkpoint + ".part");
}

/// A run that is ready to go on, with the file that its frames go to.
struct Run {
  Simulation simulation;
  TrajectoryWriter writer;
  TrajectoryProgress progress;
  double deposited_height;  // m
  std::string history;
};

/// While a run goes on nothing is compressed (formats/README.md).
StorageSettings storage_while_running(const Scene& scene)
{
  return {.compression = 0, .float32 = scene.float32};
}

/// Writes checkpoints of `run` when they are due.
class Checkpoints {
 public:
  Checkpoints(const Scene& scene, const RunOptions& options, Run& run, const Recorder& recorder)
      : scene_(scene), options_(options), run_(run), recorder_(recorder)
  {
  }
  bool due() const
  {
    return !options_.checkpoint.empty() && seconds_now() - last_ >= options_.checkpoint_every;
  }
  /// The trajectory is on the disk before the checkpoint that counts its frames.
  void write()
  {
    last_ = seconds_now();
    run_.writer.flush();
    flush_to_disk(options_.output + ".part");
    const auto& world = run_.simulation.world();
    write_checkpoint(options_.checkpoint,
                     {to_text(scene_),
                      "grseg-sim " + version_with_hash(),
                      run_.history,
                      world.grains,
                      world.walls,
                      world.box,
                      run_.deposited_height,
                      run_.simulation.state(),
                      {run_.writer.frames(), run_.writer.digest(), recorder_.state(),
                       run_.progress.begin, run_.progress.wall + last_ - begin_}});
  }
  void write_if_asked_for()
  {
    if (!options_.checkpoint.empty()) write();
  }

 private:
  const Scene& scene_;
  const RunOptions& options_;
  Run& run_;
  const Recorder& recorder_;
  double begin_ = seconds_now();
  double last_ = -std::numeric_limits<double>::infinity();
};

/// Writes frames and checkpoints until the end or a signal. Checkpoints lie just before a frame, so
/// that a later run may go on with another step, but for that of a signal, which does not wait.
void flow(const Scene& scene, Simulation& simulation, Recorder& recorder, Checkpoints& checkpoints,
          Progress& progress)
{
  const auto every = scene.steps_per_frame(), end = scene.steps_in_all();
  Frame frame;
  while (simulation.steps_done() < end && !interrupted()) {
    const auto since_due = simulation.steps_done() % every;
    const bool due = since_due < scene.burst;
    if (since_due == 0 && checkpoints.due()) checkpoints.write();
    recorder.add(due ? simulation.advance(frame) : simulation.advance());
    if (!due) continue;
    recorder.write(frame, simulation);
    progress.at(simulation.time());
  }
  checkpoints.write_if_asked_for();
}

/// Lets `run` flow to its end and publishes what it wrote.
void finish(const Scene& scene, const RunOptions& options, Run& run)
{
  const std::string part = options.output + ".part";
  auto& simulation = run.simulation;
  Recorder recorder(run.writer, scene.small_diameter, run.progress.recorder);
  Checkpoints checkpoints(scene, options, run, recorder);
  Progress progress(simulation.time(), scene.duration, options.quiet);
  const double begin = seconds_now();
  flow(scene, simulation, recorder, checkpoints, progress);
  progress.clear();
  const double wall = run.progress.wall + seconds_now() - begin;
  const RunSummary summary{simulation.time() - run.progress.begin, wall, run.deposited_height,
                           recorder.totals(), stiffness_of(scene, recorder.totals())};
  run.writer.add_parameters(to_parameters(summary));
  if (!options.quiet) fmt::print(stderr, "{}", to_text(summary, scene));
  run.writer.close();
  if (interrupted())
    throw interruption(fmt::format(
        "interrupted at t = {:.6g} s; the frames so far are in {}{}", simulation.time(), part,
        options.checkpoint.empty() ? ""
                                   : fmt::format(", --restart {} goes on", options.checkpoint)));
  publish(part, options.output, {scene.compression, scene.float32});
  if (options.strict && recorder.totals().missed > 0)
    throw CheckError(fmt::format(
        "the tolerance was missed in {} of {} steps; allow more sweeps or a smaller step",
        recorder.totals().missed, recorder.totals().steps));
}

TrajectoryWriter new_trajectory(const Scene& scene, const Simulation& simulation,
                                const Parameters& parameters, const std::string& part)
{
  return {part,
          {simulation.world().grains, simulation.world().box, parameters, Recorder::observables()},
          storage_while_running(scene)};
}

void record_deposition(const Scene& scene, TrajectoryWriter& writer)
{
  Recorder recorder(writer, scene.small_diameter);
  const auto record = [&](const StepReport& report, const Simulation& now, const Frame* frame) {
    recorder.add(report);
    if (frame != nullptr) recorder.write(*frame, now);
  };
  deposit(scene, {.each_step = {}, .record = record});
}

/// What a trajectory that begins with a restart says of how it came about.
Parameters describe_restart(const Scene& scene, const RunOptions& options, double time,
                            const std::string& history)
{
  auto parameters = describe(scene, options);
  parameters.texts["history"] = history;
  parameters.numbers["restart_time"] = {time};
  if (options.perturbation.size > 0) {
    parameters.numbers["perturb"] = {options.perturbation.size};
    parameters.numbers["seed_perturbation"] = {static_cast<double>(options.perturbation.seed)};
  }
  return parameters;
}

bool holds_something(const std::string& path)
{
  std::error_code none;
  const auto size = std::filesystem::file_size(path, none);
  return !none && size > 0;
}

}  // namespace

void simulate(const Scene& scene, const RunOptions& options)
{
  const std::string part = options.output + ".part";
  check_outputs(options);
  refuse_to_overwrite(part, options.overwrite);
  require_writable(part);
  const RemoveIfEmpty clean_up(part);
  listen_to_signals();

  Progress(0, scene.duration, options.quiet).say("depositing the bed");
  const auto parameters = describe(scene, options);
  const auto listen = [] {
    if (interrupted()) throw interruption("interrupted while the bed was deposited");
  };
  const auto deposited = deposit(scene, {.each_step = listen, .record = {}});
  const auto simulation = release(deposited, scene);
  Run run{simulation,
          new_trajectory(scene, simulation, parameters, part),
          {},
          bed_height(deposited),
          parameters.text("history")};
  if (scene.keep_deposition) record_deposition(scene, run.writer);
  finish(scene, options, run);
}

void resume(const Checkpoint& checkpoint, const Scene& scene, const RunOptions& options)
{
  const std::string part = options.output + ".part";
  const auto then = scene_of(checkpoint, options.restart);
  require_same_bed(then, scene);
  const bool perturbed = options.perturbation.size > 0;
  const bool unchanged = !perturbed && to_text(scene) == to_text(then);
  const bool in_place = unchanged && holds_something(part);
  check_outputs(options);
  auto simulation = go_on(checkpoint, then, scene, options.perturbation);
  if (!in_place && simulation.steps_done() >= scene.steps_in_all())
    throw UsageError(fmt::format(
        "{} is at t = {:g} s and the run ends at {:g} s; a larger --duration prolongs it",
        options.restart, simulation.time(), scene.duration));
  if (!in_place && holds_something(part)) refuse_to_overwrite(part, options.overwrite);
  require_writable(part);
  const RemoveIfEmpty clean_up(part);
  listen_to_signals();

  const auto history = fmt::format("{}\n{} (from t = {:g} s)", checkpoint.history,
                                   options.command_line, simulation.time());
  const auto parameters = describe_restart(scene, options, simulation.time(), history);
  TrajectoryProgress progress;
  progress.begin = simulation.time();
  if (!perturbed && moves_alike(then, scene))
    progress.recorder.since_frame = checkpoint.trajectory.recorder.since_frame;
  if (in_place) progress = checkpoint.trajectory;
  simulation.tilt(gravity_of(scene));
  simulation.drive(bodies_of(scene, simulation.world().grains));
  Run run{simulation,
          in_place ? truncate_to_checkpoint(part, checkpoint, options.restart, history,
                                            storage_while_running(scene))
                   : new_trajectory(scene, simulation, parameters, part),
          progress, checkpoint.deposited_height, history};
  finish(scene, options, run);
}

}  // namespace grseg
