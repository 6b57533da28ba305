// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "sim/scene/scene.hpp"

#include <boost/program_options.hpp>

#include <string>

namespace grseg {

/// The scene that `values`, parsed with scene_options(), state: reads every key of the table,
/// checks its range, and sets what follows from other keys where the user gives none (step and
/// solver by accuracy, the mass of a plate). SceneError names the key that is wrong.
Scene resolve_scene(const boost::program_options::variables_map& values);

/// The scene of the file at `path` where `given`, the command line, does not say otherwise; what is
/// wrong in the file is a FormatError with its line.
Scene resolve_scene(const std::string& path, const boost::program_options::variables_map& given);

}  // namespace grseg
