// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/fit/fit_data.hpp"
#include "analysis/fit/fit_flows.hpp"
#include "analysis/fit/fit_points.hpp"
#include "analysis/statistics/confidence.hpp"

namespace grseg {

/// The exponent a of a partition of stress by a power of grain size,
///   sigma^nu/sigma = phi^nu s_nu^a / sum over mu of phi^mu s_mu^a,   s: nominal diameter
/// (Marks, Rognon & Einav 2012; Tunuguntla, Bokhove & Thornton 2014): 0 where stress goes by volume,
/// 1, 2 or 3 where it goes with diameter, surface or volume of the single grain. For any two species
/// ln(sigma^nu/sigma^mu) - ln(phi^nu/phi^mu) = a ln(s_nu/s_mu), and a is the weighted least-squares
/// slope of this line through the origin over the samples of all pairs in `data`. Of two species it
/// is B_mean/ln r, also over equal or random flows, where it is the mean of the flows'. Its
/// interval is that of B_mean of the same data. NaN without points.
Estimate size_exponent(const FitData& data, const PartitionRule& rule, const FitSettings& settings,
                       const Resampling& resampling);

}  // namespace grseg
