// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/core/free_memory.hpp"

#include <cstdlib>
#include <fstream>
#include <limits>
#include <string>

namespace grseg {

double free_memory()
{
  std::ifstream lines("/proc/meminfo");
  for (std::string name, rest; lines >> name && std::getline(lines, rest);)
    if (name == "MemAvailable:") return 1024 * std::strtod(rest.c_str(), nullptr);
  return std::numeric_limits<double>::infinity();
}

}  // namespace grseg
