// SPDX-License-Identifier: GPL-3.0-or-later
#include "sim/run.hpp"

#include "formats/errors.hpp"
#include "formats/repack.hpp"
#include "formats/tool.hpp"
#include "sim/deposition.hpp"
#include "sim/recorder.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <optional>

namespace grseg {
namespace {

volatile std::sig_atomic_t stop_signal = 0;

void remember_signal(int signal)
{
  stop_signal = signal;
}

double seconds_now()
{
  using namespace std::chrono;
  return duration<double>(steady_clock::now().time_since_epoch()).count();
}

/// Says on a terminal how far the run is.
class Progress {
 public:
  Progress(double duration, bool quiet) : duration_(duration), shown_(!quiet && isatty(2) != 0) {}
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
    const double left = time > 0 ? (now - begin_) * (duration_ - time) / time : 0;
    say(fmt::format("t = {:.2f} of {:g} s, {:.0f}:{:02.0f} left", time, duration_,
                    std::floor(left / 60), std::floor(std::fmod(left, 60))));
  }

 private:
  double duration_;
  bool shown_;
  double begin_ = seconds_now(), last_ = 0;
};

Parameters describe(const Scene& scene, const RunOptions& options)
{
  auto parameters = to_parameters(scene);
  parameters.texts["program"] = "grseg-sim " + version_with_hash();
  parameters.texts["command_line"] = options.command_line;
  parameters.texts["history"] = options.command_line;
  return parameters;
}

struct Cost {
  double simulated = 0, wall = 0;  // s
};

void summarise(const Scene& scene, const StepTotals& t, const Cost& cost, double height, bool quiet,
               TrajectoryWriter& writer)
{
  const double d = scene.small_diameter;
  const double missed = t.per_step(static_cast<double>(t.missed));
  Parameters summary;
  summary.numbers["summary_sweeps_per_step"] = {t.per_step(t.sweeps)};
  summary.numbers["summary_contacts_per_step"] = {t.per_step(t.force_bearing)};
  summary.numbers["summary_missed_share"] = {missed};
  summary.numbers["summary_largest_residual"] = {t.largest_residual};
  summary.numbers["summary_mean_overlap"] = {t.mean_overlap()};
  summary.numbers["summary_largest_overlap"] = {t.largest_overlap};
  summary.numbers["summary_mean_gap"] = {t.mean_gap_bearing()};
  summary.numbers["summary_deposited_height"] = {height};
  writer.add_parameters(summary);
  if (quiet) return;
  fmt::print(stderr,
             "grseg-sim: {:g} s simulated in {:.1f} s: {:.3g} s per second\n"
             "  accuracy {}: step {:.4g} s, tolerance {:g}; {:.1f} sweeps and {:.0f} contacts per "
             "step; tolerance missed in {:.3g} % of steps\n"
             "  mean overlap {:.2e} d_S, largest {:.2e} d_S, mean |gap| under force {:.2e} d_S; "
             "deposited height {:.2f} d_S\n",
             cost.simulated, cost.wall, cost.wall > 0 ? cost.simulated / cost.wall : 0,
             scene.accuracy, scene.step, scene.solver.tolerance, t.per_step(t.sweeps),
             t.per_step(t.force_bearing), 100 * missed, t.mean_overlap() / d, t.largest_overlap / d,
             t.mean_gap_bearing() / d, height / d);
}

void bring_to_disk(const std::string& path)
{
  const int file = open(path.c_str(), O_RDONLY | O_CLOEXEC);
  const bool on_disk = file >= 0 && fsync(file) == 0;
  if (file >= 0) close(file);
  if (!on_disk)
    throw RunError(fmt::format("cannot bring {} to the disk: {}", path, std::strerror(errno)));
}

/// The finished run under its own name, compressed if that is asked for.
void publish(const std::string& part, const std::string& output, const StorageSettings& storage)
{
  std::string whole = part;
  if (storage.compression > 0) {
    whole = fmt::format("{}.tmp.{}", output, getpid());
    repack(part, whole, storage);
  }
  bring_to_disk(whole);
  std::error_code error;
  std::filesystem::rename(whole, output, error);
  if (error)
    throw RunError(fmt::format("cannot rename {} to {}: {}", whole, output, error.message()));
  if (whole != part) std::filesystem::remove(part, error);
}

void refuse_to_overwrite(const std::string& path, const RunOptions& options)
{
  if (std::filesystem::is_directory(path))
    throw UsageError(fmt::format("{} is a folder; name a file in it", path));
  if (!options.overwrite && std::filesystem::exists(path))
    throw UsageError(fmt::format(
        "{} is there already; choose another name, remove it, or say --overwrite", path));
}

/// Finds out before the bed is made, rather than after, that the file cannot be.
void require_writable(const std::string& path)
{
  const int file = open(path.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0666);
  if (file < 0) throw RunError(fmt::format("cannot create {}: {}", path, std::strerror(errno)));
  close(file);
}

/// What a signal asks for, as an exit code and a sentence.
ToolError interruption(const std::string& sentence)
{
  return {stop_signal == SIGINT ? exit_interrupted : exit_terminated, sentence};
}

/// The bed; whatever keeps it from being made leaves no empty file behind.
Simulation deposit_or_clean_up(const Scene& scene, const std::string& part)
{
  const auto listen = [] {
    if (stop_signal != 0) throw interruption("interrupted while the bed was deposited");
  };
  try {
    return deposit(scene, {.each_step = listen, .record = {}});
  } catch (...) {
    std::error_code ignored;
    if (std::filesystem::file_size(part, ignored) == 0) std::filesystem::remove(part, ignored);
    throw;
  }
}

/// Writes frames until the end or a signal.
void flow(const Scene& scene, Simulation& simulation, Recorder& recorder, Progress& progress)
{
  const auto every = scene.steps_per_frame(), steps = scene.steps_in_all();
  Frame frame;
  for (std::int64_t step = 0; step < steps && stop_signal == 0; ++step) {
    const bool due = step % every == 0;
    recorder.add(due ? simulation.advance(frame) : simulation.advance());
    if (!due) continue;
    recorder.write(frame, simulation);
    progress.at(simulation.time());
  }
}

Vec2 gravity_of(const Parameters& parameters)
{
  const auto& g = parameters.numbers.at("gravity");
  return {g[0], g[1]};
}

}  // namespace

