// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/import/common/archive.hpp"

#include <memory>

namespace grseg {

/// `dump custom` of grains beside `dump local` of contacts, as LAMMPS writes them
/// (doc/src/dump.rst, compute_pair_local.rst, pair_gran.rst). Contacts come from two computes with
/// the same `cutoff radius`:
///   compute pr all property/local patom1 patom2 cutoff radius
///   compute pl all pair/local dist fx fy fz p1 p2 p3 cutoff radius
///   dump c all local N contacts.dump index c_pr[1] c_pr[2] c_pl[1] c_pl[2] ... c_pl[7]
/// fx fy fz are the NORMAL part of the force on patom1 alone, p1 p2 p3 the tangential part; the
/// force is their sum. Names like c_pl[3] carry no meaning, so --columns gives it; without it the
/// ten columns above are assumed, which the grains' balance verifies. Columns that are named by what
/// they hold (named_columns.hpp) are recognised. dx dy dz, whose sign depended on tags until 12Jun2025,
/// are never used: the branch is x_patom1 - x_patom2. Contacts of fix wall/gran are not in any dump
/// local, but with its keyword `contacts` they may be columns of the dump of grains
/// (wall_contacts.hpp).
std::unique_ptr<Archive> open_lammps(const ArchiveFiles& files);

extern const ArchiveFormat lammps_format;

}  // namespace grseg
