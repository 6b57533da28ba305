// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/import/convert/scan.hpp"

#include "formats/cli/interruption.hpp"
#include "formats/import/convert/imported_bed.hpp"
#include "formats/import/facts/cell_and_walls.hpp"
#include "formats/import/facts/proposals.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <unordered_map>

namespace grseg {
namespace {

/// Collects the grains of successive frames in a roster.
class Collector {
 public:
  void add(const ArchiveFrame& frame)
  {
    const auto& now = frame.grains;
    if (roster_.frames++ == 0) begin(frame);
    auto& all = roster_.all;
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
      if (all.periodic[static_cast<std::size_t>(axis)]) continue;
      all.low[axis] = std::min(all.low[axis], frame.low[axis]);
      all.high[axis] = std::max(all.high[axis], frame.high[axis]);
    }
    roster_.bed.extend(box_around(now));
    roster_.fewest = std::min(roster_.fewest, now.size());
    roster_.most = std::max(roster_.most, now.size());
    for (std::size_t g = 0; g < now.size(); ++g) add_grain(frame, g);
    all.grains.type_names = now.type_names;
    if (now.size() == 0) return;
    all.grains.missing = now.missing;
    all.grains.unwrapped = all.grains.unwrapped && now.counts_periods();
  }

  Roster finish()
  {
    auto& all = roster_.all.grains;
    for (std::size_t row = 0; row < all.size(); ++row)
      all.position[row] /= static_cast<double>(seen_[row].times);
    return std::move(roster_);
  }

 private:
  void begin(const ArchiveFrame& first)
  {
    auto& all = roster_.all;
    all = first;
    all.grains = {};
    all.grains.unwrapped = true;
    all.contacts = {};
    all.questions.clear();
    all.place = fmt::format("all frames from {} on", first.place);
    roster_.fewest = first.grains.size();
  }

  void add_grain(const ArchiveFrame& frame, std::size_t g)
  {
    const auto& now = frame.grains;
    auto& all = roster_.all.grains;
    const auto [place, is_new] = row_.try_emplace(now.id[g], all.size());
    const std::size_t row = place->second;
    if (is_new) add_new(frame, g);
    auto& seen = seen_[row];
    if (seen.last == roster_.frames)
      throw FormatError(fmt::format("{}: grain {} appears twice{}", frame.place, now.id[g],
                                    hint_of_digits(now.id[g])));
    seen.last = roster_.frames;
    ++seen.times;
    if (!is_new) require_same_grain(all, row, now, g, frame.place);
    all.position[row] += now.position[g];
    if (!now.velocity.empty() && now.velocity[g].norm() > all.velocity[row].norm())
      all.velocity[row] = now.velocity[g];
  }

  void add_new(const ArchiveFrame& frame, std::size_t g)
  {
    const auto& now = frame.grains;
    auto& all = roster_.all.grains;
    all.id.push_back(now.id[g]);
    all.position.emplace_back(Vec3::Zero());
    seen_.emplace_back();
    const auto copy = [&](const auto& from, auto& to, const char* what) {
      if (!from.empty()) to.push_back(from[g]);
      if (!to.empty() && to.size() != all.size())
        throw FormatError(fmt::format(
            "{}: some frames have {} of grains and some do not; import them separately, with "
            "--begin and --end",
            frame.place, what));
    };
    copy(now.type, all.type, "types");
    copy(now.radius, all.radius, "radii");
    copy(now.mass, all.mass, "masses");
    copy(now.fixed, all.fixed, "fixed flags");
    copy(now.velocity, all.velocity, "velocities");
    copy(now.angular_velocity, all.angular_velocity, "angular velocities");
    copy(now.force, all.force, "forces");
  }

