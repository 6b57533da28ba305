// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/fit/fit_data.hpp"
#include "analysis/fit/rule_fit.hpp"
#include "analysis/fit/window_motion.hpp"
#include "analysis/statistics/steady_series.hpp"

#include <optional>
#include <string>
#include <vector>

namespace grseg {

/// How the grains move in the times of a fit, and what this means for B.
struct FlowVerdict {
  std::vector<std::string> sentences;  // without full stop; a sentence each on motion, steadiness,
                                       // change of B, and the time that a narrower interval needs
  std::vector<std::string> doubts;     // conditions under which no steady flow has this B
  bool changes =
      false;  // B changes in time, or grains segregate: intervals are over these times alone
};

/// Inertial number below which a bed rests or creeps (GDR MiDi, Eur. Phys. J. E 14, 341, 2004).
inline constexpr double least_inertial_number = 1e-3;
/// A flow is steady if its speed changes by less than this part of its mean between the first and
/// the last third of the time, or by no more than chance. The bound is a convention.
inline constexpr double steady_within = 0.1;
/// Half-width of the interval of B to which the needed time or number of runs refers.
inline constexpr double wanted_half_width = 0.01;
/// Least number of windows from which the needed time is foretold (as in doubt_of_windows()).
inline constexpr std::size_t fewest_to_foretell = 12;

/// The verdict on the data that gave `fit`. A start that differs from the rest is sought in the
/// speed (change_of() and start_of(), by more than `steady_within`; without speeds by seen_start() in
/// |sigma_xy|/sigma_yy, of kinetic stress in sigma_yy) and in the part of B that the composition of
/// the layers does not explain (seen_start()). `tables` are those from which `data` was selected.
FlowVerdict verdict_on(const std::vector<FitTable>& tables, const FitData& data, const RuleFit& fit,
                       const FitSettings& settings);

}  // namespace grseg
