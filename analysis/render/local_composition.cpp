// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/render/local_composition.hpp"

#include "analysis/frames/coarse_graining.hpp"
#include "analysis/frames/ratio.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace grseg {
namespace {

/// A grain, or an image of it beyond an end of the period along x.
struct Place {
  double x;
  std::size_t grain;
};

template <int D>
std::vector<Place> places_along_x(const Grains& grains, const Frame<D>& frame, const Box& box,
                                  double radius)
{
  std::vector<Place> places;
  places.reserve(grains.size());
  for (std::size_t g = 0; g < grains.size(); ++g) {
    if (!is_mobile(grains, frame, g)) continue;
    const double x = frame.position[g].x();
    places.push_back({x, g});
    if (!box.periodic_x) continue;
    if (x < radius) places.push_back({x + box.length_x, g});
    if (x > box.length_x - radius) places.push_back({x - box.length_x, g});
  }
  std::sort(places.begin(), places.end(), [](const Place& a, const Place& b) { return a.x < b.x; });
  return places;
}

/// Squared distance across x, along z to the nearest image.
template <int D>
double across_squared(const Vector<D>& a, const Vector<D>& b, const Box& box)
{
  const double y = a.y() - b.y();
  if constexpr (D == 2) return y * y;
  double z = a[D - 1] - b[D - 1];
  if (box.periodic_z) z -= box.length_z * std::round(z / box.length_z);
  return y * y + z * z;
}

}  // namespace

template <int D>
std::vector<double> local_composition(const Grains& grains, const Frame<D>& frame, const Box& box,
                                      Species of, double radius)
{
  // Within half a period every grain has one image at most.
  if (box.periodic_x) radius = std::min(radius, box.length_x / 2);
  const Kernel kernel(KernelShape::lucy, radius);
  const auto places = places_along_x(grains, frame, box, radius);
  std::vector<double> shares(grains.size(), std::numeric_limits<double>::quiet_NaN());
  for (std::size_t g = 0; g < grains.size(); ++g) {
    if (!is_mobile(grains, frame, g)) continue;
    const auto& centre = frame.position[g];
    double part = 0, all = 0;
    const auto first = std::lower_bound(places.begin(), places.end(), centre.x() - radius,
                                        [](const Place& place, double x) { return place.x < x; });
    for (auto near = first; near != places.end() && near->x <= centre.x() + radius; ++near) {
      const double x = near->x - centre.x();
      const double squared = x * x + across_squared<D>(frame.position[near->grain], centre, box);
      if (squared >= radius * radius) continue;
      const double weight =
          grain_volume<D>(grains.radius[near->grain]) * kernel.value(std::sqrt(squared));
      all += weight;
      if (grains.species[near->grain] == of) part += weight;
    }
    shares[g] = ratio(part, all);
  }
  return shares;
}

template std::vector<double> local_composition(const Grains&, const Frame<2>&, const Box&, Species,
                                               double);
template std::vector<double> local_composition(const Grains&, const Frame<3>&, const Box&, Species,
                                               double);

}  // namespace grseg
