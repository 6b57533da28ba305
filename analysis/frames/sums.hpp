// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <limits>

namespace grseg {

/// a/b, or NaN unless b > 0: a mean over nothing is not known.
inline double ratio(double a, double b)
{
  return b > 0 ? a / b : std::numeric_limits<double>::quiet_NaN();
}

/// Adds sums to sums, place by place: numbers and whatever has +=, arrays and vectors of them. A
/// vector of layers grows to the length of the other.
template <class Sums>
void accumulate(Sums& sums, const Sums& others)
{
  if constexpr (requires { sums += others; }) {
    sums += others;
  } else {
    if constexpr (requires { sums.resize(others.size()); })
      if (sums.size() < others.size()) sums.resize(others.size());
    for (std::size_t k = 0; k < others.size(); ++k) accumulate(sums[k], others[k]);
  }
}

}  // namespace grseg
