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
    if (!walls_ || walls_have(grains_.header().step)) return any_ = true;
    without_walls_.add(grains_.header().step);
  }
  if (!any_) require_no_steps();
  return false;
}

/// Where all dumps have steps, but none in common.
void DumpPair::require_no_steps()
{
  for (auto [dump, steps] : {std::pair{&grains_, &grain_steps_}, {&contacts_, &contact_steps_}})
    while (steps->size() < enough_steps && dump->next()) steps->push_back(dump->header().step);
  if (grain_steps_.empty() || contact_steps_.empty()) return;
  throw FormatError(fmt::format(
      "no step is in all dumps: those of the grains begin with {}, those of the contacts with {}{}; "
      "write them at the same steps",
      fmt::join(grain_steps_, ", "), fmt::join(contact_steps_, ", "),
      without_walls_.count > 0 ? ", and those of the contacts with walls are others" : ""));
}

bool DumpPair::walls_have(std::int64_t step)
{
  while (more_walls_ && (!walls_begun_ || walls_->header().step < step)) {
    walls_begun_ = true;
    more_walls_ = walls_->next();
  }
  return more_walls_ && walls_->header().step == step;
}

bool DumpPair::next_pair()
{
  const auto next_of = [](JoinedDumps& dump, std::vector<std::int64_t>& steps) {
    const bool more = dump.next();
    if (more && steps.size() < enough_steps) steps.push_back(dump.header().step);
    return more;
  };
  bool more_grains = next_of(grains_, grain_steps_);
  bool more_contacts = next_of(contacts_, contact_steps_);
  while (more_grains || more_contacts) {
    const bool both = more_grains && more_contacts;
    const auto g = grains_.header().step, c = contacts_.header().step;
    if (both && g == c) return true;
    if (!more_contacts || (both && g < c)) {
      grains_alone_.add(g);
      more_grains = next_of(grains_, grain_steps_);
    } else {
      contacts_alone_.add(c);
      more_contacts = next_of(contacts_, contact_steps_);
    }
  }
  return false;
}

std::optional<std::string> DumpPair::units() const
{
  const auto &a = grains_.units(), &b = contacts_.units();
  if (a && b && *a != *b)
    throw FormatError(fmt::format(
        "{}: the grains are in units {} and the contacts in units {}: they are not from "
        "the same run",
        contacts_.header().place, in_quotes(*a), in_quotes(*b)));
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
