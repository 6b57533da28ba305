// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/cli/tool.hpp"

/// Options that --preset sets in each tool. `paper`: the choices of Staron & Phillips (2015), as
/// far as they are known. `rigorous`: choices for results on which conclusions depend. Options
/// given on the command line take precedence. Defaults that are the same in both presets are not
/// listed: layers of 4 dS, windows of 1.25 s, 0.01 <= phi_S/phi_L <= 100.
namespace grseg::presets {

//   option, value in `paper`, value in `rigorous`; "": the tool's default
inline constexpr PresetOption stress[] = {
    {"assign", "contact-point", "branch"},     // only `branch` balances momentum in each layer
    {"partition", "uniform:0.66667", "size"},  // share from nominal radii, or from actual radii
    {"volume", "solid", "bulk"},
};
inline constexpr PresetOption kinetic[] = {
    {"mean", "layer", "profile-unbiased"},  // with `layer`, K_xx includes the shear in the layer
};
inline constexpr PresetOption micro[] = {
    {"composition", "clipped", "clipped"},
};
inline constexpr PresetOption derive[] = {
    // Only with `normal` and `ends` is Pi (eqs. 8, 9) the partial pressure of a species.
    {"force", "modulus", "normal"},
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
    {"thickness", "kept", "removed"},
    {"begin", "", "10"},  // s; the paper uses all stages; the flow accelerates for 5 to 10 s
};

}  // namespace grseg::presets
