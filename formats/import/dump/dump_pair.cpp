// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/import/dump/dump_pair.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace grseg {
namespace {

constexpr std::size_t enough_steps = 3;  // for a sentence

/// From the first two blocks, read ahead of the import.
std::optional<double> step_by_times(const std::vector<std::string>& files)
{
  JoinedDumps dump(files);
  if (!dump.next() || !dump.header().time) return std::nullopt;
  const auto first = dump.header();
  if (!dump.next() || !dump.header().time) return std::nullopt;
  const auto& second = dump.header();
  return (*second.time - *first.time) / static_cast<double>(second.step - first.step);
}

}  // namespace

bool DumpOfJobs::next()
{
  if (!dump.next()) return false;
  const auto step = dump.header().step;
  begins_job = !first_steps.empty() && step <= at.second;
  at.second = step;
  if (first_steps.size() < enough_steps) first_steps.push_back(step);
  return true;
}

namespace {

/// How many jobs have written it, by the headers alone.
int jobs_of(const std::vector<std::string>& files)
{
  DumpOfJobs dump(files);
  int jobs = 1;
  try {
    while (dump.next()) jobs += dump.begins_job ? 1 : 0;
  } catch (const FormatError&) {  // to be reported when it is that block's turn
  }
  return jobs;
}

}  // namespace

DumpPair::DumpPair(const std::vector<std::string>& grain_files,
                   const std::vector<std::string>& contact_files,
                   const std::vector<std::string>& wall_files)
    : grains_(grain_files), contacts_(contact_files)
{
  if (!wall_files.empty()) {
    walls_.emplace(wall_files);
    more_walls_ = true;
  }
  try {
    step_ = step_by_times(grain_files);
  } catch (const FormatError&) {  // to be reported when it is that block's turn
  }
}

bool DumpPair::next()
{
  while (next_pair()) {
    if (!walls_ || walls_have_it()) return any_ = true;
    without_walls_.add(grains_.at.second);
  }
  if (!any_) require_no_steps();
  return false;
}

/// Where all dumps have steps, but none in common.
void DumpPair::require_no_steps()
{
  for (auto* dump : {&grains_, &contacts_})
    while (dump->first_steps.size() < enough_steps && dump->next()) {
    }
  if (grains_.first_steps.empty() || contacts_.first_steps.empty()) return;
  throw FormatError(fmt::format(
      "no step is in all dumps: those of the grains begin with {}, those of the contacts with {}{}; "
      "write them at the same steps",
      fmt::join(grains_.first_steps, ", "), fmt::join(contacts_.first_steps, ", "),
      without_walls_.count > 0 ? ", and those of the contacts with walls are others" : ""));
}

bool DumpPair::walls_have_it()
{
  while (more_walls_ && (!walls_begun_ || walls_->at < grains_.at)) {
    walls_begun_ = true;
    more_walls_ = advance(*walls_);
  }
  return more_walls_ && walls_->at == grains_.at;
}

/// To the next block, or again to one that waits.
bool DumpPair::advance(DumpOfJobs& dump)
{
  if (std::exchange(dump.waits, false)) return true;
  if (!dump.next()) return false;
  if (!dump.begins_job) return true;
  if (!by_jobs_) {
    const auto jobs = jobs_of(grains_.files);
    by_jobs_ = jobs == jobs_of(contacts_.files) && (!walls_ || jobs == jobs_of(walls_->files));
  }
  if (*by_jobs_) ++dump.at.first;
  return true;
}

bool DumpPair::next_pair()
{
  grains_are_new_ = !grains_.waits;
  bool more_grains = advance(grains_);
  bool more_contacts = advance(contacts_);
  while (more_grains || more_contacts) {
    const bool both = more_grains && more_contacts;
    if (both && grains_.at == contacts_.at) return true;
    if (!more_contacts || (both && grains_.at < contacts_.at)) {
      grains_alone_.add(grains_.at.second);
      more_grains = advance(grains_);
      grains_are_new_ = true;
    } else {
      contacts_alone_.add(contacts_.at.second);
      more_contacts = advance(contacts_);
    }
  }
  return false;
}

std::optional<std::string> DumpPair::units() const
{
  const auto &a = grains_.dump.units(), &b = contacts_.dump.units();
  if (a && b && *a != *b)
    throw FormatError(fmt::format(
        "{}: the grains are in units {} and the contacts in units {}: they are not from "
        "the same run",
        contacts_.dump.header().place, in_quotes(*a), in_quotes(*b)));
  return a ? a : b;
}

std::vector<std::string> DumpPair::remarks() const
{
  std::vector<std::string> remarks;
  const auto add = [&](const Unmatched& alone, const char* what, const char* without) {
    if (alone.count > 0)
      remarks.push_back(
          fmt::format("{} moments have {} but no {} and are left out, the first at "
                      "step {}",
                      alone.count, what, without, alone.first));
  };
  add(grains_alone_, "grains", "contacts");
  add(contacts_alone_, "contacts", "grains");
  add(without_walls_, "grains and contacts", "contacts with walls");
  return remarks;
}

}  // namespace grseg
