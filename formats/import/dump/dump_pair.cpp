// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/import/dump/dump_pair.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>

namespace grseg {
namespace {

using FilesByStep = std::multimap<std::int64_t, std::string>;

constexpr std::string_view digits = "0123456789";

/// The first step of a dump, from the beginning of the file; empty if this has no header of a dump.
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

/// True if two names differ in exactly one number.
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
        "{} has no header, because LAMMPS writes it only for the first processor, and {} has "
        "several steps, so the step of the rows is unknown; write one file for each step "
        "(contacts.*.%.dump), or leave out the %",
        without_header, file));
}

/// The file that has the header for the rows of `file`; "" if there is none.
std::string owner_of(const std::string& file, const FilesByStep& by_step)
{
  for (const auto& [step, owner] : by_step)
    if (differ_in_one_number(owner, file)) return owner;
  return "";
}

/// A list of files per processor if every first step has equally many files; otherwise one list.
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

void require_same_rows(const DumpHeader& a, const DumpHeader& b)
{
  if (a.step == b.step && a.columns == b.columns) return;
  const auto in_words = [](const DumpHeader& header) {
    return fmt::format("{} has step {} with the columns {}", header.place, header.step,
                       fmt::join(header.columns, " "));
  };
  throw FormatError(
      fmt::format("{}, and {}: these files begin with the same step, but are not parts of one "
                  "dump; name the files of one dump only",
                  in_words(a), in_words(b)));
}

/// The files of a dump, in the order in which they have to be read.
struct DumpParts {
  /// One list of files in order of their first steps; or one list per processor, if several
  /// processors wrote files that begin with the same steps (% in the name of the dump).
  std::vector<std::vector<std::string>> lists;
  // Files with further rows of a step, by the file that has the header of the step.
  std::map<std::string, std::vector<std::string>> more_rows;
};

/// Sorts the files of a dump. Throws FormatError if the step of rows without a header is unknown.
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
    if (owner.empty()) return {{files}, {}};  // the reader reports the missing header
    if (!parts.more_rows.contains(owner)) require_one_step(owner, file);
    parts.more_rows[owner].push_back(file);
  }
  if (by_step.empty()) return {{files}, {}};
  parts.lists = lists_of(by_step);
  return parts;
}

/// Length of a time step, from the first two blocks; empty if they have no times.
std::optional<double> step_by_times(const std::vector<std::string>& files)
{
  JoinedDumps dump(files);
  if (!dump.next() || !dump.header().time) return std::nullopt;
  const auto first = dump.header();
  if (!dump.next() || !dump.header().time) return std::nullopt;
  const auto& second = dump.header();
  return (*second.time - *first.time) / static_cast<double>(second.step - first.step);
}

/// Number of jobs that wrote a dump, found from the headers.
int jobs_of(const std::vector<std::string>& files)
{
  DumpOfJobs dump(files);
  int jobs = 1;
  try {
    while (dump.next()) jobs += dump.begins_job ? 1 : 0;
  } catch (const FormatError&) {  // the import reports the error when it reads that block
  }
  return jobs;
}

}  // namespace

JoinedDumps::JoinedDumps(const std::vector<std::string>& files)
{
  auto parts = parts_of_dump(files);
  for (auto& list : parts.lists) parts_.emplace_back(std::move(list));
  more_rows_ = std::move(parts.more_rows);
}

bool JoinedDumps::next()
{
  const DumpReader *first = nullptr, *ended = nullptr;
  std::size_t rows = 0;
  for (auto& part : parts_) {
    if (!part.next()) {
      ended = &part;
      continue;
    }
    if (first == nullptr) first = &part;
    require_same_rows(first->header(), part.header());
    rows += part.header().rows;
  }
  if (first == nullptr) return false;
  header_ = first->header();
  header_.rows = rows;
  if (ended != nullptr)
    throw TruncatedArchive(fmt::format(
        "{}: this part of the dump ends behind step {}, and {} goes on; copy it again, or leave "
        "out the incomplete frame with --drop-incomplete",
        ended->header().place, ended->header().step, header_.place));
  return true;
}

void JoinedDumps::read_rows(std::span<const std::size_t> wanted,
                            std::vector<std::vector<double>>& values, const TypeColumn& types)
{
  values.resize(wanted.size());
  for (auto& column : values) column.clear();
  for (auto& part : parts_) {
    part.read_rows(wanted, values, types);
    const auto more = more_rows_.find(part.header().file);
    if (more == more_rows_.end()) continue;
    DumpReader(more->second, part.header()).read_rows(wanted, values, types);
  }
}

bool DumpOfJobs::next()
{
  const bool is_first = dump.header().columns.empty();
  if (!dump.next()) return false;
  const auto step = dump.header().step;
  begins_job = !is_first && step <= at.second;
  at.second = step;
  return true;
}

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
  } catch (const FormatError&) {  // the import reports the error when it reads that block
  }
}

bool DumpPair::next()
{
  const auto step_of = [](const DumpOfJobs& dump) {
    return [&dump] { return std::to_string(dump.at.second); };
  };
  const auto next_grains = [this] {
    grains_are_new_ = !grains_.waits;
    return advance(grains_);
  };
  const auto order = [this] {
    return grains_.at < contacts_.at ? -1 : grains_.at > contacts_.at ? 1 : 0;
  };
  while (matching_.next({next_grains, step_of(grains_)},
                        {[this] { return advance(contacts_); }, step_of(contacts_)}, order, true)) {
    if (!walls_ || walls_have_it()) return any_ = true;
    without_walls_.add(std::to_string(grains_.at.second));
  }
  if (!any_ && without_walls_.count > 0)
    throw FormatError(fmt::format(
        "no step is in all dumps: steps {} of grains and contacts are not in the dump of contacts "
        "with walls; write all dumps at the same steps",
        fmt::join(without_walls_.first, ", ")));
  return false;
}

bool DumpPair::walls_have_it()
{
  while (more_walls_ && (!walls_begun_ || walls_->at < grains_.at)) {
    walls_begun_ = true;
    more_walls_ = advance(*walls_);
  }
  return more_walls_ && walls_->at == grains_.at;
}

/// Advances to the next block, unless the current block is to be used again.
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
  auto remarks = matching_.remarks("step");
  add_remark(remarks, without_walls_, "grains and contacts", "contacts with walls", "step");
  return remarks;
}

}  // namespace grseg
