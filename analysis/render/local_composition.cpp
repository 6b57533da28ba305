// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/frames/coarse_graining.hpp"
#include "analysis/frames/sums.hpp"
#include "analysis/render/grain_field.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <tuple>

namespace grseg {
namespace {

/// Index of a strip that runs along x: its number along y and, in three dimensions, along z. Whole numbers
/// stored as doubles, because a height may be an arbitrarily large multiple of the radius.
using Strip = std::array<double, 2>;

/// A mobile grain, or an image of it beyond an end of a period.
template <int D>
struct Image {
  Strip strip;
  Vector<D> centre;
  std::size_t grain;

  auto key() const { return std::make_tuple(strip, centre.x()); }
};

/// Mobile grains and their periodic images that lie within a radius of the cell, sorted by strip, then by x.
/// Strips run along x and are no narrower than the radius.
template <int D>
class NearGrains {
 public:
  NearGrains(const Grains& grains, const Frame<D>& frame, const Box& box, double radius)
      : radius_(radius), width_(radius)
  {
    for (const double r : grains.radius) width_ = std::max(width_, 2 * r);
    images_.reserve(grains.size());
    for (std::size_t g = 0; g < grains.size(); ++g)
      if (is_mobile(grains, frame, g)) add(frame.position[g], g, box);
    std::ranges::sort(images_, {}, &Image<D>::key);
  }

  /// Calls book(grain, distance in m) for each grain or image nearer to `centre` (m) than the radius.
  template <class Book>
  void visit(const Vector<D>& centre, const Book& book) const
  {
    const auto own = strip_of(centre);
    constexpr int across = D == 3 ? 1 : 0;
    for (int y = -1; y <= 1; ++y)
      for (int z = -across; z <= across; ++z) {
        const Strip strip{own[0] + y, own[1] + z};
        const auto last = std::make_tuple(strip, centre.x() + radius_);
        auto near = std::ranges::lower_bound(images_, std::make_tuple(strip, centre.x() - radius_),
                                             {}, &Image<D>::key);
        for (; near != images_.end() && near->key() <= last; ++near) {
          const double squared = (near->centre - centre).squaredNorm();
          if (squared < radius_ * radius_) book(near->grain, std::sqrt(squared));
        }
      }
  }

 private:
  Strip strip_of(const Vector<D>& centre) const
  {
    return {std::floor(centre.y() / width_), D == 3 ? std::floor(centre[D - 1] / width_) : 0};
  }
  void add(const Vector<D>& centre, std::size_t grain, const Box& box)
  {
    for (const double x : shifts(centre.x(), box.periodic_x, box.length_x))
      for (const double z : shifts(centre[D - 1], D == 3 && box.periodic_z, box.length_z)) {
        Vector<D> moved = centre;
        moved.x() += x;
        if constexpr (D == 3) moved.z() += z;
        images_.push_back({strip_of(moved), moved, grain});
      }
  }
  /// Shifts along an axis, m, from a grain at `place` to its images; the first shift, 0, is the grain itself.
  std::vector<double> shifts(double place, bool periodic, double length) const
  {
    std::vector<double> all{0};
    if (periodic && place < radius_) all.push_back(length);
    if (periodic && place > length - radius_) all.push_back(-length);
    return all;
  }
  double radius_, width_;
  std::vector<Image<D>> images_;
};

}  // namespace

template <int D>
std::vector<double> local_composition(const Grains& grains, const Frame<D>& frame, const Box& box,
                                      Species of, double radius)
{
  const auto lucy = [radius](double distance) {
    const double rest = std::max(0.0, 1 - distance / radius);
    return (4 - 3 * rest) * rest * rest * rest;
  };
  const NearGrains<D> all(grains, frame, box, radius);
  std::vector<double> shares(grains.size(), std::numeric_limits<double>::quiet_NaN());
  for (std::size_t g = 0; g < grains.size(); ++g) {
    if (!is_mobile(grains, frame, g)) continue;
    double part = 0, sum = 0;
    all.visit(frame.position[g], [&](std::size_t near, double distance) {
      const double weight = grain_volume<D>(grains.radius[near]) * lucy(distance);
      sum += weight;
      if (grains.species[near] == of) part += weight;
    });
    shares[g] = ratio(part, sum);
  }
  return shares;
}

template std::vector<double> local_composition(const Grains&, const Frame<2>&, const Box&, Species,
                                               double);
template std::vector<double> local_composition(const Grains&, const Frame<3>&, const Box&, Species,
                                               double);

}  // namespace grseg
