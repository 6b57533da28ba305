// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/import/verify/check_series.hpp"

#include <cstddef>
#include <optional>

namespace grseg {

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

/// What is true of the first half of the moments and of the second.
template <class Value>
struct Halves {
  Value first, second;
};
CheckSeries half_of(const CheckSeries& series, bool second);

/// Where gravity differs between the halves: by more than five standard errors and more than
/// `tolerance` (m/s^2).
std::optional<Halves<Estimate>> change_of_gravity(const CheckSeries& series, double tolerance);

/// k of y = k x, its standard error, and by how much noise in x may have lowered it: the part of the
/// squares of y that the line leaves over.
struct Slope {
  double value = 0, error = 0, doubt = 0;
  double grains = 0;
  /// By how much it may be off: five standard errors and the doubt.
  double uncertainty() const { return 5 * error + doubt * value; }
};
/// By how much a slope may differ from 1, beside its uncertainty, and how uncertain one may be that
/// passes: one that is off by half is then refused.
inline constexpr double slope_tolerance = 0.1, sharp_slope = 0.5 - slope_tolerance;

/// Nothing where too little moves or where more than a tenth of the squares is left over.
std::optional<Slope> slope_of(const SlopeSums& sums);
SlopeSums sums_of(const CheckSeries& series, SlopeSums CheckMoment::*which);

/// Where the slope differs between the halves by more than their uncertainties and slope_tolerance.
std::optional<Halves<Slope>> change_of_slope(const CheckSeries& series,
                                             SlopeSums CheckMoment::*which);

}  // namespace grseg
