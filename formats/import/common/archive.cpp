// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/import/common/archive.hpp"

#include "formats/core/text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

namespace grseg {
namespace {

constexpr std::size_t enough_frames = 3;  // frames listed in a message

std::string sentence_of(const std::vector<Question>& questions)
{
  std::string text = "the archive leaves open what an import needs to know:";
  for (const auto& [what, option, reason] : questions)
    text += fmt::format("\n  {}: {}{}", what, option,
                        reason.empty() ? "" : fmt::format("  ({})", reason));
  return text;
}

}  // namespace

OpenQuestions::OpenQuestions(std::vector<Question> open)
    : UsageError(sentence_of(open)), questions(std::move(open))
{
}

std::string OpenQuestions::options() const
{
  std::string text;
  for (const auto& question : questions) text += (text.empty() ? "" : " ") + question.option;
  return text;
}

Vec3 ArchiveFrame::minimum_image(Vec3 between) const
{
  for (int axis = 0; axis < 3; ++axis) {
    const double length = high[axis] - low[axis];
    if (periodic[static_cast<std::size_t>(axis)] && length > 0)
      between[axis] -= length * std::round(between[axis] / length);
  }
  return between;
}

int digits_of(const std::vector<Vec3>& values)
{
  constexpr std::size_t enough = 1000;
  constexpr int most = 17;
  int digits = 0;
  for (std::size_t k = 0; k < std::min(enough, values.size()); ++k)
    for (const double value : values[k])
      while (value != 0 && digits < most &&
             (digits == 0 || parse_number(fmt::format("{:.{}e}", value, digits - 1)) != value))
        ++digits;
  return digits;
}

std::unordered_map<std::int64_t, std::size_t> rows_by_id(const ArchiveGrains& grains)
{
  std::unordered_map<std::int64_t, std::size_t> rows;
  rows.reserve(grains.size());
  for (std::size_t g = 0; g < grains.size(); ++g) rows[grains.id[g]] = g;
  return rows;
}

std::string hint_of_digits(std::int64_t id)
{
  constexpr std::int64_t beyond_six_digits = 1'000'000;
  return id >= beyond_six_digits && id % 10 == 0
             ? "; was it written with six digits, as by %g? Write ids as whole numbers, as by %d"
             : "";
}

Eigen::AlignedBox3d box_around(const ArchiveGrains& grains)
{
  Eigen::AlignedBox3d box;
  for (std::size_t g = 0; g < grains.size(); ++g) {
    const Vec3 reach = Vec3::Constant(grains.radius.empty() ? 0 : grains.radius[g]);
    box.extend(grains.position[g] - reach).extend(grains.position[g] + reach);
  }
  return box;
}

void enclose_grains(ArchiveFrame& frame)
{
  const auto bed = box_around(frame.grains);
  for (int axis = 0; axis < 3; ++axis) {
    if (frame.periodic[static_cast<std::size_t>(axis)]) continue;
    frame.low[axis] = bed.min()[axis];
    frame.high[axis] = bed.max()[axis];
    frame.cell[static_cast<std::size_t>(axis)] = CellSource::grains;
  }
}

void Unmatched::add(const std::string& when)
{
  ++count;
  if (first.size() < enough_frames) first.push_back(when);
}

bool Matching::next(const Table& grains, const Table& contacts, const std::function<int()>& order,
                    bool to_the_end)
{
  const auto pass = [](const Table& table, Unmatched& alone) {
    alone.add(table.now());
    return table.next();
  };
  bool more_grains = grains.next(), more_contacts = contacts.next();
  while (more_grains && more_contacts) {
    const int where = order();
    if (where == 0) return any_of_both_ = true;
    if (where < 0)
      more_grains = pass(grains, grains_alone_);
    else
      more_contacts = pass(contacts, contacts_alone_);
  }
  const auto goes_on = [&](const Unmatched& alone) {
    return to_the_end || (!any_of_both_ && alone.first.size() < enough_frames);
  };
  while (more_grains && goes_on(grains_alone_)) more_grains = pass(grains, grains_alone_);
  while (more_contacts && goes_on(contacts_alone_)) more_contacts = pass(contacts, contacts_alone_);
  if (!any_of_both_ && grains_alone_.count > 0 && contacts_alone_.count > 0)
    throw FormatError(
        fmt::format("no frame is in both tables: the grains begin with {}, the contacts with {}; "
                    "write both at the same times",
                    fmt::join(grains_alone_.first, ", "), fmt::join(contacts_alone_.first, ", ")));
  return false;
}

void add_remark(std::vector<std::string>& remarks, const Unmatched& alone, const char* what,
                const char* without, const char* unit)
{
  if (alone.count > 0)
    remarks.push_back(
        fmt::format("{} frames have {} but no {} and are left out, the first at {} {}", alone.count,
                    what, without, unit, alone.first[0]));
}

std::vector<std::string> Matching::remarks(const char* unit) const
{
  std::vector<std::string> remarks;
  add_remark(remarks, grains_alone_, "grains", "contacts", unit);
  add_remark(remarks, contacts_alone_, "contacts", "grains", unit);
  return remarks;
}

}  // namespace grseg