  struct Seen {
    std::size_t times = 0, last = 0;  // number of frames with the grain; number of the last of them
  };
  Roster roster_;
  std::unordered_map<std::int64_t, std::size_t> row_;
  std::vector<Seen> seen_;
};

bool same_ids(const ArchiveGrains& a, const ArchiveGrains& b)
{
  if (a.id == b.id) return true;
  auto first = a.id, second = b.id;
  std::sort(first.begin(), first.end());
  std::sort(second.begin(), second.end());
  return first == second;
}

/// True if one of the first frames has other grains than the first. Frames behind it are not read,
/// so they may be damaged.
bool grains_change_early(const ImportSettings& settings)
{
  constexpr int early = 20;
  try {
    ArchiveFrames frames(settings);
    ArchiveFrame first, frame;
    if (!frames.next_grains(first)) return false;
    for (int k = 1; k < early && frames.next_grains(frame); ++k)
      if (!same_ids(first.grains, frame.grains)) return true;
  } catch (const ToolError&) {  // the import reports the error when it reads that frame
  }
  return false;
}

/// True if neither the archive nor an option says which grains are the base. (A flow between walls
/// may have no base grains.)
bool base_is_open(const ArchiveGrains& grains, const ImportSettings& settings)
{
  const auto& species = settings.species;
  return grains.fixed.empty() && !species.boundary && !species.boundary_ids;
}

/// True if the bed ends before the cell of `frame` on a side of an axis, by more than a tenth of the
/// smallest radius.
bool ends_before(const Eigen::AlignedBox3d& bed, const ArchiveFrame& frame, int axis)
{
  const auto& radius = frame.grains.radius;
  const double enough = radius.empty() ? 0 : *std::min_element(radius.begin(), radius.end()) / 10;
  return bed.min()[axis] - frame.low[axis] > enough || frame.high[axis] - bed.max()[axis] > enough;
}

/// Remark if coordinates have so few digits that gaps and overlaps are uncertain; "" if not.
std::string remark_on_digits(const ArchiveFrame& frame)
{
  constexpr int few = 7;
  const auto& grains = frame.grains;
  const int digits = digits_of(grains.position);
  if (grains.radius.empty() || digits == 0 || digits > few) return "";
  double largest = 0;
  for (const auto& at : grains.position) largest = std::max(largest, at.cwiseAbs().maxCoeff());
  const double step = std::pow(10, std::floor(std::log10(largest)) + 1 - digits);
  return fmt::format(
      "coordinates have {} digits: gaps and overlaps are known to {:.1g} of the smallest radius (LAMMPS "
      "writes more by dump_modify ID format float %.15g)",
      digits, step / *std::min_element(grains.radius.begin(), grains.radius.end()));
}

}  // namespace

Roster read_roster(const ImportSettings& settings)
{
  ArchiveFrames frames(settings);
  Collector collector;
  for (ArchiveFrame frame; frames.next_grains(frame);) {
    stop_if_interrupted();
    collector.add(frame);
  }
  return collector.finish();
}

void require_same_grain(const ArchiveGrains& known, std::size_t row, const ArchiveGrains& now,
                        std::size_t g, const std::string& place)
{
  const auto refuse = [&](const char* what, double before, double after, const char* remedy) {
    throw FormatError(fmt::format("{}: the {} of grain {} changes from {:g} to {:g}; {}", place,
                                  what, now.id[g], before, after, remedy));
  };
  constexpr const char* used_again =
      "was its id used again after a grain had been removed? Then import the frames before and "
      "after it separately, with --begin and --end";
  constexpr const char* later =
      "was its mass set only after it had been poured in, or its id used again after a removal? "
      "Then import the frames before and after it separately, with --begin and --end";
  constexpr const char* frozen =
      "if grains are frozen or released later, import the phases separately, with "
      "--begin and --end";
  const auto differ = [](double a, double b) { return !(std::abs(a - b) <= 1e-5 * std::abs(a)); };
  const auto compare = [&](const auto& before, const auto& after, const char* what,
                           const auto& different, const char* remedy) {
    if (before.empty() || after.empty() || !different(before[row], after[g])) return;
    refuse(what, before[row], after[g], remedy);
  };
  const auto unequal = [](auto a, auto b) { return a != b; };
  compare(known.radius, now.radius, "radius", differ, used_again);
  compare(known.mass, now.mass, "mass", differ, later);
  compare(known.type, now.type, "type", unequal, frozen);
  compare(known.fixed, now.fixed, "fixed flag", unequal, frozen);
}

