// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/core/frame.hpp"

#include <vector>

namespace grseg {

/// The share of the grains of species `of` in the area or volume of mobile grains about each mobile
/// grain: sum_of A_j w(r_ij)/sum A_j w(r_ij), where A is a grain's area or volume, r the distance of
/// centres (m), and w Lucy's function (1 + 3u)(1 - u)^3 of u = r/radius, 0 from u = 1 on. The grain
/// itself is among them, and so are all images within the radius, which is positive and no longer than
/// a period. NaN for boundary grains and those that are absent.
template <int D>
std::vector<double> local_composition(const Grains& grains, const Frame<D>& frame, const Box& box,
                                      Species of, double radius);

}  // namespace grseg
