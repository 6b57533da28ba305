// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/import/common/file_list.hpp"

#include "formats/core/errors.hpp"
#include "formats/core/files.hpp"

#include <fmt/format.h>
#include <glob.h>

#include <algorithm>
#include <filesystem>

namespace grseg {
namespace {

bool is_digit(char c)
{
  return c >= '0' && c <= '9';
}

/// The run of digits at `at`, without leading zeros; moves `at` behind it.
std::string number_at(const std::string& text, std::size_t& at)
{
  const auto begin = at;
  while (at < text.size() && is_digit(text[at])) ++at;
  const auto digits = text.substr(begin, at - begin);
  return digits.substr(std::min(digits.find_first_not_of('0'), digits.size()));
}

/// `%` stands for the number of a processor unless it is part of a name.
std::vector<std::string> matches_of(std::string pattern)
{
  glob_t found{};
  std::vector<std::string> names;
  if (glob(pattern.c_str(), 0, nullptr, &found) == 0)
    names.assign(found.gl_pathv, found.gl_pathv + found.gl_pathc);
  globfree(&found);
  if (!names.empty() || pattern.find('%') == std::string::npos) return names;
  std::replace(pattern.begin(), pattern.end(), '%', '*');
  return matches_of(std::move(pattern));
}

}  // namespace

bool natural_less(const std::string& a, const std::string& b)
{
  std::size_t i = 0, j = 0;
  while (i < a.size() && j < b.size()) {
    if (is_digit(a[i]) && is_digit(b[j])) {
      const auto x = number_at(a, i), y = number_at(b, j);
      if (x.size() != y.size()) return x.size() < y.size();
      if (x != y) return x < y;
    } else if (a[i] != b[j]) {
      return a[i] < b[j];
    } else {
      ++i;
      ++j;
    }
  }
  return a.size() - i < b.size() - j;
}

std::vector<std::string> files_meant(const std::vector<std::string>& names)
{
  auto files = names;
  for (const auto& name : names) {
    const auto found = matches_of(name);
    files.insert(files.end(), found.begin(), found.end());
  }
  return files;
}

std::vector<std::string> archive_files(const std::vector<std::string>& names,
                                       const std::string& option)
{
  if (names.empty()) throw UsageError(fmt::format("name files with {}", option));
  std::vector<std::string> files;
  for (const auto& name : names) {
    if (name.find_first_of("*%") == std::string::npos || std::filesystem::exists(name)) {
      require_file(name);
      files.push_back(name);
      continue;
    }
    const auto found = matches_of(name);
    if (found.empty()) throw UsageError(fmt::format("{} {}: no file matches", option, name));
    files.insert(files.end(), found.begin(), found.end());
  }
  std::stable_sort(files.begin(), files.end(), natural_less);
  return files;
}

}  // namespace grseg
