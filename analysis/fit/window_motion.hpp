// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/fit/fit_data.hpp"

#include <Eigen/Core>
#include <vector>

namespace grseg {

/// How the grains of the tables move, from all of their layers, also layers that the fit leaves out.
struct WindowMotion {
  // By window, run after run; empty if a table does not tell.
  Eigen::VectorXd speed;   // root of the mean square of the velocity, m/s
  Eigen::VectorXd height;  // centre of the larger species above the centre of the smaller one, m

  // By run. Inertial number of its mean flow, gamma d sqrt(rho/sigma_yy), with the slope gamma of
  // the least-squares line u(y) (in annuli y times the slope of u/y), and means over all grains of
  // diameter d, density rho and stress sigma_yy (GDR MiDi, Eur. Phys. J. E 14, 341, 2004). Empty
  // for maps, for kinetic stress, and without density or velocities.
  std::vector<double> inertial_number;
};

/// `tables` are those from which `data` was selected.
WindowMotion motion_of_windows(const std::vector<FitTable>& tables, const FitData& data,
                               BasePart base);

/// A number per window, of the fitted layers, that is constant in a steady flow. For contact stress
/// it is |sigma_xy|/sigma_yy: the tangent of the slope in a steady chute, and less if the flow
/// accelerates. For kinetic stress it is sigma_yy (J), which grows with the speed.
Eigen::VectorXd stress_ratio_of_windows(const FitData& data, BasePart base);

}  // namespace grseg
