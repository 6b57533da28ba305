// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/frames/composition.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace grseg {

template <int D>
void Composition<D>::add(const Grains& grains, const Frame<D>& frame)
{
  ++frames_;
  const std::size_t count = layers_.count(grains, frame);
  sums_.resize(std::max(sums_.size(), count), {Contents(species_), {0, 0}});
  for (std::size_t g = 0; g < grains.size(); ++g) {
    if (!is_mobile(grains, frame, g)) continue;
    const auto species = static_cast<std::size_t>(grains.species[g]);
    const double y = layers_.height<D>(frame.position[g]), radius = grains.radius[g];
    const double whole = grain_volume<D>(radius);
    const Vector<D> velocity = frame.velocity.empty()
                                   ? Vector<D>::Zero()
                                   : layers_.turned<D>(frame.velocity[g], frame.position[g]);
    const auto book = [&, square = velocity.squaredNorm()](std::size_t n, double part) {
      sums_[n].contents[species] += part;
      sums_[n].motion.u += part * velocity.x();
      sums_[n].motion.square += part * square;
    };
    if (rule_ == GrainArea::centre)
      book(layers_.holding<D>(frame.position[g], y), whole);
    else if (rule_ == GrainArea::clipped)
      layers_.share_grain<D>(y, radius, count, book);
    else
      share_kernel(layers_, *kernel_, y, y, count,
                   [&](std::size_t n, double share) { book(n, share * whole); });
  }
}

template <int D>
void Composition<D>::merge(const Composition& others)
{
  frames_ += others.frames_;
  accumulate(sums_, others.sums_);
}

template <int D>
typename Composition<D>::Contents Composition<D>::mean(std::size_t layer) const
{
  Contents mean = sums_[layer].contents;
  for (auto& content : mean) content /= static_cast<double>(frames_);
  return mean;
}

template <int D>
typename Composition<D>::Contents Composition<D>::mean() const
{
  Contents all(species_);
  for (std::size_t n = 0; n < layers(); ++n) accumulate(all, mean(n));
  return all;
}

template <int D>
MotionSums Composition<D>::motion(std::size_t layer) const
{
  const auto frames = static_cast<double>(frames_);
  const auto& sum = sums_[layer].motion;
  return {sum.u / frames, sum.square / frames};
}

template <int D>
std::vector<double> Composition<D>::row(std::size_t layer) const
{
  auto row = mean(layer);
  const auto sums = motion(layer);
  return add_all(row, {sums.u, sums.square});
}

template class Composition<2>;
template class Composition<3>;

std::vector<std::string> motion_columns(int dimension)
{
  const char* const content = dimension == 3 ? "volume" : "area";
  return {fmt::format("{}_u[m^{}/s]", content, dimension + 1),
          fmt::format("{}_v2[m^{}/s^2]", content, dimension + 2)};
}

template <int D>
BedHeights bed_heights(const Grains& grains, const Frame<D>& frame)
{
  std::array<double, 2> mass{}, moment{};
  double all = 0, all_moment = 0;  // sums of c and of c y; c: area over pi or volume over 4 pi/3
  for (std::size_t g = 0; g < grains.size(); ++g) {
    if (!is_mobile(grains, frame, g)) continue;
    const auto species = static_cast<std::size_t>(grains.species[g]);
    const double y = frame.position[g].y(), radius = grains.radius[g];
    const double content = D == 2 ? radius * radius : radius * radius * radius;
    if (species < mass.size()) {
      mass[species] += grains.mass[g];
      moment[species] += grains.mass[g] * y;
    }
    all += content;
    all_moment += content * y;
  }
  return {.large = ratio(moment[1], mass[1]),
          .small = ratio(moment[0], mass[0]),
          .bed = 2 * ratio(all_moment, all)};
}

template BedHeights bed_heights(const Grains&, const Frame<2>&);
template BedHeights bed_heights(const Grains&, const Frame<3>&);

std::vector<Cell> cells(const BedHeights& heights)
{
  return {{"yL[m]", heights.large}, {"yS[m]", heights.small}, {"height[m]", heights.bed}};
}

}  // namespace grseg