ScannedArchive::ScannedArchive(const ImportSettings& settings, std::shared_ptr<const Roster> roster,
                               Questions questions)
    : frames_(settings), roster_(std::move(roster))
{
  if (!frames_.next(frame))
    throw FormatError(fmt::format(
        "{}: the archive has no frame with grains and contacts; is it complete?",
        settings.files.grains.empty() ? settings.files.restart : settings.files.grains.front()));
  if (!roster_ && frame.grains.size() == 0)
    throw OtherGrains(fmt::format("{}: there are no grains", frame.place));
  few_digits_ = remark_on_digits(frame);
  const auto full = roster_ ? full_frame(settings) : frame;
  for (const auto& question : full.questions) questions.ask(question);
  const auto resting = resting_grains_of(settings);
  facts = collect_facts(archive().facts(), {all_grains(), full, resting}, settings, questions);
  ask_for_the_bed(settings, resting, questions);
  questions.report();
}

std::vector<std::string> ScannedArchive::remarks() const
{
  auto remarks = archive().remarks();
  if (!few_digits_.empty()) remarks.push_back(few_digits_);
  for (auto& of_frames : frames_.remarks()) remarks.push_back(std::move(of_frames));
  if (roster_)
    remarks.push_back(fmt::format("grains come and go: {} ids in all, between {} and {} in a frame",
                                  roster_->all.grains.size(), roster_->fewest, roster_->most));
  return remarks;
}

bool ScannedArchive::next()
{
  if (!frames_.next(frame)) return false;
  if (!frame.questions.empty()) throw OpenQuestions(frame.questions);
  return true;
}

/// True for each grain at rest, which may be a base grain; empty if the base is known. Uses the
/// roster, or the current and the next frame.
std::vector<bool> ScannedArchive::resting_grains_of(const ImportSettings& settings) const
{
  if (!base_is_open(all_grains().grains, settings)) return {};
  if (roster_) return resting_grains(roster_->all.grains, nullptr);
  ArchiveFrames ahead(settings);
  ArchiveFrame later;
  const bool more = ahead.next_grains(later) && ahead.next_grains(later);
  return resting_grains(frame.grains, more ? &later.grains : nullptr);
}

/// The first of at most 100 frames that has half of the roster's most grains; if none has, the one
/// with most grains. It carries the questions of the first frame that has any.
ArchiveFrame ScannedArchive::full_frame(const ImportSettings& settings) const
{
  constexpr int furthest = 100;
  ArchiveFrames ahead(settings);
  ArchiveFrame full, next;
  std::vector<Question> questions;
  for (int k = 0; k < furthest && 2 * full.grains.size() < roster_->most && ahead.next(next); ++k) {
    if (questions.empty()) questions = next.questions;
    if (k == 0 || next.grains.size() > full.grains.size()) full = next;
  }
  full.questions = questions;
  return full;
}

