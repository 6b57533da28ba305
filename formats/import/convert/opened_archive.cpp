// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/import/convert/opened_archive.hpp"

#include "formats/import/convert/imported_bed.hpp"
#include "formats/import/convert/proposed_files.hpp"
#include "formats/import/facts/proposals.hpp"
#include "formats/import/facts/told_cell.hpp"
#include "formats/import/facts/wall_planes.hpp"

#include <fmt/format.h>

namespace grseg {
namespace {

/// Where walls bound the flow there need not be one.
bool base_is_open(const ArchiveGrains& grains, const ImportSettings& settings)
{
  const auto& species = settings.species;
  return grains.fixed.empty() && !species.boundary && !species.boundary_ids;
}

/// Settings as if the proposal were accepted: "--boundary 3" or "--boundary-ids 1-35".
void propose_base(const Question& question, SpeciesSettings& settings)
{
  const auto blank = question.option.find(' ');
  settings.boundary.reset();
  (question.option.starts_with("--boundary-ids") ? settings.boundary_ids : settings.boundary) =
      question.option.substr(blank + 1);
}

SpeciesSettings with_one_species(const SpeciesSettings& settings)
{
  SpeciesSettings one;
  one.named = {"grains=all"};
  one.boundary = settings.boundary;
  one.boundary_ids = settings.boundary_ids;
  return one;
}

}  // namespace

OpenedArchive::OpenedArchive(const ImportSettings& settings, const std::string& columns,
                             std::shared_ptr<const Roster> roster, Questions questions)
    : moments_(settings, columns), roster_(std::move(roster))
{
  if (!moments_.next(moment))
    throw FormatError(fmt::format(
        "{}: the archive holds no moment with grains and contacts; is it whole?",
        settings.files.grains.empty() ? settings.files.restart : settings.files.grains.front()));
  if (!roster_ && moment.grains.size() == 0)
    throw OtherGrains(fmt::format("{}: there are no grains", moment.place));
  const auto full = roster_ ? full_moment(settings, columns) : moment;
  for (const auto& question : full.questions) questions.ask(question);
  const auto resting = resting_grains_of(settings, columns);
  facts = collect_facts(archive().facts(), {all_grains(), full, resting}, settings, questions);
  ask_for_the_bed(settings, resting, questions);
  questions.report();
}

bool OpenedArchive::next()
{
  if (!moments_.next(moment)) return false;
  if (!moment.questions.empty()) throw OpenQuestions(moment.questions);
  return true;
}

/// Where nothing says which grains are the base. Without a roster the next moment tells, too.
std::vector<bool> OpenedArchive::resting_grains_of(const ImportSettings& settings,
                                                   const std::string& columns) const
{
  if (!base_is_open(all_grains().grains, settings)) return {};
  if (roster_) return resting_grains(roster_->all.grains, nullptr);
  Moments ahead(settings, columns);
  ArchiveMoment later;
  const bool more = ahead.next_grains(later) && ahead.next_grains(later);
  return resting_grains(moment.grains, more ? &later.grains : nullptr);
}

/// One of the first moments that has half of the grains, or as many as there are; with the questions
/// of all before it.
ArchiveMoment OpenedArchive::full_moment(const ImportSettings& settings,
                                         const std::string& columns) const
{
  constexpr int furthest = 100;
  Moments ahead(settings, columns);
  ArchiveMoment full, next;
  std::vector<Question> questions;
  for (int k = 0; k < furthest && 2 * full.grains.size() < roster_->most && ahead.next(next); ++k) {
    if (questions.empty()) questions = next.questions;
    if (k == 0 || next.grains.size() > full.grains.size()) full = next;
  }
  full.questions = questions;
  return full;
}

/// What species and origin leave open. Where other answers are missing, what else is wrong may come
/// from that.
void OpenedArchive::ask_for_the_bed(const ImportSettings& settings,
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
      propose_base(question, trial.species);
    }
  }
  ask_for_the_cell(settings, questions);
  try {
    questions.collect([&] { ImportedBed(all_grains(), facts, trial); });
    trial.species = with_one_species(trial.species);  // else open species hide an open origin
    questions.collect([&] { ImportedBed(all_grains(), facts, trial); });
  } catch (const ToolError&) {
    if (!questions.any()) throw;
  }
}

/// All moments are read for what is proposed.
Question OpenedArchive::question_of_cell(const ImportSettings& settings, int axis) const
{
  double low = all_grains().low[axis], high = all_grains().high[axis];
  if (!roster_) {
    try {
      const auto all = read_roster(settings).all;
      low = all.low[axis], high = all.high[axis];
    } catch (const ToolError&) {  // to be reported when it is that moment's turn
    }
  }
  const char name = "xyz"[axis];
  return {fmt::format("the ends of the cell along {}", name),
          "--cell " + ToldCell{axis, low, high, false}.text(),
          "the archive states none, or one that follows its grains; this is their extent over all "
          "moments"};
}

/// Areas and volumes are those of the cell.
void OpenedArchive::ask_for_the_cell(const ImportSettings& settings, Questions& questions) const
{
  const auto walls = parse_walls(settings.walls);
  for (const int direction : {0, 2}) {
    const auto axis = facts.orientation.axes.axis_of(direction);
    if (!axis || (direction == 2 && facts.dimension == 2) || between_walls(walls, *axis)) continue;
    if (all_grains().cell[static_cast<std::size_t>(*axis)] == CellSource::grains)
      questions.ask(question_of_cell(settings, *axis));
  }
}

OpenedArchive open_with_roster(const ImportSettings& settings)
{
  Questions questions;
  const auto proposed = with_proposed_files(settings, questions);
  return {proposed, proposed.files.columns, std::make_shared<const Roster>(read_roster(proposed)),
          questions};
}

OpenedArchive open_with_grains(const ImportSettings& settings)
{
  Questions questions;
  const auto proposed = with_proposed_files(settings, questions);
  try {
    return {proposed, proposed.files.columns, nullptr, questions};
  } catch (const OtherGrains&) {
  } catch (const UsageError&) {
    if (!grains_change_early(proposed)) throw;
  }
  return open_with_roster(settings);
}

}  // namespace grseg
