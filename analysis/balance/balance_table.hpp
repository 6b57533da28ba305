// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/balance/momentum_balance.hpp"
#include "analysis/balance/partitioned_balance.hpp"
#include "analysis/frames/sums.hpp"
#include "formats/core/species.hpp"

#include <cstddef>
#include <optional>
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
/// Without a layer the names alone count.
template <int D>
std::vector<Cell> balance_cells(const MomentumBalance<D>& balance, const SpeciesList& species,
                                std::optional<std::size_t> layer);

/// The columns that --partition adds behind them. For each RULE, as it is typed, and X, a as above
///   contact_X_a@RULE, interaction_X_a@RULE            C and beta (partitioned_balance.hpp)
///   psi_L@RULE, B@RULE, push@RULE, spread@RULE, drag@RULE   of two species (driving_forces.hpp)
/// and once
///   N_X_a        the contact force on the grains of X, which is C + beta + base under every rule
///   p_zero       of two species: p*, the share at which the contact push changes its sign
template <int D>
std::vector<Cell> partition_cells(const MomentumBalance<D>& balance,
                                  const PartitionedBalance<D>& contacts, const SpeciesList& species,
                                  std::optional<std::size_t> layer);

}  // namespace grseg
