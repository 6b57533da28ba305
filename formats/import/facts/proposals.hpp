// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/import/common/archive.hpp"

#include <optional>
#include <string>
#include <vector>

/// Proposals for facts that an archive does not state, found from its first frames. They are shown
/// to the user, and never used without an answer.
namespace grseg {

/// Gravity in the archive's axes: each component is the median over the moving grains of (force -
/// contact forces)/mass. Empty if forces or masses are missing, or if the columns of contacts are
/// unknown. `mass` and `resting` (may be empty) are by grain.
std::optional<Vec3> suggested_gravity(const ArchiveFrame& frame, const std::vector<double>& mass,
                                      const std::vector<bool>& resting);

/// The bounds of a periodic cell along an axis, from the contacts that join grains at opposite ends.
struct ProposedPeriod {
  double low, high;      // in the archive's units
  std::size_t contacts;  // number of these contacts
};
/// Empty if fewer than two contacts of the frame join grains of opposite ends, or if these disagree
/// about the period.
std::optional<ProposedPeriod> suggested_period(const ArchiveFrame& frame, int axis);

/// The value of --gravity for a vector: "3.8,-9.0,0".
std::string gravity_option(const Vec3& gravity);

/// True for each grain of `first` that is at rest, or moves with exactly the velocity of many others
/// (a lid), also in the `later` frame (may be null). Empty if all grains are, so that base grains cannot be recognised.
std::vector<bool> resting_grains(const ArchiveGrains& first, const ArchiveGrains* later);

/// Asks which grains are the base; proposes the types (or the ids) of which all grains are at rest.
Question question_of_base(const ArchiveGrains& grains, const std::vector<bool>& resting);

/// Asks for the species if diameters do not separate them; proposes one species per type if there
/// are several types, otherwise a single species. `boundary` marks the base; `diameters` lists the
/// sizes.
Question question_of_species(const ArchiveGrains& grains, const std::vector<bool>& boundary,
                             const std::string& diameters);

/// Asks for the axes of the flow; empty if they are probably xy. Proposes the plane that the grains
/// lie in. For grains in space the proposed normal is the axis nearest to gravity; without a
/// gravity vector it is z if y is periodic and z is not. `in_space` treats grains in a plane as
/// grains in space.
std::optional<Question> question_of_axes(const ArchiveFrame& frame, bool in_space,
                                         const std::optional<Vec3>& gravity);

}  // namespace grseg
