// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/import/dump/dump_reader.hpp"

#include <string>
#include <vector>

namespace grseg {

/// Converts columns of LIGGGHTS' `compute pair/gran/local` to a mapping (contact_columns.hpp).
/// `columns` is one of
///   the keywords of the compute, in any order: pos,vel,id,force,force_normal,force_tangential,
///     torque,torque_normal,torque_tangential,history,contactArea,delta,contactPoint,ms_id;
///     history:N if the contact model stores N values instead of 3;
///   a preset: liggghts-default (25 columns, no keywords), liggghts-full35, forcechain12;
///   a mapping, which is returned unchanged.
/// LIGGGHTS writes the columns in the order above, for any order of the keywords
/// (compute_pair_gran_local.cpp; the manual lists another order). Names like c_cp[13] show which of
/// the compute's columns were dumped. Throws UsageError naming the reason if a keyword is unknown,
/// if ids or force are missing or not dumped, or if the number of columns differs.
std::string liggghts_mapping(const std::string& columns, const DumpHeader& contacts);

/// The mapping of WallRows for `compute wall/gran/local`. Its pos contains contact point and centre
/// of the grain, its id the ids of mesh, triangle and grain, and its force acts on the grain.
/// `columns` must include pos, id and force; "" means pos,id,force.
std::string liggghts_wall_mapping(const std::string& columns, const DumpHeader& walls);

/// True for columns of LIGGGHTS' pair/gran/local: all columns of one compute, c_cp[1] c_cp[2] ...,
/// whereas LAMMPS needs two computes, for ids and forces; or a name that only LIGGGHTS uses, for
/// the positions of both grains or for a contact across a periodic boundary.
bool are_of_liggghts(const std::vector<std::string>& columns);

/// Presets and lists of keywords with the same number of columns as the header.
std::vector<std::string> liggghts_columns_of(const DumpHeader& contacts);

}  // namespace grseg
