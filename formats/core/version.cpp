// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/core/version.hpp"

#include "git_hash.hpp"

#include <fmt/format.h>

namespace grseg {

std::string version()
{
  return GRSEG_VERSION;
}

std::string version_with_hash()
{
  return fmt::format("{} ({})", GRSEG_VERSION, GRSEG_GIT_HASH);
}

}  // namespace grseg
