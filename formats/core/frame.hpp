// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <optional>
#include <type_traits>
#include <vector>

/// The data that simulator and analysis share, in D = 2 or 3 dimensions. Everything is in SI units.
/// x points down the slope, y is normal to the base and points up, z points across the flow. The
/// cell may be periodic along x and z. Units of density and stress are kg/m^2 and N/m in two
/// dimensions, kg/m^3 and Pa in three.
namespace grseg {

template <int D>
using Vector = Eigen::Matrix<double, D, 1>;
template <int D>
using Tensor = Eigen::Matrix<double, D, D>;
/// Angular velocity: counter-clockwise in two dimensions, right-handed about each axis in three.
template <int D>
using Spin = std::conditional_t<D == 2, double, Vector<3>>;

using Vec2 = Vector<2>;
using Vec3 = Vector<3>;
using Tensor2 = Tensor<2>;
using Tensor3 = Tensor<3>;

/// Number of a mobile species: 0 for the smallest nominal diameter, 1 for the next, and so on. Most
/// runs have only the two species named here. Boundary grains belong to no species.
enum class Species : std::int32_t { boundary = -1, small = 0, large = 1 };

/// Constants of the grains during a run; entry g describes grain g in every frame.
struct Grains {
  std::vector<std::int32_t> id;
  std::vector<Species> species;
  std::vector<double> radius;       // m
  std::vector<double> mass;         // kg; the mass of a boundary grain has no effect
  std::vector<std::uint8_t> fixed;  // 1: the grain moves only as prescribed, and phi excludes it

  std::size_t size() const { return radius.size(); }
};

/// True for a grain of the flow. Boundary grains are in the file, but do not count in the
/// composition phi.
inline bool is_mobile(const Grains& grains, std::size_t grain)
{
  return grains.fixed[grain] == 0 && grains.species[grain] != Species::boundary;
}

/// The simulation cell. Along a periodic direction positions lie in [0, length).
struct Box {
  double length_x = 0;  // length along the flow, m
  double length_y = 0;  // height, m; used only by viewers, because y is never periodic
  bool periodic_x = true;
  int dimension = 2;
  double length_z = 0;  // width across the flow, m; 0 in two dimensions
  bool periodic_z = false;
  // Ends of the cell at the smallest x and z, m. 0 along periods and in runs of grseg-sim; an import
  // keeps the archive's coordinates along open axes.
  double low_x = 0, low_z = 0;
};

/// Area of a disc (m^2) or volume of a sphere (m^3) of this radius (m).
template <int D>
double grain_volume(double radius)
{
  if constexpr (D == 2)
    return std::numbers::pi * radius * radius;
  else
    return 4 * std::numbers::pi / 3 * radius * radius * radius;
}

/// Mass of the mobile grains (of one species if `species` is given) divided by their area or
/// volume, kg/m^2 or kg/m^3; 0 without grains.
template <int D>
double mean_density(const Grains& grains, std::optional<Species> species = std::nullopt);

/// True if all mobile grains have one density, within 1e-5 (archives of other programs have few
/// digits). Shares of mass then equal shares of area or volume.
template <int D>
bool have_one_density(const Grains& grains);

/// Moment of inertia of a disc or sphere divided by (mass x radius^2).
template <int D>
inline constexpr double inertia_factor = D == 2 ? 0.5 : 0.4;

/// Touching pairs as parallel arrays, one entry per contact.
///
/// `force` is the force ON i FROM j, `branch` is x_i - x_j (minimum image), so that
/// sigma = (1/V) sum force (x) branch is positive in compression (Rothenburg & Selvadurai 1981).
/// i is a mobile grain. i and j are rows of Grains, not ids; j < 0 is straight wall number -j-1,
/// and then `branch` is x_i minus the contact point. Two boundary grains never form a contact.
template <int D>
struct ContactList {
  std::vector<std::int32_t> i, j;
  std::vector<Vector<D>> force;   // impulse of the whole step divided by the step, N
  std::vector<Vector<D>> branch;  // x_i - x_j, m
  std::vector<double> gap;        // distance of the two surfaces, m; negative if they overlap

