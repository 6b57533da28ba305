// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/import/common/archive.hpp"

#include <optional>
#include <string>

namespace grseg {

/// Whether the flow is one in the plane of `axes` (two letters) or in space, by the grains of the
/// first moment: 2 where their centres lie in this plane, to a tenth of the largest radius, 3 where
/// they do not and are spheres. `asked` takes spheres that lie in a plane for a flow in space.
/// UsageError where it contradicts the grains, where discs lie apart, or where spheres lie in
/// another plane of the archive's axes, which may be the one that was meant.
int dimension_of(const ArchiveMoment& first, const std::string& axes, bool discs,
                 std::optional<int> asked);

/// The plane of two axes in which grains lie, to a tenth of the largest radius, as --axes would name
/// it; "" where they lie in none.
std::string plane_of(const ArchiveGrains& grains);

}  // namespace grseg
