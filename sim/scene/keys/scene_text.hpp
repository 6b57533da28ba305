// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/core/parameters.hpp"
#include "sim/scene/keys/keys.hpp"

#include <boost/program_options.hpp>

#include <string>
#include <vector>

namespace grseg {

/// The scene as a file that gives the same run: every key in SI but those of KeyRole::machine.
std::string to_text(const Scene& scene);

/// What /parameters of a trajectory states of the scene.
Parameters to_parameters(const Scene& scene);

/// `now` with the values of `before` where both are the same up to round-off: 70 d_S of 5 mm are 350 mm,
/// but for the last bit.
Scene without_round_off(Scene now, const Scene& before);

/// The first key of `role` in which the scenes differ, or "".
std::string differing_key(const Scene& a, const Scene& b, KeyRole role);

/// Adds the keys of the file at `path` to `values`; what is there already wins. UsageError where
/// the file is missing, FormatError with file, line and remedy where a key is unknown.
void read_scene_file(const std::string& path, boost::program_options::variables_map& values);

/// The same for a scene given as text, which messages call `name`. Keys of `text` that `leave_out`
/// names are passed over.
void read_scene_text(const std::string& text, const std::string& name,
                     const std::vector<std::string>& leave_out,
                     boost::program_options::variables_map& values);

/// The scene of the file at `path` where `given`, the command line, does not say otherwise; what is
/// wrong in the file is a FormatError with its line.
Scene resolve_scene(const std::string& path, const boost::program_options::variables_map& given);

}  // namespace grseg
