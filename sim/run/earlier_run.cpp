// SPDX-License-Identifier: GPL-3.0-or-later
#include "sim/run/earlier_run.hpp"

#include "formats/core/errors.hpp"
#include "formats/core/files.hpp"
#include "formats/trajectory/reader.hpp"
#include "sim/run/run_files.hpp"
#include "sim/scene/keys/keys.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

namespace grseg {
namespace {

/// First key in which the steps or the stored precision of two scenes differ; null if none does.
const SceneKey* other_key(const Scene& before, const Scene& now)
{
  const auto& keys = scene_keys();
  const auto other = std::find_if(keys.begin(), keys.end(), [&](const SceneKey& key) {
    const bool matters =
        key.role == KeyRole::bed || key.role == KeyRole::flow || std::string(key.name) == "store";
    return matters && key.text(before) != key.text(now);
  });
  return other == keys.end() ? nullptr : &*other;
}

/// "slope is 23", or "large-grains is not given".
std::string value_in_words(const SceneKey& key, const Scene& scene)
{
  const auto text = key.text(scene);
  return fmt::format("{} is {}", key.name, text.empty() ? "not given" : key.with_unit(text));
}

/// Reason why a run of `scene` does not make the frames in the file `part` again; "" if it does.
/// Throws FormatError if the file cannot be read.
std::string reason_to_keep(const std::string& part, const Scene& scene)
{
  const TrajectoryReader left(part);
  const auto before = scene_of(left.parameters().text("scene"), part);
  if (const auto* key = other_key(before, without_round_off(scene, before)))
    return fmt::format(
        "{} is of another scene, in which {}: choose another name for --output, or give this value "
        "to begin that run again",
        part, value_in_words(*key, before));
  if (left.size() > 0 && left.times().back() >= 0)
    return fmt::format(
        "{} has frames up to t = {:g} s, and their checkpoint is missing: name it with "
        "--checkpoint, or choose another name for --output",
        part, left.times().back());
  return "";
}

bool is_empty_file(const std::string& path)
{
  std::error_code error;
  return std::filesystem::is_regular_file(std::filesystem::symlink_status(path, error)) &&
         !holds_something(path);
}

}  // namespace

std::string checkpoint_of_earlier_run(const RunOptions& options)
{
  for (const auto& own : {options.checkpoint, previous_of(options.checkpoint)})
    if (holds_something(own)) return own;
  return "";
}

void require_no_output(const RunOptions& options)
{
  if (options.continues && !options.overwrite && is_taken(options.output))
    throw UsageError(fmt::format(
        "{} exists, but not its checkpoint {}, from which it could be continued: name it with "
        "--checkpoint, or choose another name for --output",
        options.output, options.checkpoint));
}

bool begins_again(const Scene& scene, const RunOptions& options)
{
  const auto part = part_of(options.output);
  if (options.overwrite || is_empty_file(part)) {
    check_output(part, true, {});
    return false;
  }
  if (!is_taken(part)) return false;
  std::string reason;
  try {
    reason = reason_to_keep(part, scene);
  } catch (const FormatError& damaged) {
    reason = fmt::format("{}; move it away to begin again", damaged.what());
    if (options.continues) throw FormatError(reason);
  }
  if (options.continues && !reason.empty()) throw UsageError(reason);
  check_output(part, reason.empty(), {});
  return true;
}

void require_same_run(const Scene& before, const Scene& now, const RunOptions& options)
{
  const auto* key = other_key(before, now);
  if (key == nullptr) return;
  auto remedy = fmt::format(
      "{} is of a run in which {}: give this value to continue it, or choose other names for "
      "--output and --checkpoint to begin another run",
      options.restart, value_in_words(*key, before));
  if (key->role != KeyRole::bed)
    remedy += fmt::format(
        "; --restart {} with another --output, instead of --continue, continues with the change",
        options.restart);
  throw UsageError(remedy);
}

bool begins_the_run(const std::string& output, const CheckpointHead& checkpoint)
{
  if (!holds_something(output)) return false;
  const TrajectoryReader run(output);
  if (run.size() == checkpoint.trajectory.frames)
    return run.digest() == checkpoint.trajectory.digest;
  if (run.size() == 0 || !holds_something(part_of(output))) return false;
  const TrajectoryReader longer(part_of(output));
  return run.size() < longer.size() && longer.digests()[run.size() - 1] == run.digest();
}

bool is_continued(const std::string& part, const CheckpointHead& checkpoint)
{
  if (!holds_something(part)) return false;
  if (checkpoint.trajectory.frames == 0) return true;
  try {
    return TrajectoryReader(part).size() > 0;
  } catch (const FormatError&) {
    return true;  // truncate_to_checkpoint() says what is wrong
  }
}

}  // namespace grseg
