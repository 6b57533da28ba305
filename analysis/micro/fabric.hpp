// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/core/frame.hpp"

namespace grseg {

/// Second Fourier moments of the directions of contacts and of their forces: each member is a sum
/// over contacts of weight (cos 2 theta, sin 2 theta), theta the direction of the normal n,
/// counter-clockwise from x. n, f_n and f_t are those of ForceParts; exchanging the two grains of a
/// contact changes neither f_n nor f_t nor 2 theta.
struct FabricSums {
  Vec2 normal = Vec2::Zero();            // weight 1
  Vec2 normal_force = Vec2::Zero();      // N, weight f_n
  Vec2 tangential_force = Vec2::Zero();  // N, weight f_t

  void add(const Vec2& n, double f_n, double f_t);
  FabricSums& operator+=(const FabricSums& others);
};

/// Anisotropies of the second harmonic in two dimensions (Rothenburg & Bathurst 1989):
///   share of contacts   E(theta)   = (1 + a_c cos 2(theta - theta_c))/(2 pi)
///   mean normal force   f_n(theta) = f_0 (1 + a_n cos 2(theta - theta_n))
///   mean tangential     f_t(theta) = -f_0 a_t sin 2(theta - theta_t)
/// f_0 is the mean of f_n(theta) over all directions, not over contacts.
struct Anisotropy {
  double a_c, a_n, a_t;
  double theta_c, theta_n, theta_t;  // degrees from x, in [0, 180); of the largest value

  /// q/p for small anisotropies that share their directions and branches of one length:
  /// (a_c + a_n + a_t)/2 (Rothenburg & Bathurst 1989).
  double rothenburg() const { return (a_c + a_n + a_t) / 2; }
  /// q/p for anisotropies of any size and direction and branches of one length: with
  /// A = a exp(2 i theta) for each, |A_c + A_n + A_t|/(2 + Re(conj(A_c) A_n)).
  double stress_ratio() const;
};

/// The anisotropies with the given moments, exactly: if E, f_n and f_t have the form above, they
/// are recovered, however large. `contacts` is the number of contacts, `force` the sum of their
/// f_n, N. All NaN without contacts; a_n and a_t NaN where a_c >= 1, since E is then negative
/// somewhere. A sample of N contacts in random directions has a_c of about sqrt(pi/N).
Anisotropy anisotropy(const FabricSums& sums, double contacts, double force);

/// Principal stresses s1 >= s2 of the symmetric part of a stress: p = (s1 + s2)/2, the pressure of
/// Staron & Phillips (2015), and q = (s1 - s2)/2.
struct PrincipalStress {
  double p, q;
  double theta;  // degrees from x, in [0, 180), of s1
};
PrincipalStress principal_stress(const Tensor2& stress);

}  // namespace grseg
