// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/output.hpp"

#include "formats/tool.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <filesystem>
#include <utility>

namespace grseg {

std::string name_beside(const std::string& place)
{
  return fmt::format("{}.tmp.{}", place, getpid());
}

Output::Output(std::string place, bool overwrite)
    : place_(std::move(place)), beside_(name_beside(place_))
{
  refuse_to_overwrite(place_, overwrite);
}

Output::~Output()
{
  std::error_code ignored;
  std::filesystem::remove(beside_, ignored);
}

void Output::publish()
{
  publish_file(beside_, place_);
}

}  // namespace grseg
