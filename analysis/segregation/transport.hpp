// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <vector>

namespace grseg {

/// Coefficients of the flux of large grains at one place.
struct TransportRates {
  double S = 0;  // segregation velocity, m/s; > 0 if large grains rise
  double D = 0;  // diffusivity, m^2/s
};

/// The coefficients at a height above the base, m, where large grains have this phi_L.
using TransportLaw = std::function<TransportRates(double height, double phi_large)>;

/// A bed that segregates and diffuses along y by the law of Gray & Chugunov (2006),
///
///   d phi_L/dt = -d q_L/dy,     q_L = S phi_L phi_S - D d phi_L/dy,     q_L = 0 at base and surface
///
/// in equal cells of a bed with one solid fraction. The flux between two cells takes phi_L from
/// below and phi_S from above if S > 0, and the other way round if S < 0. This keeps phi_L between
/// 0 and 1, for any sizes of S and D, and shocks in their places. It adds a diffusivity of |S|/2
/// times the cell, which is taken from D as far as D has it. So the error decreases with the square
/// of the cell where D exceeds this part, and with the cell elsewhere. The sum of phi_L is constant
/// up to round-off.
class TransportColumn {
 public:
  /// phi_L of the cells from the base upward; at least one, each from 0 to 1. Height in m.
  TransportColumn(std::vector<double> phi_large, double height);

  /// Moves the time forward by `duration`, s, in as many equal steps as keep phi_L in its bounds.
  /// The law is evaluated in each step; its coefficients must be finite and D not negative.
  void advance(double duration, const TransportLaw& law);

  /// phi_L of the cells from the base upward.
  const std::vector<double>& phi_large() const { return phi_; }
  double height() const { return height_; }

 private:
  /// Sets flux_ between the cells. Returns the longest step, s, which keeps phi_L in its bounds.
  double set_fluxes(const TransportLaw& law);

  std::vector<double> phi_, flux_;  // flux_[k] is that into cell k from below, m/s
  double height_;
};

}  // namespace grseg
