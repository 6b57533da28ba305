// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/import/common/archive.hpp"

#include <memory>

namespace grseg {

/// `dump custom` of grains beside `dump local` of `compute pair/gran/local`, as LIGGGHTS writes
/// them (compute_pair_gran_local.cpp; liggghts_columns.hpp for its columns). Without --columns a
/// dump of 12, 25 or 35 columns is assumed to be the preset of that size; the grains' balance
/// verifies it. `force` is the whole force on the first of the two ids. Text has 6 digits unless
/// dump_modify says otherwise, so `delta` is used as the overlap where it is dumped. Contacts with
/// meshes are the rows of another dump, of `compute wall/gran/local`; those with primitive walls are in
/// none.
std::unique_ptr<Archive> open_liggghts(const ArchiveFiles& files);

extern const ArchiveFormat liggghts_format;

}  // namespace grseg
