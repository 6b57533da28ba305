// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/import/common/archive.hpp"

#include <optional>
#include <string>
#include <vector>

/// Proposals from the first moments of an archive for facts that it does not state. They are shown
/// to the user, and never assumed.
namespace grseg {

/// Gravity along the archive's axes, each component the median over the moving grains of (force -
/// contact forces)/mass. None where forces or masses are missing or contacts are not understood.
/// `mass` holds the mass of each grain; `resting` may be empty.
std::optional<Vec3> suggested_gravity(const ArchiveMoment& moment, const std::vector<double>& mass,
                                      const std::vector<bool>& resting);

/// "3.8,-9.0,0", as --gravity takes it.
std::string gravity_option(const Vec3& gravity);

/// Which grains of `first` stay where they are while others move, seen at a `later` moment, too,
/// where there is one; empty where nothing moves, so that it cannot be told.
std::vector<bool> resting_grains(const ArchiveGrains& first, const ArchiveGrains* later);

/// Which grains are the base: types, or ids, of which all grains are at rest.
Question question_of_base(const ArchiveGrains& grains, const std::vector<bool>& resting);

/// How species are told apart where diameters do not: by types, where there are several, or all
/// as one. `boundary` marks the base; `diameters` says what sizes there are.
Question question_of_species(const ArchiveGrains& grains, const std::vector<bool>& boundary,
                             const std::string& diameters);

/// The axes of the flow where they are not x and y: the plane that the grains lie in, or, for
/// grains in space, the axis that gravity is nearest to as the normal; where gravity is not known as
/// a vector, z if y is periodic and z is not. None where --axes xy does. `in_space`: also grains that
/// lie in a plane are in space.
std::optional<Question> question_of_axes(const ArchiveMoment& moment, bool in_space,
                                         const std::optional<Vec3>& gravity);

}  // namespace grseg
