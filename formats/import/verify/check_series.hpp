// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/core/frame.hpp"
#include "formats/core/parameters.hpp"
#include "formats/import/facts/units.hpp"
#include "formats/trajectory/run_description.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

/// The memory that the checks of an import have of each moment: numbers, stored with every frame as
/// observables `check_...`, so that findings can be computed again from the file alone. Where the
/// number of grains of a group is 0, the rest of the group is 0 and says nothing.
namespace grseg {

/// An estimate of gravity (m/s^2, in the axes of the flow) from some of the grains of a moment.
struct GravityEstimate {
  double grains = 0;  // that it is made of
  Vec3 gravity = Vec3::Zero();
  double error = 0;  // standard error within the moment; 0 where it is a sum over all grains
};

/// Sums over grains from which the slope of a line y = k x through the origin and its standard error
/// follow, x and y being vectors.
struct SlopeSums {
  double grains = 0, xx = 0, xy = 0, yy = 0;  // sums of 1, x.x, x.y, y.y
  double xx_xx = 0, xx_xy = 0, xy_xy = 0;     // sums of products of these

  void add(const Vec3& x, const Vec3& y)
  {
    const double a = x.dot(x), b = x.dot(y);
    grains += 1, xx += a, xy += b, yy += y.dot(y);
    xx_xx += a * a, xx_xy += a * b, xy_xy += b * b;
  }
  SlopeSums& operator+=(const SlopeSums& other);
};

/// One moment.
struct CheckMoment {
  std::int64_t step = 0;
  double time = 0;  // s

  // Contacts that bear a force, in units of the smaller radius: the largest difference between the
  // distance that the archive states and the distance of the positions, the widest gap beyond the
  // way that the two may part in a step, the deepest overlap. Fraction of the normal force that
  // pulls.
  double distance = 0, gap = 0, overlap = 0, pull = 0;

  /// Pairs that overlap and have no contact: the deepest overlap in units of the smaller radius, and
  /// their number. 0 where every grain is known to balance without them.
  double unlisted = 0, unlisted_pairs = 0;
  /// 1 where they may bear no force, as in contact dynamics.
  double unlisted_may_part = 0;
  /// Part of the mobile grains that move as one body with a neighbour they have no contact with.
  double rigid = 0;

  /// Largest force that is missing on a grain, over the largest force; number of grains: 0 where it
  /// could not be judged.
  double balance = 0, balance_grains = 0;
  /// Force missing on the grain that misses most. Between moments that are close together, but not
  /// one step apart, a few grains may have collided: then `balance` belongs to the median grain.
  double balance_worst = 0;
  /// Without forces on grains: how much the contact forces on a grain have changed since the moment
  /// before, over their size; medians. 0 where one follows the other step by step.
  double change = 0;
  /// Median over grains of the sum of sizes of contact forces over the mass, m/s^2.
  double acceleration = 0;
  /// Gravity found from all mobile grains, from the smaller and from the larger ones.
  GravityEstimate all, smaller, larger;
  /// 1 where these are medians over grains, 0 where they are sums over all grains.
  double medians = 0;

  SlopeSums motion;  // x: velocity times time, y: displacement, in mean diameters
  SlopeSums force;   // x: mass times acceleration, y: force, both over the mass, m/s^2
};

/// From the units of an archive to SI.
CheckMoment in_si(CheckMoment moment, const Units& units);

using CheckSeries = std::vector<CheckMoment>;

/// The observables that hold a moment, and what a moment holds of them, in the same order.
const std::vector<Observable>& check_observables();
std::vector<double> check_values(const CheckMoment& moment);
void set_check_values(CheckMoment& moment, const std::vector<double>& values);

/// A vector and its standard error.
struct Estimate {
  Vec3 value = Vec3::Zero();
  double error = 0;
  std::size_t moments = 0;
  double grains = 0;     // of a moment, mean
  bool medians = false;  // over grains; otherwise from sums over all of them
};

/// Fewer pairs of moments do not tell how far sums over all grains scatter.
inline constexpr std::size_t fewest_pairs = 8;

/// Gravity (m/s^2) from `which` of all moments. From medians over grains where there are any: their
/// mean, weighted by grains, with the larger of the standard errors within moments and between them.
/// Otherwise from sums over all grains: their mean over time, with a standard error that allows for
/// moments that resemble their neighbours; nothing below `fewest_pairs`.
std::optional<Estimate> gravity_from(const CheckSeries& series,
                                     GravityEstimate CheckMoment::*which);

/// Values in the first half of the moments and in the second.
template <class Value>
using Halves = std::pair<Value, Value>;

/// Both values of gravity, where they differ by more than five standard errors and more than
/// `tolerance` (m/s^2).
std::optional<Halves<Estimate>> change_of_gravity(const CheckSeries& series, double tolerance);

/// k of y = k x, its standard error, and the largest fraction by which noise in x may have lowered
/// it: the part of the squares of y that the line leaves over.
struct Slope {
  double value = 0, error = 0, doubt = 0;
  double grains = 0;
  /// Largest possible error of the value: five standard errors and the doubt.
  double uncertainty() const { return 5 * error + doubt * value; }
};
/// Largest accepted deviation of a slope from 1, in addition to its uncertainty; and largest
/// uncertainty of an accepted slope: one that is off by half is then refused.
inline constexpr double slope_tolerance = 0.1, sharp_slope = 0.5 - slope_tolerance;

/// Nothing where too little moves or where more than a tenth of the squares is left over.
std::optional<Slope> slope_of(const SlopeSums& sums);
SlopeSums sums_of(const CheckSeries& series, SlopeSums CheckMoment::*which);

/// Where the slope differs between the halves by more than their uncertainties and slope_tolerance.
std::optional<Halves<Slope>> change_of_slope(const CheckSeries& series,
                                             SlopeSums CheckMoment::*which);

}  // namespace grseg
