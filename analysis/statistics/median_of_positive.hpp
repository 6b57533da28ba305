// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

namespace grseg {

/// The median of the values above 0, e.g. of the solid fractions of layers that are not empty; 0 where
/// there are none.
double median_of_positive(std::vector<double> values);

}  // namespace grseg
