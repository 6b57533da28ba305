// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/balance/momentum_balance.hpp"
#include "formats/core/species.hpp"

#include <string>
#include <vector>

namespace grseg {

/// The columns of grseg-balance after the key columns, X = S, L (other than two species by their
/// names), a = x, y (z in three dimensions):
///   rho_X jx_X jy_X           density and momentum density
///   Sc_X_xx, _xy, _yx, _yy    contact stress
///   Sk_X_xx, _xy, _yy         kinetic stress about the mean velocity of all species in the layer
///                             and window; xx contains the mean shear within the layer
///   rate_X_a ... residual_X_a terms of the balance (momentum_balance.hpp) and what they leave
///   change_X_a                what the rates sample
///   phi_L ... drag_rate       driving_forces.hpp, of two species
template <int D>
std::vector<std::string> balance_columns(const SpeciesList& species);
/// The values of a layer under these columns.
template <int D>
std::vector<double> balance_row(const MomentumBalance<D>& balance, std::size_t layer);

}  // namespace grseg
