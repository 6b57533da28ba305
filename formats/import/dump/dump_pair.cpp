// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/import/dump/dump_pair.hpp"

#include <fmt/format.h>

namespace grseg {
namespace {

/// From the first two blocks, read ahead of the import.
std::optional<double> step_by_times(const std::vector<std::string>& files)
{
  DumpReader dump(files);
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
    if (!walls_ || walls_have(grains_.header().step)) return true;
    without_walls_.add(grains_.header().step);
  }
  return false;
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
  bool more_grains = grains_.next(), more_contacts = contacts_.next();
  while (more_grains || more_contacts) {
    const bool both = more_grains && more_contacts;
    const auto g = grains_.header().step, c = contacts_.header().step;
    if (both && g == c) return true;
    if (!more_contacts || (both && g < c)) {
      grains_alone_.add(g);
      more_grains = grains_.next();
    } else {
      contacts_alone_.add(c);
      more_contacts = contacts_.next();
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
