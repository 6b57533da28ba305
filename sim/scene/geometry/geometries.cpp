// SPDX-License-Identifier: GPL-3.0-or-later
#include "sim/scene/geometry/geometries.hpp"

namespace grseg {

const std::vector<const Geometry*>& geometries()
{
  static const std::vector<const Geometry*> all{
      &bed_geometry(), &drum_geometry(), &shear_geometry(), &column_geometry(), &hopper_geometry()};
  return all;
}

}  // namespace grseg
