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

/// Numbers that the checks of an import compute from each frame. If the number of grains of a group
/// of numbers is 0, the others of the group are 0 and have no meaning.
namespace grseg {

/// An estimate of gravity (m/s^2, in the axes of the flow) from some of the grains of a frame.
struct GravityEstimate {
  double grains = 0;  // number of grains in the estimate
  Vec3 gravity = Vec3::Zero();
  double error = 0;  // standard error within the frame; 0 for a sum over all grains
};

/// Sums over grains for the fit of a line y = k x through the origin, where x and y are vectors.
/// The slope and its standard error follow from them (slope_of()).
struct SlopeSums {
  double grains = 0, xx = 0, xy = 0, yy = 0;  // sums of 1, x.x, x.y, y.y
  double xx_xx = 0, xx_xy = 0, xy_xy = 0;     // sums of (x.x)^2, (x.x)(x.y), (x.y)^2

  void add(const Vec3& x, const Vec3& y)
  {
    const double a = x.dot(x), b = x.dot(y);
    grains += 1, xx += a, xy += b, yy += y.dot(y);
    xx_xx += a * a, xx_xy += a * b, xy_xy += b * b;
  }
  SlopeSums& operator+=(const SlopeSums& other);
};

/// Numbers about one frame.
struct CheckNumbers {
  std::int64_t step = 0;
  double time = 0;  // s

  // Contacts that transmit a force, in units of the smaller radius. distance: largest difference
  // between the stated distance and the positions. gap: widest gap, minus the distance that
  // two grains may separate in a step. overlap: deepest overlap. pull: attractive fraction of the
  // normal force.
  double distance = 0, gap = 0, overlap = 0, pull = 0;

  /// Unlisted pairs, which overlap but have no contact: the deepest overlap in units of the smaller
  /// radius, and the number of pairs. 0 if every grain balances without them.
  double unlisted = 0, unlisted_pairs = 0;
  /// 1 if the unlisted pairs may transmit no force, as in contact dynamics.
  double unlisted_may_part = 0;
  /// Fraction of the mobile grains that move as one rigid body with a neighbour without a contact,
  /// although the archive's forces do not keep them together.
  double rigid = 0;

  /// Largest force that is missing in a grain's balance, relative to the largest force; number of
  /// grains, 0 if the balance could not be judged.
  double balance = 0, balance_grains = 0;
  /// Missing force of the worst grain, relative to the largest force. Between frames that are close
  /// together, but not one step apart, a few grains may have collided; then `balance` refers to the
  /// median grain.
  double balance_worst = 0;
  /// Relative change of the contact forces on a grain since the previous frame (medians), if the
  /// archive has no forces on grains. 0 if the two frames are consecutive steps.
  double change = 0;
  /// Median over grains of the summed magnitudes of contact forces over the mass, m/s^2.
  double acceleration = 0;
  /// Gravity estimated from all mobile grains, from the smaller and from the larger ones.
  GravityEstimate all, smaller, larger;
  /// 1 if these estimates are medians over grains, 0 if they are sums over all grains.
  double medians = 0;

  SlopeSums motion;  // fit of displacement (y) against velocity times time (x), in mean diameters
  SlopeSums force;   // fit of force/mass (y) against acceleration (x), m/s^2
};

/// Converts from the units of an archive to SI.
CheckNumbers in_si(CheckNumbers numbers, const Units& units);

using CheckSeries = std::vector<CheckNumbers>;

/// The observables of an imported run that store how well the contacts of a frame fit its grains,
/// and their values, in the same order.
const std::vector<Observable>& check_observables();
std::vector<double> check_values(const CheckNumbers& numbers);

/// A vector and its standard error.
struct Estimate {
  Vec3 value = Vec3::Zero();
  double error = 0;
  std::size_t frames = 0;  // number of frames, or of pairs of frames
  double grains = 0;       // mean number of grains in a frame
  bool medians = false;    // true: from medians over grains; false: from sums over all grains
};

/// Smallest number of pairs of frames for a standard error of sums over all grains.
inline constexpr std::size_t fewest_pairs = 8;

/// Gravity (m/s^2) from the estimates `which` of all frames. If any are medians over grains: their
/// mean, weighted by numbers of grains, with the larger of the standard errors within frames and
/// between frames. Otherwise from sums over all grains: their mean over time, with a standard error
/// that includes correlations of successive frames; empty for fewer than `fewest_pairs` pairs.
std::optional<Estimate> gravity_from(const CheckSeries& series,
                                     GravityEstimate CheckNumbers::*which);

/// Values in the first and the second half of the frames.
template <class Value>
using Halves = std::pair<Value, Value>;

/// Gravity in both halves, if the values differ by more than five standard errors and more than
/// `tolerance` (m/s^2); otherwise empty.
std::optional<Halves<Estimate>> change_of_gravity(const CheckSeries& series, double tolerance);

/// Slope k of a fit y = k x, its standard error, and `doubt`: the fraction of the squares of y that
/// the line does not explain, by which noise in x may have lowered k at most.
struct Slope {
  double value = 0, error = 0, doubt = 0;
  double grains = 0;
  /// Largest possible error of the value: five standard errors and the doubt.
  double uncertainty() const { return 5 * error + doubt * value; }
};
/// Largest accepted deviation of a slope from 1, in addition to its uncertainty; and largest
/// uncertainty of an accepted slope, so that a slope of 0.5 or 1.5 is refused.
inline constexpr double slope_tolerance = 0.1, sharp_slope = 0.5 - slope_tolerance;

/// "1.02 times velocity times time (limits: 0.9 and 1.1), with a standard error of 0.003".
std::string in_words(const Slope& slope, const std::string& what);
/// Why a slope that is not refused is not accepted either.
std::string why_undecided(const Slope& slope);

/// The slope; empty for fewer than three grains, or if `doubt` is larger than 0.1.
std::optional<Slope> slope_of(const SlopeSums& sums);
SlopeSums sums_of(const CheckSeries& series, SlopeSums CheckNumbers::*which);

/// The slopes of both halves, if they differ by more than their uncertainties and slope_tolerance.
std::optional<Halves<Slope>> change_of_slope(const CheckSeries& series,
                                             SlopeSums CheckNumbers::*which);

}  // namespace grseg
