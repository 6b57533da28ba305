// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/import/csv/csv_files.hpp"

#include "formats/import/common/file_list.hpp"

#include <charconv>
#include <cmath>
#include <filesystem>
#include <string_view>

namespace grseg {
namespace {

constexpr std::string_view digits = "0123456789";

/// What the last `*` of one of the patterns stands for in `path`; otherwise its name without
/// endings.
std::string moment_in(const std::string& path, const std::vector<std::string>& patterns)
{
  for (const auto& pattern : patterns) {
    const auto star = pattern.rfind('*');
    if (star == std::string::npos || pattern.find('*') != star) continue;
    const std::string_view before(pattern.data(), star), after(pattern.data() + star + 1);
    if (path.size() >= before.size() + after.size() && path.starts_with(before) &&
        path.ends_with(after))
      return path.substr(before.size(), path.size() - before.size() - after.size());
  }
  auto name = std::filesystem::path(path).filename().string();
  for (const std::string_view ending : {".csv", ".txt", ".tsv", ".dat"})
    if (const auto at = name.find(ending); at != std::string::npos) return name.substr(0, at);
  return name;
}

void read_moment(const std::string& text, CsvFile& file)
{
  double time = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), time);
  if (error == std::errc() && end == text.data() + text.size() && std::isfinite(time) &&
      text.find('.') != std::string::npos) {
    file.time = time;
    return;
  }
  const auto last = text.find_last_of(digits);
  if (last == std::string::npos) return;
  const auto before = text.find_last_not_of(digits, last);
  const auto first = before == std::string::npos ? 0 : before + 1;
  std::int64_t step = 0;
  if (std::from_chars(text.data() + first, text.data() + last + 1, step).ec == std::errc())
    file.step = step;
}

}  // namespace

std::vector<CsvFile> csv_files(const std::vector<std::string>& names, const std::string& option)
{
  std::vector<CsvFile> files;
  for (const auto& path : archive_files(names, option)) {
    files.push_back({path, std::nullopt, std::nullopt});
    read_moment(moment_in(path, names), files.back());
  }
  return files;
}

}  // namespace grseg