void simulate(const Scene& scene, const RunOptions& options)
{
  const std::string part = options.output + ".part";
  refuse_to_overwrite(options.output, options);
  refuse_to_overwrite(part, options);
  require_writable(part);
  stop_signal = 0;
  std::signal(SIGINT, remember_signal);
  std::signal(SIGTERM, remember_signal);

  Progress progress(scene.duration, options.quiet);
  progress.say("depositing the bed");
  const auto parameters = describe(scene, options);
  auto simulation = deposit_or_clean_up(scene, part);
  const double height = bed_height(simulation);
  TrajectoryWriter writer(
      part,
      {simulation.world().grains, simulation.world().box, parameters, Recorder::observables()},
      {scene.compression, scene.float32});
  Recorder recorder(writer, scene.small_diameter);
  if (scene.keep_deposition) {
    Recorder of_deposition(writer, scene.small_diameter);
    const auto record = [&](const StepReport& report, const Simulation& now, const Frame* frame) {
      of_deposition.add(report);
      if (frame != nullptr) of_deposition.write(*frame, now);
    };
    deposit(scene, {.each_step = {}, .record = record});
  }

  simulation.tilt(gravity_of(parameters));
  const double begin = seconds_now();
  flow(scene, simulation, recorder, progress);
  progress.clear();
  summarise(scene, recorder.totals(), {simulation.time(), seconds_now() - begin}, height,
            options.quiet, writer);
  writer.close();
  if (stop_signal != 0)
    throw interruption(fmt::format("interrupted at t = {:.6g} s; the frames so far are in {}",
                                   simulation.time(), part));
  publish(part, options.output, {scene.compression, scene.float32});
  if (options.strict && recorder.totals().missed > 0)
    throw CheckError(fmt::format(
        "the tolerance was missed in {} of {} steps; allow more sweeps or a smaller step",
        recorder.totals().missed, recorder.totals().steps));
}

}  // namespace grseg
