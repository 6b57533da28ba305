// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/frames/ring.hpp"

#include <Eigen/QR>
#include <vector>

namespace grseg {
namespace {

constexpr std::size_t fewest_points = 8, most_frames = 10;
constexpr double roundness = 0.01;  // largest r.m.s. distance from the circle over its radius

/// Points of a frame at which straight walls touch grains, but not walls normal to z.
template <int D>
void add_wall_points(const Frame<D>& frame, std::vector<Vec2>& all)
{
  const auto& contacts = frame.contacts;
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    const auto& branch = contacts.branch[c];
    const Vec2 in_plane = branch.template head<2>();
    if (contacts.j[c] >= 0 || in_plane.norm() < branch.norm() / 2) continue;
    all.push_back(frame.position[static_cast<std::size_t>(contacts.i[c])].template head<2>() -
                  in_plane);
  }
}

template <int D>
std::vector<Vec2> points_of_boundary(const TrajectoryReader& run)
{
  std::vector<Vec2> all;
  Frame<D> frame;
  for (std::size_t k = 0; k < most_frames; ++k) {
    run.read(k * (run.size() - 1) / (most_frames - 1), frame, {.velocity = false});
    add_wall_points(frame, all);
  }
  if (!all.empty()) return all;
  const auto& grains = run.grains();
  for (std::size_t g = 0; g < grains.size(); ++g)
    if (!is_mobile(grains, frame, g) && is_present(frame, g))
      all.push_back(frame.position[g].template head<2>());
  return all;
}

}  // namespace

std::optional<Ring> find_ring(const TrajectoryReader& run)
{
  if (run.size() == 0) return std::nullopt;
  const auto points =
      with_dimension(run.dimension(), [&](auto d) { return points_of_boundary<d>(run); });
  if (points.size() < fewest_points) return std::nullopt;
  Vec2 middle = Vec2::Zero();
  for (const auto& point : points) middle += point / static_cast<double>(points.size());
  // x^2 + y^2 = 2 a x + 2 b y + c, about the middle of the points.
  Eigen::MatrixX3d rows(points.size(), 3);
  Eigen::VectorXd squares(points.size());
  for (Eigen::Index k = 0; k < rows.rows(); ++k) {
    const Vec2 from = points[static_cast<std::size_t>(k)] - middle;
    rows.row(k) << 2 * from.x(), 2 * from.y(), 1;
    squares[k] = from.squaredNorm();
  }
  const Eigen::Vector3d found = rows.colPivHouseholderQr().solve(squares);
  const Vec2 centre = found.head<2>();
  const Ring ring{middle + centre, std::sqrt(found[2] + centre.squaredNorm())};
  double deviations = 0;
  for (const auto& point : points)
    deviations += std::pow((point - ring.centre).norm() - ring.radius, 2);
  const double reach = rows.leftCols<2>().rowwise().norm().maxCoeff() / 2;
  const bool is_round =
      std::sqrt(deviations / static_cast<double>(points.size())) < roundness * reach;
  return is_round && reach > ring.radius / 4 ? std::optional(ring) : std::nullopt;
}

}  // namespace grseg
