// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

namespace grseg {

/// A mean over windows with its standard error, windows taken as independent; NaN where there are
/// too few, or nothing moves: windows that agree to a millionth are one observation.
struct MeanOfWindows {
  double mean, error;
};
MeanOfWindows mean_of_windows(const std::vector<double>& values);
/// The kind of the errors of such means, in words: "standard errors over 8 windows".
std::string errors_over(const std::vector<double>& values);

}  // namespace grseg
