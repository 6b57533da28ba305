// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/import/dump/dump_reader.hpp"

#include <string>
#include <vector>

namespace grseg {

/// Columns of LIGGGHTS's `compute pair/gran/local` as a mapping of contact_columns.hpp. `columns`
/// is
///   the keywords of the compute, in any order: pos,vel,id,force,force_normal,force_tangential,
///     torque,torque_normal,torque_tangential,history,contactArea,delta,contactPoint,ms_id;
///     history:N where the model keeps N values instead of 3;
///   a preset: liggghts-default (25 columns, no keywords), liggghts-full35, forcechain12;
///   a mapping, which is returned unchanged.
/// Columns are written in the order above, whatever the order of the keywords
/// (compute_pair_gran_local.cpp; the manual gives another order). Names like c_cp[13] show which of
/// the compute's columns were dumped. UsageError naming what does not fit: an unknown keyword, ids
/// or force missing or not dumped, another number of columns.
std::string liggghts_mapping(const std::string& columns, const DumpHeader& contacts);

/// A mapping of WallRows for `compute wall/gran/local`: pos holds contact point and grain, id mesh,
/// triangle and grain, and force acts on the grain. "" is pos,id,force, which is needed.
std::string liggghts_wall_mapping(const std::string& columns, const DumpHeader& walls);

/// True for columns of pair/gran/local: all of one compute, c_cp[1] c_cp[2] ..., while LAMMPS takes
/// two, for ids and forces; or with a name that LIGGGHTS alone uses, for the positions of both
/// grains or a contact across a period.
bool are_of_liggghts(const std::vector<std::string>& columns);

/// Presets and lists of keywords that have as many columns as the header.
std::vector<std::string> liggghts_columns_of(const DumpHeader& contacts);

}  // namespace grseg
