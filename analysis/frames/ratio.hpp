// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <limits>

namespace grseg {

/// a/b, or NaN unless b > 0: a mean over nothing is not known.
inline double ratio(double a, double b)
{
  return b > 0 ? a / b : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace grseg
