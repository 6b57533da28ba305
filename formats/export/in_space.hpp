// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/core/frame.hpp"

#include <vector>

namespace grseg {

/// As viewers take vectors, with three components: what lies in a plane has z = 0, and turns about z.
template <int D>
Vec3 in_space(const Vector<D>& v)
{
  if constexpr (D == 2)
    return {v.x(), v.y(), 0};
  else
    return v;
}
inline Vec3 spin_in_space(double spin)
{
  return {0, 0, spin};
}
inline Vec3 spin_in_space(const Vec3& spin)
{
  return spin;
}

template <int D>
std::vector<Vec3> all_in_space(const std::vector<Vector<D>>& vectors)
{
  std::vector<Vec3> out;
  out.reserve(vectors.size());
  for (const auto& v : vectors) out.push_back(in_space<D>(v));
  return out;
}

}  // namespace grseg
