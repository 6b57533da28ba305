// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/import/convert/opened_archive.hpp"

#include "formats/import/convert/imported_bed.hpp"
#include "formats/import/convert/proposed_files.hpp"
#include "formats/import/facts/proposals.hpp"
#include "formats/import/open_archive.hpp"

namespace grseg {
namespace {

bool asks_for_base(const ArchiveGrains& grains, const SpeciesSettings& settings)
{
  return grains.fixed.empty() && !settings.boundary && !settings.boundary_ids;
}

/// Settings as if the proposal were accepted: "--boundary 3" or "--boundary-ids 1-35".
void propose_base(const Question& question, SpeciesSettings& settings)
{
  const auto blank = question.option.find(' ');
  settings.boundary.reset();
  (question.option.starts_with("--boundary-ids") ? settings.boundary_ids : settings.boundary) =
      question.option.substr(blank + 1);
}

ArchiveFiles with_columns(ArchiveFiles files, const std::string& columns)
{
  files.columns = columns;
  return files;
}

}  // namespace

OpenedArchive::OpenedArchive(const ImportSettings& settings, const std::string& columns)
    : drop_incomplete_(settings.drop_incomplete)
{
  Questions questions;
  const auto proposed = with_proposed_files(settings, questions);
  archive = open_archive(proposed.format, with_columns(proposed.files, columns));
  if (!next()) throw FormatError("the archive holds no moment with grains and contacts");
  for (const auto& question : moment.questions) questions.ask(question);
  const auto resting = resting_at_first(settings.species);
  facts = collect_facts(archive->facts(), moment, resting, proposed, questions);
  ask_for_the_bed(proposed, resting, questions);
  questions.report();
}

/// Where the base is asked for, looks at the next moment, too: the import will not go on.
std::vector<bool> OpenedArchive::resting_at_first(const SpeciesSettings& settings)
{
  if (!asks_for_base(moment.grains, settings)) return {};
  const auto first = std::move(moment);
  moment = {};
  const bool more = next();
  auto resting = resting_grains(first.grains, more ? &moment.grains : nullptr);
  moment = first;
  return resting;
}

/// What species and origin leave open. Where other answers are missing, what else is wrong may come
/// from that.
void OpenedArchive::ask_for_the_bed(const ImportSettings& settings,
                                    const std::vector<bool>& resting, Questions& questions) const
{
  auto trial = settings;
  auto& species = trial.species;
  if (asks_for_base(moment.grains, species)) {
    species.boundary = "none";
    trial.origin = "0";
    if (!resting.empty()) propose_base(question_of_base(moment.grains, resting), species);
    if (!resting.empty()) trial.origin = settings.origin;
  }
  try {
    questions.collect([&] { ImportedBed(moment, facts, trial); });
  } catch (const ToolError&) {
    if (!questions.any()) throw;
  }
}

bool OpenedArchive::next()
{
  try {
    return archive->next(moment);
  } catch (const TruncatedArchive&) {
    if (!drop_incomplete_) throw;
    return false;
  }
}

}  // namespace grseg
