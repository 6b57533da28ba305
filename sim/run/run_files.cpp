// SPDX-License-Identifier: GPL-3.0-or-later
#include "sim/run/run_files.hpp"

#include "formats/core/errors.hpp"
#include "formats/core/files.hpp"
#include "formats/trajectory/reader.hpp"
#include "sim/run/summary.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>

namespace grseg {
namespace {

/// True if both paths name the same file, which need not exist.
bool is_one_name(const std::string& a, const std::string& b)
{
  std::error_code error;
  const auto whole = [&](const std::string& path) {
    return std::filesystem::weakly_canonical(std::filesystem::absolute(path), error);
  };
  return same_file(a, b) || whole(a) == whole(b);
}

void remove_left_over(const std::string& path)
{
  std::error_code ignored;
  std::filesystem::remove(path, ignored);
}

}  // namespace

std::string part_of(const std::string& path)
{
  return path + ".part";
}

std::string previous_of(const std::string& path)
{
  const std::filesystem::path whole(path);
  return (whole.parent_path() / (whole.stem().string() + "_prev" + whole.extension().string()))
      .string();
}

void check_outputs(const RunOptions& options)
{
  const std::vector<std::string> inputs{options.scene_file, options.restart};
  check_output(options.output, options.overwrite, inputs);
  const auto part = part_of(options.output);
  for (const auto& temporary : {part, part_of(part)}) refuse_input_as_output(temporary, inputs);
  const auto& checkpoint = options.checkpoint;
  if (checkpoint.empty()) return;
  for (const auto& of_trajectory : {options.output, part})
    for (const auto& own : {checkpoint, part_of(checkpoint), previous_of(checkpoint)})
      if (is_one_name(own, of_trajectory))
        throw UsageError(
            "checkpoint and trajectory cannot be the same file; choose another name for "
            "--checkpoint");
  for (const auto& own : {checkpoint, previous_of(checkpoint)}) {
    if (options.continues && !options.restart.empty()) break;
    if (same_file(checkpoint, options.restart)) break;
    if (!options.overwrite && holds_something(own) && holds_something(part))
      throw UsageError(fmt::format(
          "{} and {} belong to an interrupted run: --continue continues it, --overwrite begins "
          "again",
          own, part));
    if (!same_file(own, options.restart)) check_output(own, options.overwrite, inputs);
  }
  refuse_input_as_output(part_of(checkpoint), inputs);
}

RunLocks::RunLocks(const RunOptions& options) : trajectory_(options.output)
{
  const auto trajectory = part_of(options.output), copy = part_of(trajectory);
  for (const auto& path : {options.output, trajectory, copy}) remove_temporaries(path);
  remove_left_over(copy);
  if (options.checkpoint.empty()) return;
  checkpoint_.emplace(options.checkpoint);
  const auto part = part_of(options.checkpoint);
  remove_temporaries(previous_of(options.checkpoint));
  remove_left_over(part);
  const RemoveAtEnd trial(part, RemoveAtEnd::If::empty);
  require_writable(part);
}

void require_writable(const std::string& path)
{
  const int file = open(path.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0666);
  if (file < 0) throw RunError(fmt::format("cannot create {}: {}", path, reason(errno)));
  close(file);
}

bool holds_something(const std::string& path)
{
  std::error_code error;
  const auto size = std::filesystem::file_size(path, error);
  return !error && size > 0;
}

void publish_trajectory(const std::string& output, bool overwrite, const StorageSettings& storage)
{
  const auto part = part_of(output);
  const auto remedy =
      fmt::format("all frames are in {}; rename it, as in: mv -n {} other.h5", part, part);
  if (storage.compression == 0) return publish_file(part, output, overwrite, remedy);
  const RemoveAtEnd compressed(temporary_path(output));
  repack(part, compressed.path(), storage);
  publish_file(compressed.path(), output, overwrite, remedy);
  std::error_code ignored;
  std::filesystem::remove(part, ignored);
}

TrajectoryWriter truncate_to_checkpoint(const Continuation& to, const CheckpointHead& checkpoint,
                                        const std::string& name, const StorageSettings& storage)
{
  const auto require = [&](bool belongs) {
    if (!belongs)
      throw UsageError(fmt::format(
          "{} does not contain the frames of {}; move it away to begin a new trajectory, or choose "
          "another name for --output",
          to.from, name));
  };
  const auto copy = part_of(to.part);
  const RemoveAtEnd clean_up(copy);
  try {
    const TrajectoryReader run(to.from);
    const auto scene = run.parameters().text("scene");
    require((scene == checkpoint.scene || scene == to.scene) &&
            run.grains().radius == checkpoint.grains.radius &&
            run.size() >= checkpoint.trajectory.frames);
    auto parameters = run.parameters();
    add_unknown_summary(parameters);
    parameters.texts["history"] = to.history;
    parameters.texts["scene"] = to.scene;
    auto writer = copy_frames(run, checkpoint.trajectory.frames, copy, parameters,
                              Recorder::observables(checkpoint.box.dimension), storage);
    require(writer.digest() == checkpoint.trajectory.digest);
    writer.flush();
    publish_file(copy, to.part, true);
    return writer;
  } catch (const FormatError& damaged) {
    throw FormatError(fmt::format("{}; move it away to begin a new trajectory at the checkpoint",
                                  damaged.what()));
  }
}

}  // namespace grseg
