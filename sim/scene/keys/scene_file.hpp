// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <boost/program_options.hpp>

#include <string>
#include <vector>

namespace grseg {

/// Adds the keys of the file at `path` to `values`; what is there already wins. UsageError where
/// the file is missing, FormatError with file, line and remedy where a key is unknown.
void read_scene_file(const std::string& path, boost::program_options::variables_map& values);

/// The same for a scene given as text, which messages call `name`. Keys of `text` that `leave_out`
/// names are passed over.
void read_scene_text(const std::string& text, const std::string& name,
                     const std::vector<std::string>& leave_out,
                     boost::program_options::variables_map& values);

}  // namespace grseg
