// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/micro/sums_table.hpp"
#include "tests/analysis/neutral_contacts.hpp"

#include <limits>

namespace grseg {

/// A layer of neutral contacts, from 4 to 6 in a bed of height 20.
template <int D = 2>
SumsRow<D> layer(double phi_large)
{
  return {{.begin = 0, .end = 1, .bottom = 4, .top = 6, .frames = 10, .volume = 125},
          neutral_contacts<D>(phi_large, 2),
          {},
          20};
}

inline SumsRow<2> bed_of_height(double height, double begin)
{
  auto bed = layer(0.5);
  bed.begin = begin;
  bed.end = begin + 1;
  bed.bottom = bed.top = std::numeric_limits<double>::quiet_NaN();
  bed.heights = {1, 2, height};
  return bed;
}

}  // namespace grseg