  std::size_t size() const { return i.size(); }
  void clear();
  void reserve(std::size_t contacts);
};

/// One time step of the run. `time`, `position`, `branch` and `gap` are values at the middle of the
/// step, when contacts are detected; `velocity` and `angular_velocity` are values after the contact
/// forces were solved. `force` is m (v_after - v_before)/h with the step h, so that every mobile
/// grain satisfies: sum of its contact forces + m g - force = 0 to round-off.
///
/// If grains enter and leave the run (RunDescription::grains_come_and_go), a grain that is absent
/// has NaN in position, velocity, spin and force, and belongs to no contact.
template <int D>
struct Frame {
  std::int64_t step = 0;  // number of the step; time = (step + 1/2) h
  double time = 0;        // middle of the step, s; 0 at the tilt (docs/glossary.md)
  double part = 0;  // the h of `force`, s: length of the step, or of its last part if the simulator
                    // divided the step; 0 if it was not read
  std::vector<Vector<D>> position;                 // m, wrapped into the cell
  std::vector<std::array<std::int32_t, D>> image;  // number of periods to add to `position`
  std::vector<Vector<D>> velocity;                 // m/s
  std::vector<Spin<D>> angular_velocity;           // rad/s
  std::vector<Vector<D>> force;                    // N; empty if an imported archive had none
  ContactList<D> contacts;
};

/// Time (s) during which `force` changed the velocities: Frame::part, or `step` if that is 0.
template <int D>
double step_of_force(const Frame<D>& frame, double step)
{
  return frame.part > 0 ? frame.part : step;
}

/// True if grain g is present in this frame.
template <int D>
bool is_present(const Frame<D>& frame, std::size_t g)
{
  return !std::isnan(frame.position[g].y());
}

/// Number of grains that are present in this frame.
template <int D>
std::size_t number_present(const Frame<D>& frame)
{
  std::size_t number = 0;
  for (std::size_t g = 0; g < frame.position.size(); ++g) number += is_present(frame, g) ? 1 : 0;
  return number;
}

/// True if grain g belongs to the flow and is present in this frame.
template <int D>
bool is_mobile(const Grains& grains, const Frame<D>& frame, std::size_t g)
{
  return is_mobile(grains, g) && is_present(frame, g);
}

/// Hash of the set of grains that are absent in this frame; 0 if all are present.
template <int D>
std::uint64_t which_are_absent(const Frame<D>& frame);

/// Marks grain g as absent in a frame whose arrays already have one entry per grain, or none if
/// they were not read.
template <int D>
void make_absent(Frame<D>& frame, std::size_t g);

/// Contact point of two grains, x_i - branch (r_i + gap/2)/(r_i + r_j + gap); at a wall
/// x_i - branch.
template <int D>
Vector<D> contact_point(const Grains& grains, const Frame<D>& frame, std::size_t contact);

/// Fraction of the branch that lies between the centre of grain i and the contact point; 1 at a
/// wall.
template <int D>
double share_of_first(const Grains& grains, const ContactList<D>& contacts, std::size_t contact);

/// Gravity of a run whose slope is fixed or, from t = 0 on, steepens at a constant rate (turning
/// about z). A time step uses gravity at the middle of the step, which is the time of the frame.
template <int D>
struct Gravity {
  Vector<D> start = Vector<D>::Zero();  ///< gravity at t = 0, m/s^2
  double slope_rate = 0;                ///< rad/s, rate at which the slope steepens

  Gravity() = default;
  // Implicit conversion: gravity on a fixed slope is a vector.
  Gravity(const Vector<D>& constant) : start(constant) {}
  Gravity(const Vector<D>& at_first, double rate) : start(at_first), slope_rate(rate) {}

  bool turns() const { return slope_rate != 0; }
  double norm() const { return start.norm(); }  // magnitude, m/s^2, the same at all times
  /// Gravity (m/s^2) at `time` (s).
  Vector<D> at(double time) const;
  /// Mean gravity (m/s^2) over `steps` >= 1 consecutive steps of length `step` (s), all after
  /// t = 0; `last` (s) is the middle of the last step.
  Vector<D> mean(double last, std::int64_t steps, double step) const;
};

/// Calls `work` with the number of dimensions, 2 or 3, as a compile-time constant, so that `work`
/// can use it as a template argument:
/// with_dimension(run.dimension(), [&](auto d) { Frame<d> frame; ... }).
template <class Work>
decltype(auto) with_dimension(int dimension, const Work& work)
{
  if (dimension == 3) return work(std::integral_constant<int, 3>{});
  return work(std::integral_constant<int, 2>{});
}

}  // namespace grseg