/// Asks for everything that species and origin leave open. Other errors are thrown only if no
/// question is open, because a missing answer may cause them.
void ScannedArchive::ask_for_the_bed(const ImportSettings& settings,
                                     const std::vector<bool>& resting, Questions& questions) const
{
  auto trial = settings;
  const auto& grains = all_grains().grains;
  const bool has_walls = !facts.walls.empty();
  if (base_is_open(grains, trial) && (!has_walls || !resting.empty())) {
    trial.species.boundary = "none";
    auto question = question_of_base(grains, resting);
    if (resting.empty()) {
      const auto origin = proposed_origin(grains, facts.orientation.axes);
      question.reason.insert(std::string("or --boundary none").size(), " " + origin);
      questions.ask(question);
      trial.origin = "0";
    } else {
      // Tries the proposed option: "--boundary 3" or "--boundary-ids 1-35".
      trial.species.boundary.reset();
      const auto answer = question.option.substr(question.option.find(' ') + 1);
      (question.option.starts_with("--boundary-ids") ? trial.species.boundary_ids
                                                     : trial.species.boundary) = answer;
    }
  }
  ask_for_the_cell(settings, questions);
  try {
    questions.collect([&] { ImportedBed(all_grains(), facts, trial); });
    // Tries again with a single species, because questions about species hide those about origin.
    const auto& species = trial.species;
    trial.species = {{"grains=all"}, {}, {}, species.boundary, species.boundary_ids, {}, {}, {}};
    questions.collect([&] { ImportedBed(all_grains(), facts, trial); });
  } catch (const ToolError&) {
    if (!questions.any()) throw;
  }
}

/// Question for the bounds of the cell along an open axis, if the archive states none, or some that
/// lie behind the bed of all frames. Proposes the bed's own ends.
std::optional<Question> ScannedArchive::question_of_cell(const ImportSettings& settings,
                                                         int axis) const
{
  const bool is_stated = all_grains().cell[static_cast<std::size_t>(axis)] == CellSource::archive;
  auto bed = box_around(frame.grains);
  if (is_stated && !ends_before(bed, all_grains(), axis)) return std::nullopt;
  if (roster_) {
    bed = roster_->bed;
  } else {
    try {
      bed = read_roster(settings).bed;
    } catch (const ToolError&) {  // the import reports the error when it reads that frame
    }
  }
  if (is_stated && !ends_before(bed, all_grains(), axis)) return std::nullopt;
  const char name = "xyz"[axis];
  const auto what = fmt::format("the ends of the bed along {}", name);
  if (const auto period = suggested_period(frame, axis))
    return Question{
        what, "--cell " + ToldCell{axis, period->low, period->high, true}.text(),
        fmt::format("{} contacts of the first frame join grains of opposite ends, so the cell is "
                    "periodic; the period follows from them, give the exact one if you know it",
                    period->contacts)};
  const auto box =
      is_stated ? fmt::format("the archive's box ends at {:.6g} and {:.6g}, behind all grains",
                              all_grains().low[axis], all_grains().high[axis])
                : "the archive states no cell, or one fitted to its grains";
  return Question{what, "--cell " + ToldCell{axis, bed.min()[axis], bed.max()[axis], false}.text(),
                  box + "; this is the grains' extent over all frames"};
}

/// Asks for the bounds of the cell, which areas and volumes of the bed depend on.
void ScannedArchive::ask_for_the_cell(const ImportSettings& settings, Questions& questions) const
{
  const auto walls = parse_walls(settings.walls);
  for (const int direction : {0, 2}) {
    const auto axis = facts.orientation.axes.axis_of(direction);
    if (!axis || (direction == 2 && facts.dimension == 2) || between_walls(walls, *axis)) continue;
    const auto k = static_cast<std::size_t>(*axis);
    if (all_grains().cell[k] == CellSource::told || all_grains().periodic[k]) continue;
    if (auto question = question_of_cell(settings, *axis)) questions.ask(std::move(*question));
  }
}

ScannedArchive scan(const ImportSettings& settings, Scan how_far)
{
  Questions questions;
  const auto proposed = with_proposed_files(settings, questions);
  if (how_far == Scan::first_frames) try {
      return ScannedArchive(proposed, nullptr, questions);
    } catch (const OtherGrains&) {
    } catch (const UsageError&) {
      if (!grains_change_early(proposed)) throw;
    }
  return ScannedArchive(proposed, std::make_shared<const Roster>(read_roster(proposed)), questions);
}

}  // namespace grseg
