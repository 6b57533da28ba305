// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/import/convert/opened_archive.hpp"

#include "formats/import/convert/imported_bed.hpp"
#include "formats/import/convert/proposed_files.hpp"
#include "formats/import/facts/proposals.hpp"

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

}  // namespace

OpenedArchive::OpenedArchive(const ImportSettings& settings, const std::string& columns,
                             std::shared_ptr<const Roster> roster, Questions questions)
    : moments_(settings, columns), roster_(std::move(roster))
{
  if (!moments_.next(moment))
    throw FormatError("the archive holds no moment with grains and contacts");
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
    if (resting.empty())
      trial.origin = "0";
    else
      propose_base(question_of_base(grains, resting), trial.species);
  }
  try {
    questions.collect([&] { ImportedBed(all_grains(), facts, trial); });
  } catch (const ToolError&) {
    if (!questions.any()) throw;
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
