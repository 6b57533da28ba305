// SPDX-License-Identifier: GPL-3.0-or-later
#include "sim/run/truncate_to_checkpoint.hpp"

#include "formats/core/errors.hpp"
#include "formats/core/files.hpp"
#include "formats/trajectory/repack.hpp"
#include "sim/run/run_files.hpp"
#include "sim/run/summary.hpp"

#include <fmt/format.h>

namespace grseg {
namespace {

/// Whether `run` can be that of `checkpoint`; only its frames prove it.
bool same_run(const TrajectoryReader& run, const Checkpoint& checkpoint)
{
  return run.parameters().text("scene") == checkpoint.scene &&
         run.grains().radius == checkpoint.grains.radius &&
         run.size() >= checkpoint.trajectory.frames;
}

/// /parameters of a run that continues: its end is not known any more.
Parameters without_end(Parameters parameters, const Continuation& to)
{
  add_unknown_summary(parameters);
  parameters.texts["history"] = to.history;
  parameters.texts["scene"] = to.scene;
  return parameters;
}

}  // namespace

TrajectoryWriter truncate_to_checkpoint(const Continuation& to, const Checkpoint& checkpoint,
                                        const std::string& name, const StorageSettings& storage)
{
  const auto require = [&](bool belongs) {
    if (!belongs)
      throw UsageError(fmt::format(
          "{} does not hold the frames of {}; move it away to begin a new trajectory, or choose "
          "another name for --output",
          to.from, name));
  };
  const auto copy = part_of(to.part);
  const RemoveAtEnd clean_up(copy);
  try {
    const TrajectoryReader run(to.from);
    require(same_run(run, checkpoint));
    auto writer = copy_frames(run, checkpoint.trajectory.frames, copy,
                              without_end(run.parameters(), to), Recorder::observables(), storage);
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
