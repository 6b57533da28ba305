// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <boost/program_options.hpp>

#include <span>
#include <string>

namespace grseg {

/// What --completion SHELL prints: a script by which that shell completes the options of a tool, the
/// files that options named FILE take, and its input files. UsageError for another shell than bash
/// and zsh.
std::string completion_script(const std::string& shell, const std::string& tool,
                              const boost::program_options::options_description& options);

}  // namespace grseg
