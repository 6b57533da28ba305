// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/cli/tool.hpp"

/// Options that --preset sets in each tool: `paper` as Staron & Phillips (2015) did, as far as they
/// say so, `rigorous` for results that conclusions rest on. Options given on the command line take
/// precedence. Defaults that both presets keep are not listed: layers of 4 dS, windows of 1.25 s,
/// 0.01 <= phi_S/phi_L <= 100.
namespace grseg::presets {

//   option, paper, rigorous; "": the tool's default
inline constexpr PresetOption stress[] = {
    {"assign", "contact-point", "branch"},     // the branch's share of a layer balances momentum
    {"partition", "uniform:0.66667", "size"},  // nominal or actual radii
    {"volume", "solid", "bulk"},
};
inline constexpr PresetOption kinetic[] = {
    {"mean", "layer", "profile-unbiased"},  // the mean of a layer leaves the shear inside it
};
inline constexpr PresetOption micro[] = {
    {"composition", "clipped", "clipped"},
};
inline constexpr PresetOption derive[] = {
    {"force", "modulus", "normal"},  // with f_n, over ends, Pi is the pressure of each species
    {"average", "contacts", "ends"},
    {"partition", "uniform:0.66667", "size"},
};
inline constexpr PresetOption balance[] = {
    {"layer", "4dS", "4dS"},
    {"window", "1.25", "1.25"},
};
inline constexpr PresetOption segregation[] = {
    {"layer", "4dS", "4dS"},
    {"window", "1.25", "1.25"},
};
inline constexpr PresetOption fit[] = {
    {"partition", "uniform:0.66667", "size"},
    {"begin", "", "10"},  // s; the paper takes all stages, spin-up takes 5 to 10 s
};

}  // namespace grseg::presets
