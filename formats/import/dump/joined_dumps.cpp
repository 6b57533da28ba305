// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/import/dump/joined_dumps.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace grseg {
namespace {

void require_same_rows(const DumpHeader& a, const DumpHeader& b)
{
  if (a.step == b.step && a.columns == b.columns) return;
  const auto in_words = [](const DumpHeader& header) {
    return fmt::format("{} has step {} with the columns {}", header.place, header.step,
                       fmt::join(header.columns, " "));
  };
  throw FormatError(
      fmt::format("{}, and {}: these files begin with the same step, but are not the parts of one "
                  "dump; name one dump alone",
                  in_words(a), in_words(b)));
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
        "{}: this part of the dump ends behind step {}, and {} goes on; copy it again, or leave out "
        "the incomplete moment with --drop-incomplete",
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

}  // namespace grseg
