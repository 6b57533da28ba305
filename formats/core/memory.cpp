// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/core/memory.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <limits>

namespace grseg {
namespace {

constexpr double unlimited = std::numeric_limits<double>::infinity();

/// The number that follows the word `key` at the beginning of a line; `otherwise` without one.
double number_after(const std::string& key, const std::string& file, double otherwise)
{
  std::ifstream lines(file);
  for (std::string name, rest; lines >> name && std::getline(lines, rest);)
    if (name == key) return std::strtod(rest.c_str(), nullptr);
  return otherwise;
}

double number_in(const std::string& file, double otherwise)
{
  double number = 0;
  return std::ifstream(file) >> number ? number : otherwise;  // none: "max"
}

/// Bytes that the control group in `folder` leaves, if it has a limit; files that only the cache holds
/// make room.
double left_by(const std::string& folder, const char* limit, const char* usage)
{
  const double used = number_in(folder + usage, 0) -
                      std::max(number_after("inactive_file", folder + "/memory.stat", 0),
                               number_after("total_inactive_file", folder + "/memory.stat", 0));
  return std::max(0.0, number_in(folder + limit, unlimited) - std::max(0.0, used));
}

/// The least that the group `group` and the groups above it leave.
double left_by_all(const std::string& mount, const std::string& group, const char* limit,
                   const char* usage)
{
  double least = left_by(mount, limit, usage);
  for (auto end = group.size(); end > 0 && end != std::string::npos;
       end = group.rfind('/', end - 1))
    least = std::min(least, left_by(mount + group.substr(0, end), limit, usage));
  return least;
}

}  // namespace

double free_memory(const std::string& root)
{
  constexpr double kilobyte = 1024;
  double least = kilobyte * number_after("MemAvailable:", root + "/proc/meminfo", unlimited);
  std::ifstream groups(root + "/proc/self/cgroup");
  for (std::string line; std::getline(groups, line);) {  // hierarchy:controllers:/group
    const auto first = line.find(':'), second = line.find(':', first + 1);
    if (second == std::string::npos) continue;
    const auto controllers = fmt::format(",{},", line.substr(first + 1, second - first - 1));
    const auto group = line.substr(second + 1);
    const auto mount = root + "/sys/fs/cgroup";
    if (controllers == ",,")
      least = std::min(least, left_by_all(mount, group, "/memory.max", "/memory.current"));
    else if (controllers.find(",memory,") != std::string::npos)
      least = std::min(least, left_by_all(mount + "/memory", group, "/memory.limit_in_bytes",
                                          "/memory.usage_in_bytes"));
  }
  return least;
}

}  // namespace grseg
