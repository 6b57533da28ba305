// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/import/dump/dump_parts.hpp"

#include "formats/import/dump/dump_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <optional>

namespace grseg {
namespace {

using FilesByStep = std::multimap<std::int64_t, std::string>;

constexpr std::string_view digits = "0123456789";

/// None where what a file begins with has no header of a dump.
std::optional<std::int64_t> first_step_in(const std::string& start)
{
  constexpr std::string_view item = "ITEM: TIMESTEP";
  const auto at = start.find(item);
  if (!start.starts_with("ITEM: ") || at == std::string::npos) return std::nullopt;
  const auto digit = std::min(start.find_first_not_of("\r\n ", at + item.size()), start.size());
  std::int64_t step = 0;
  const auto [end, error] =
      std::from_chars(start.data() + digit, start.data() + start.size(), step);
  return error == std::errc() ? std::optional(step) : std::nullopt;
}

/// Whether two names differ in one number alone.
bool differ_in_one_number(const std::string& a, const std::string& b)
{
  const auto differ = std::mismatch(a.begin(), a.end(), b.begin(), b.end()).first;
  auto begin = static_cast<std::size_t>(differ - a.begin());
  while (begin > 0 && digits.find(a[begin - 1]) != digits.npos) --begin;
  const auto end_in = [begin](const std::string& name) {
    return std::min(name.find_first_not_of(digits, begin), name.size());
  };
  return a != b && end_in(a) > begin && end_in(b) > begin &&
         a.substr(end_in(a)) == b.substr(end_in(b));
}

void require_one_step(const std::string& file, const std::string& without_header)
{
  DumpReader dump({file});
  if (dump.next() && dump.next())
    throw FormatError(fmt::format(
        "{} has no header, which LAMMPS writes for the first processor alone, and {} has several steps, "
        "so that its rows may be of any; write one file for each step (contacts.*.%.dump), or leave out "
        "the %",
        without_header, file));
}

/// The file with the header of the step that the rows of `file` belong to; "" where there is none.
std::string owner_of(const std::string& file, const FilesByStep& by_step)
{
  for (const auto& [step, owner] : by_step)
    if (differ_in_one_number(owner, file)) return owner;
  return "";
}

/// One list for each processor where as many files begin with each step; otherwise one list.
std::vector<std::vector<std::string>> lists_of(const FilesByStep& by_step)
{
  std::vector<std::vector<std::string>> lists(by_step.count(by_step.begin()->first));
  for (auto at = by_step.begin(); at != by_step.end();) {
    if (by_step.count(at->first) != lists.size()) {
      lists.assign(1, {});
      for (const auto& [step, file] : by_step) lists.front().push_back(file);
      break;
    }
    for (auto& list : lists) list.push_back((at++)->second);
  }
  return lists;
}

}  // namespace

DumpParts parts_of_dump(const std::vector<std::string>& files)
{
  constexpr std::size_t enough = 1024;
  if (files.size() < 2) return {{files}, {}};
  FilesByStep by_step;
  std::vector<std::string> without_header;
  for (const auto& file : files) {
    const auto start = unpacked_start(file, enough);
    if (const auto step = first_step_in(start))
      by_step.emplace(*step, file);
    else if (!start.empty())
      without_header.push_back(file);
  }
  DumpParts parts;
  for (const auto& file : without_header) {
    const auto owner = owner_of(file, by_step);
    if (owner.empty()) return {{files}, {}};  // told when it is read
    if (!parts.more_rows.contains(owner)) require_one_step(owner, file);
    parts.more_rows[owner].push_back(file);
  }
  if (by_step.empty()) return {{files}, {}};
  parts.lists = lists_of(by_step);
  return parts;
}

}  // namespace grseg
