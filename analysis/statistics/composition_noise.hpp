// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

namespace grseg {

/// What composition does not explain in a quantity of layers: `value` less its fit by
/// a + b ln(phi_S/phi_L) + c phi_L, least squares with `weight`; the mean alone where points are
/// fewer than ten per coefficient. Weighted, the rest adds up to 0.
///
/// One B does not describe all compositions, and those of a flow that segregates drift. Drift is
/// known, not chance: left in the noise, it would make all windows depend on each other for ever.
Eigen::VectorXd composition_noise(const Eigen::VectorXd& phi_large, const Eigen::VectorXd& value,
                                  const Eigen::VectorXd& weight);

}  // namespace grseg
