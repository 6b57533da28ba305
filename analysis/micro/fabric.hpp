// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/frames/sums.hpp"
#include "formats/core/frame.hpp"

#include <tuple>
#include <type_traits>

namespace grseg {

/// Second moments of the directions of contacts and of their forces, summed over contacts. In two
/// dimensions a contact adds a weight times (cos 2 theta, sin 2 theta), with theta the direction of
/// the normal n, counter-clockwise from x. The weights are 1, f_n and f_t of ForceParts. In three
/// dimensions it adds the tensors n (x) n, f_n n (x) n and f_tangential (x) n. Exchanging the two
/// grains of a contact does not change the moments.
template <int D>
struct FabricSums {
  static constexpr int dimension = D;
  using Moment = std::conditional_t<D == 2, Vec2, Tensor3>;
  using Tangential = std::conditional_t<D == 2, double, Vec3>;

  Moment normal = Moment::Zero();
  Moment normal_force = Moment::Zero();      // moment weighted by f_n, N
  Moment tangential_force = Moment::Zero();  // moment weighted by f_t, N

  void add(const Vector<D>& n, double f_n, const Tangential& f_t);
  static constexpr auto members =
      std::tuple(&FabricSums::normal, &FabricSums::normal_force, &FabricSums::tangential_force);
};

/// Second-order anisotropies of contacts and forces.
template <int D>
struct Anisotropy;

/// In two dimensions (Rothenburg & Bathurst 1989):
///   share of contacts   E(theta)   = (1 + a_c cos 2(theta - theta_c))/(2 pi)
///   mean normal force   f_n(theta) = f_0 (1 + a_n cos 2(theta - theta_n))
///   mean tangential     f_t(theta) = -f_0 a_t sin 2(theta - theta_t)
/// f_0 is the mean of f_n(theta) over all directions, not over contacts.
template <>
struct Anisotropy<2> {
  double a_c, a_n, a_t;
  double theta_c, theta_n, theta_t;  // directions of the largest value, degrees from x, [0, 180)

  /// q/p for small anisotropies with the same directions, and branches of one length:
  /// (a_c + a_n + a_t)/2 (Rothenburg & Bathurst 1989).
  double rothenburg() const { return (a_c + a_n + a_t) / 2; }
  /// q/p for anisotropies of any size and direction and branches of one length: with
  /// A = a exp(2 i theta) for each, |A_c + A_n + A_t|/(2 + Re(conj(A_c) A_n)).
  double stress_ratio() const;
};

/// In three dimensions (Ouadfel & Rothenburg 2001; Guo & Zhao 2013), with deviators c, n and t, for
/// contacts in the direction m:
///   share of contacts   E(m)   = (1 + m.c.m)/(4 pi)
///   mean normal force   f_n(m) = f_0 (1 + m.n.m)
///   mean tangential     f_t(m) = f_0 (t.m - (m.t.m) m), a vector
template <>
struct Anisotropy<3> {
  Tensor3 c, n, t;
  /// Size sqrt(3/2 a:a) of each deviator a, with the sign of a:sigma', where sigma' is the deviator
  /// of the stress for branches of one length.
  double a_c, a_n, a_t;

  /// q/p for small anisotropies with the principal axes of the stress and branches of one length:
  /// 2/5 (a_c + a_n + 3/2 a_t) (Guo & Zhao 2013).
  double rothenburg() const { return 0.4 * (a_c + a_n + 1.5 * a_t); }
  /// q/p for anisotropies of any size and direction and branches of one length.
  double stress_ratio() const;
};

/// The anisotropies that have the given moments. They are exact for any size if E, f_n and f_t have
/// the forms above. `contacts` is the number of contacts, `force` the sum of their f_n, N. All are
/// NaN without contacts. a_n and a_t are NaN if E is negative for some direction; in two dimensions
/// this means a_c >= 1. A sample of N contacts in random directions has an a_c of about sqrt(pi/N)
/// in two dimensions and 7.5/sqrt(N) in three.
Anisotropy<2> anisotropy(const FabricSums<2>& sums, double contacts, double force);
Anisotropy<3> anisotropy(const FabricSums<3>& sums, double contacts, double force);

/// Principal stresses of the symmetric part of a stress.
template <int D>
struct PrincipalStress;

/// Two dimensions, principal stresses s1 >= s2: p = (s1 + s2)/2, the pressure of Staron & Phillips
/// (2015), and q = (s1 - s2)/2.
template <>
struct PrincipalStress<2> {
  double p, q;
  double theta;  // direction of s1, degrees from x, in [0, 180)
};
/// Three dimensions, s1 >= s2 >= s3: p = (s1 + s2 + s3)/3 and q = sqrt(3/2 sigma':sigma'), which is
/// s1 - s3 if two of the three are equal.
template <>
struct PrincipalStress<3> {
  double p, q;
  double b;    // (s2 - s3)/(s1 - s3): 0 in axial compression, 1 in extension; NaN if all are equal
  Vec3 major;  // direction of s1
};
PrincipalStress<2> principal_stress(const Tensor2& stress);
PrincipalStress<3> principal_stress(const Tensor3& stress);

/// Direction of an axis in space, in degrees. `theta`, in [0, 180), is the angle from x towards y
/// of its projection onto the xy plane. `tilt`, -90 to 90, is its angle to this plane towards z.
struct AxisAngles {
  double theta, tilt;
};
AxisAngles axis_angles(const Vec3& axis);
/// Principal axis of the largest eigenvalue of a symmetric tensor.
Vec3 major_axis(const Tensor3& tensor);

}  // namespace grseg
