// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <boost/program_options.hpp>

#include <string>
#include <vector>

namespace grseg {

/// Those that complete options.
std::vector<std::string> shells();

/// What --completion SHELL prints: a script by which that shell completes the options of a tool, the
/// files that options named FILE take, the words that others take (word_option.hpp), and its input
/// files. UsageError for a shell that is not among `shells`.
std::string completion_script(const std::string& shell, const std::string& tool,
                              const boost::program_options::options_description& options);

}  // namespace grseg
