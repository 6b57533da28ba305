// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/core/frame.hpp"
#include "formats/import/verify/unlisted_pairs.hpp"

#include <vector>

/// Neighbours without a contact that move as one rigid body: parts of a grain of several spheres,
/// whose inner forces are unknown, or grains of a bed that turns as a plug, as in a drum.
namespace grseg {

/// True if two grains move as one rigid body: they turn alike, and their relative velocity follows
/// from this turning. Without turning, no velocity does; then `joined` grains count as one body if
/// they do not approach or part along their branch.
bool moves_as_one(const Box& box, const Frame<3>& frame, const NearPair& pair, bool joined);

/// Mobile grains in these pairs, as a fraction of all mobile grains.
double part_of_mobile(const Grains& grains, const std::vector<NearPair>& pairs);

/// Removes the pairs that the archive's forces keep together, so that no inner force acts. The
/// accelerations of both grains by Frame::force, and the angular accelerations by the torques of
/// their contacts, are then equal to the accelerations of one turning body, within a tenth of the
/// accelerations that their contacts cause. `inertia` is I/(m r^2).
void remove_plugs(const Grains& grains, const Box& box, const Frame<3>& frame, double inertia,
                  std::vector<NearPair>& pairs);

}  // namespace grseg
