// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/core/parameters.hpp"
#include "sim/scene/keys/keys.hpp"

#include <string>

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

}  // namespace grseg
