// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

namespace grseg {

/// A mean over windows with its standard error, windows taken as independent; NaN where there are
/// too few.
struct MeanOfWindows {
  double mean, error;
};
MeanOfWindows mean_of_windows(const std::vector<double>& values);

}  // namespace grseg
