// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/frames/map_flow.hpp"

#include "analysis/frames/sums.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace grseg {

template <int D>
void PlaneSums<D>::add(const Vec2& place, double grain_mass, const Motion<D>& motion)
{
  mass += grain_mass;
  moment += grain_mass * place;
  second += grain_mass * place * place.transpose();
  momentum += grain_mass * motion;
  product += grain_mass * motion * place.transpose();
}

template <int D>
MotionPlane<D>::MotionPlane(const PlaneSums<D>& sums, double side)
    : mass(sums.mass),
      centre(sums.moment / sums.mass),
      mean(sums.momentum / sums.mass),
      inverse(Tensor2::Zero())
{
  const Tensor2 spread = sums.second - sums.moment * centre.transpose();
  const Eigen::SelfAdjointEigenSolver<Tensor2> axes(spread);
  for (Eigen::Index k = 0; k < 2; ++k) {
    const double moment = axes.eigenvalues()[k];
    const Vec2 axis = axes.eigenvectors().col(k);
    constexpr double resolved = 1e-3;  // of the side
    if (moment > mass * resolved * resolved * side * side)
      inverse += axis * axis.transpose() / moment;
  }
  gradient = (sums.product - mean * sums.moment.transpose()) * inverse;
}

template <int D>
double MotionPlane<D>::own_part(const Vec2& place, double grain_mass) const
{
  const Vec2 from_centre = place - centre;
  return grain_mass * (1 / mass + from_centre.dot(inverse * from_centre));
}

template <int D>
MapFlow<D>::MapFlow(const MapGrid& cells, double patch)
    : patches_{cells.divided(patch)}, cells_{cells}
{
}

template <int D>
void MapFlow<D>::Planes::add(const Vector<D>& position, double mass, const Motion<D>& motion)
{
  sums[grid.at<D>(position)].add(grid.in_cell<D>(position), mass, motion);
}

template <int D>
void MapFlow<D>::Planes::finish()
{
  const double side = std::max(grid.axes[0].side, grid.axes[1].side);
  for (const auto& [cell, of_grains] : sums) planes.emplace(cell, MotionPlane<D>(of_grains, side));
}

template <int D>
void MapFlow<D>::add(const Vector<D>& position, double mass, const Motion<D>& motion)
{
  patches_.add(position, mass, motion);
  cells_.add(position, mass, motion);
}

template <int D>
void MapFlow<D>::merge(const MapFlow& others)
{
  for (const auto& [cell, sums] : others.patches_.sums) accumulate(patches_.sums[cell], sums);
  for (const auto& [cell, sums] : others.cells_.sums) accumulate(cells_.sums[cell], sums);
}

template <int D>
void MapFlow<D>::finish()
{
  patches_.finish();
  cells_.finish();
}

template <int D>
const MotionPlane<D>& MapFlow<D>::patch_at(const Vector<D>& position) const
{
  return patches_.planes.at(patches_.grid.template at<D>(position));
}

template <int D>
Motion<D> MapFlow<D>::at(const Vector<D>& position) const
{
  return patch_at(position).at(patches_.grid.template in_cell<D>(position));
}

template <int D>
double MapFlow<D>::own_part(const Vector<D>& position, double mass) const
{
  return patch_at(position).own_part(patches_.grid.template in_cell<D>(position), mass);
}

template <int D>
std::optional<MotionProduct<D>> MapFlow<D>::about_others(const Vector<D>& position, double mass,
                                                         const Motion<D>& motion) const
{
  constexpr double least = 1e-6;  // share of the others, above round-off
  const double of_others = 1 - own_part(position, mass);
  if (!(of_others > least)) return std::nullopt;
  const Motion<D> excess = motion - at(position);
  return symmetric_product<D>(1 / of_others, excess, excess);
}

template <int D>
double MapFlow<D>::shear_rate(std::size_t cell) const
{
  const auto found = cells_.planes.find(cell);
  if (found == cells_.planes.end()) return no_number;
  const auto& plane = found->second;
  const auto& grid = cells_.grid;
  const bool radial = grid.plane == MapPlane::rz;
  const Eigen::Index first = radial ? 1 : 0, second = grid.plane == MapPlane::xy ? 1 : D - 1;
  Tensor<D> gradient = Tensor<D>::Zero();  // of component (row) along axis (column)
  gradient.col(first) = plane.gradient.template block<D, 1>(0, 0);
  gradient.col(second) = plane.gradient.template block<D, 1>(0, 1);
  if (radial) {  // the axes along which components are measured turn round the axis
    const double r = grid.axes[0].edge(grid.column(cell)) + plane.centre.x();
    gradient(0, 0) = plane.mean[1] / r;
    gradient(1, 0) = -plane.mean[0] / r;
  }
  return ((gradient + gradient.transpose()) / 2).norm() * std::sqrt(2.0);
}

template struct PlaneSums<2>;
template struct PlaneSums<3>;
template struct MotionPlane<2>;
template struct MotionPlane<3>;
template class MapFlow<2>;
template class MapFlow<3>;

}  // namespace grseg
