// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/import/convert/opened_archive.hpp"

#include "formats/import/convert/imported_bed.hpp"
#include "formats/import/convert/proposed_files.hpp"
#include "formats/import/facts/proposals.hpp"

#include <fmt/format.h>

namespace grseg {
namespace {

/// Where walls bound the flow there need not be one.
bool asks_for_base(const ArchiveGrains& grains, const ArchiveFacts& facts,
                   const ImportSettings& settings)
{
  const auto& species = settings.species;
  return grains.fixed.empty() && !species.boundary && !species.boundary_ids &&
         facts.walls.empty() && settings.walls.empty();
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
  const auto resting = resting_grains_of(settings);
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

/// Where the base is asked for. Without a roster the next moment tells, too: the import will not go
/// on.
std::vector<bool> OpenedArchive::resting_grains_of(const ImportSettings& settings)
{
  if (!asks_for_base(all_grains().grains, archive().facts(), settings)) return {};
  if (roster_) return resting_grains(roster_->all.grains, nullptr);
  const auto first = std::move(moment);
  moment = {};
  const bool more = moments_.next(moment);
  auto resting = resting_grains(first.grains, more ? &moment.grains : nullptr);
  moment = first;
  return resting;
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
    questions.insert(questions.end(), next.questions.begin(), next.questions.end());
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
  if (asks_for_base(grains, archive().facts(), trial)) {
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
