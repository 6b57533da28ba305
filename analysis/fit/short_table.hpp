// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/fit/fit_report.hpp"

#include <string>

namespace grseg {

/// The report for reading on a terminal: per rule B at phi_L = 1/2 with its interval, beside it that
/// of the pressure (or, of the pressure, that of yy) where the table has it, the share of
/// the mixed contacts' stress that large grains get, the number of points, and whose rule it is;
/// then p* and the doubts. Three decimals, or FitReport::digits; "-" where there is no number.
std::string short_table(const FitReport& report);

}  // namespace grseg
