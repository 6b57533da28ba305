// SPDX-License-Identifier: GPL-3.0-or-later
#include "sim/run/expected_cost.hpp"

#include "formats/cli/interruption.hpp"
#include "formats/core/errors.hpp"
#include "formats/core/files.hpp"
#include "formats/core/memory.hpp"
#include "formats/trajectory/layout.hpp"
#include "sim/run/recorder.hpp"
#include "sim/scene/deposition.hpp"
#include "sim/scene/geometry.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <linux/magic.h>
#include <sys/vfs.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <filesystem>

namespace grseg {
namespace {

// Measured on chutes of 3,400 and 13,600 grains.
constexpr double memory_without_grains = 25e6, memory_of_grain = 5500;  // bytes
constexpr double memory_of_sphere = 14000;  // bytes, measured on chutes of 3,500 spheres
// Contacts of one frame per grain, seldom more: 1.0 to 1.8 and 2.1 to 2.4 were measured.
constexpr double contacts_per_grain = 1.9, contacts_per_sphere = 2.5;
constexpr double usual_grain_step = 4e-7;                   // s, to decide whether to measure
constexpr double worth_measuring = 60, measured_for = 0.3;  // s; of a run, of the measurement

double bytes_of_file(const Scene& scene, double frames, double grains)
{
  const double contacts = scene.dimension == 3 ? contacts_per_sphere : contacts_per_grain;
  const auto whole = [](double number) { return static_cast<std::size_t>(std::llround(number)); };
  return size_of_live_file(
      {whole(frames), whole(frames * contacts * grains), whole(grains), 0, scene.dimension},
      Recorder::observables(scene.dimension).size(), scene.float32);
}

/// Error with which the file system refuses so many bytes beside `output`, such as EDQUOT; 0 if it
/// grants them, or cannot tell.
int error_of_reserving(double bytes, const std::string& output)
{
  const auto name = temporary_path(output);
  const int file = open(name.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0666);
  if (file < 0) return 0;
  unlink(name.c_str());
  struct statfs system {};
  // Reserving memory would take as long as filling it.
  const bool on_disk = fstatfs(file, &system) == 0 && system.f_type != TMPFS_MAGIC;
  const int error = on_disk && fallocate(file, 0, 0, std::llround(bytes)) != 0 ? errno : 0;
  close(file);
  return error == EDQUOT || error == EFBIG || error == ENOSPC ? error : 0;
}

constexpr double most_measured = 4000;  // grains of the small bed, unless it would be too low
constexpr double most_of_low_bed = 2 * most_measured;

/// Scene of a small bed of the same grains. If `scene` is a chute, the bed flows alike.
Scene small_bed(const Scene& scene)
{
  auto small = scene;
  small.geometry = &bed_geometry;
  small.lateral = Scene::Lateral::periodic;
  small.base = Scene::Base::wall;
  small.large_grains = std::nullopt;
  const double large = scene.large_diameter;
  small.length = scene.dimension == 3 ? std::min(scene.length, 8 * large) : 20 * large;
  small.width = std::min(scene.width, 6 * large);
  small.sides = Scene::Lateral::periodic;
  small.depth = std::min(scene.depth, 15 * large);
  const double too_many = expected_grains(small) / most_measured;
  if (too_many > 1)
    small.depth = std::max(small.depth / too_many, std::min(small.depth, 3 * large));
  return small;
}

/// Wall-clock time for one step of one grain, s; no value if the small bed has too many grains, as
/// at large size ratios, or does not come to rest.
template <int D>
std::optional<double> measured_grain_step(const Scene& scene)
try {
  using clock = std::chrono::steady_clock;
  const auto small = small_bed(scene);
  if (expected_grains(small) > most_of_low_bed) return {};
  const auto each_step = [](double) { stop_if_interrupted(); };
  auto simulation =
      release(deposit<D>(small, {.each_step = each_step, .slowed = {}, .record = {}}), small);
  const auto begin = clock::now();
  std::chrono::duration<double> passed{};
  double steps = 0;
  while (passed.count() < measured_for) {
    simulation.advance();
    ++steps;
    passed = clock::now() - begin;
  }
  return passed.count() / steps / static_cast<double>(simulation.world().grains.size());
} catch (const Interruption&) {
  throw;
} catch (const ToolError&) {
  return std::nullopt;
}

/// Size in kB, MB, GB or TB with two or three digits, such as "1.5 GB".
std::string bytes_in_words(double bytes)
{
  const char* units[] = {"kB", "MB", "GB", "TB"};
  int unit = 0;
  for (bytes /= 1000; bytes >= 999.5 && unit < 3; ++unit) bytes /= 1000;
  return fmt::format("{:.{}f} {}", bytes, bytes < 9.95 ? 1 : 0, units[unit]);
}

std::string seconds_in_words(double seconds)
{
  if (seconds < 99.5) return fmt::format("{:.0f} seconds", seconds);
  if (seconds < 5970) return fmt::format("{:.0f} minutes", seconds / 60);
  return fmt::format("{:.0f} hours", seconds / 3600);
}

}  // namespace

ExpectedCost expected_cost(const Scene& scene, double begin, Measure measure)
{
  ExpectedCost cost;
  cost.grains = expected_grains(scene);
  cost.memory = memory_without_grains +
                (scene.dimension == 3 ? memory_of_sphere : memory_of_grain) * cost.grains;
  cost.of_rest = begin > 0;
  const double flow = std::max(0.0, scene.duration - begin);
  const double deposition = begin > 0 ? 0 : expected_time_to_rest(scene);
  const double frames = (flow / scene.frame_interval) *
                            static_cast<double>(std::min(scene.burst, scene.steps_per_frame())) +
                        (scene.keep_deposition ? deposition / scene.frame_interval : 0);
  cost.file = bytes_of_file(scene, frames, cost.grains);
  cost.disk = scene.compression > 0 ? 2 * cost.file : cost.file;  // packed into a second file
  const double grain_steps = cost.grains * (flow + deposition) / scene.step;
  if (measure == Measure::where_long && grain_steps * usual_grain_step < worth_measuring)
    return cost;
  cost.seconds =
      with_dimension(scene.dimension, [&](auto d) { return measured_grain_step<d>(scene); });
  if (cost.seconds) *cost.seconds *= grain_steps;
  return cost;
}

std::string to_text(const ExpectedCost& cost)
{
  const auto file = bytes_in_words(cost.file);
  auto text =
      fmt::format("{:.0f} grains, {} of memory, {}", cost.grains, bytes_in_words(cost.memory),
                  cost.of_rest ? "up to " + file + " of new frames" : "a file of up to " + file);
  if (cost.disk > cost.file)
    text += fmt::format(" before and {} while it is compressed", bytes_in_words(cost.disk));
  if (cost.seconds) text += ", about " + seconds_in_words(*cost.seconds);
  return text;
}

std::string to_table(const ExpectedCost& cost)
{
  return fmt::format(
      "grains\tmemory[bytes]\tfile[bytes]\ttime[s]\n{:.0f}\t{:.0f}\t{:.0f}\t{:.2g}\n", cost.grains,
      cost.memory, cost.file, cost.seconds.value_or(std::nan("")));
}

void require_room(const ExpectedCost& cost, const std::string& output)
{
  const auto require = [](double needed, double free, const std::string& where) {
    if (needed > free)
      throw UsageError(fmt::format(
          "this run needs about {} {}, but {} are free; choose a smaller scene, or pass --force",
          bytes_in_words(needed), where, bytes_in_words(free)));
  };
  require(cost.memory, free_memory(), "of memory");
  std::error_code error;
  const auto folder = std::filesystem::absolute(output, error).parent_path();
  const auto space = std::filesystem::space(folder, error);
  const auto where = "on the disk of " + output;
  if (!error) require(cost.disk, static_cast<double>(space.available), where);
  if (const int refused = error_of_reserving(cost.file, output); refused != 0)
    throw RunError(
        fmt::format("this run needs up to {} {}: {}; choose a smaller scene, or pass --force",
                    bytes_in_words(cost.disk), where, reason(refused)));
}

}  // namespace grseg
