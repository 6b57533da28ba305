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
/// x points down the slope, y is normal to the base and points up, z goes across; the cell may be
/// periodic along x and z. In two dimensions a density is in kg/m^2 and a stress in N/m, in three
/// in kg/m^3 and Pa. The simulator knows two dimensions only.
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

/// Mobile species are numbered in order of their nominal diameters, from 0; most runs have the two
/// that have names here. Boundary grains belong to none.
enum class Species : std::int32_t { boundary = -1, small = 0, large = 1 };

/// Constants of the grains during a run; entry g describes grain g in every frame.
struct Grains {
  std::vector<std::int32_t> id;
  std::vector<Species> species;
  std::vector<double> radius;       // m
  std::vector<double> mass;         // kg; boundary grains have one, too, but it has no effect
  std::vector<std::uint8_t> fixed;  // 1: moves only as prescribed, and is not part of phi

  std::size_t size() const { return radius.size(); }
};

/// True for a grain of the flow. Boundary grains are in the file, but not in phi.
inline bool is_mobile(const Grains& grains, std::size_t grain)
{
  return grains.fixed[grain] == 0 && grains.species[grain] != Species::boundary;
}

/// The cell. Where it is periodic, positions lie in [0, length).
struct Box {
  double length_x = 0;  // m
  double length_y = 0;  // m, only for viewers: nothing is periodic in y
  bool periodic_x = true;
  int dimension = 2;
  double length_z = 0;  // m; 0 in two dimensions
  bool periodic_z = false;
};

/// Area (m^2) or volume (m^3) of a grain: a disc or a sphere.
template <int D>
double grain_volume(double radius)
{
  if constexpr (D == 2)
    return std::numbers::pi * radius * radius;
  else
    return 4 * std::numbers::pi / 3 * radius * radius * radius;
}

/// Mass of the mobile grains over their area or volume, kg/m^2 or kg/m^3; of one species where it
/// is given. 0 without grains.
template <int D>
double mean_density(const Grains& grains, std::optional<Species> species = std::nullopt);

/// True where all mobile grains have one density, to the digits of archives (1e-5): shares of mass
/// are then shares of area or volume.
template <int D>
bool have_one_density(const Grains& grains);

/// Moment of inertia of a grain over its mass times the square of its radius: a disc or a sphere.
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
  std::vector<Vector<D>> force;   // N, impulse of the whole step divided by the step
  std::vector<Vector<D>> branch;  // m
  std::vector<double> gap;        // m, negative where the two overlap

  std::size_t size() const { return i.size(); }
  void clear();
  void reserve(std::size_t contacts);
};

/// One step of the run, frozen. `time`, `position`, `branch` and `gap` belong to the middle of the
/// step, at which contacts are detected; `velocity` and `angular_velocity` are those after the
/// solve; `force` is m (v_after - v_before)/h, so that for every mobile grain
/// sum of its contact forces + m g - force = 0 to round-off.
///
/// In a run in which grains come and go (RunDescription::grains_come_and_go) a grain that is absent
/// has NaN in position, velocity, spin and force; no contact names it.
template <int D>
struct Frame {
  std::int64_t step = 0;  // time = (step + 1/2) h
  double time = 0;        // s, 0 at the tilt
  double part = 0;  // s, length of the step, or of its last part if it was taken in parts, which is
                    // then the h of `force`; 0 where it was not read
  std::vector<Vector<D>> position;                 // m, wrapped into the cell
  std::vector<std::array<std::int32_t, D>> image;  // periods to add to `position`
  std::vector<Vector<D>> velocity;                 // m/s
  std::vector<Spin<D>> angular_velocity;           // rad/s
  std::vector<Vector<D>> force;                    // N; empty where an import had none
  ContactList<D> contacts;
};

/// The h in which `force` has changed the velocities; `step` s unless the frame says otherwise.
template <int D>
double step_of_force(const Frame<D>& frame, double step)
{
  return frame.part > 0 ? frame.part : step;
}

/// True where grain g is present in this frame.
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

/// True where grain g belongs to the flow and is present in this frame.
template <int D>
bool is_mobile(const Grains& grains, const Frame<D>& frame, std::size_t g)
{
  return is_mobile(grains, g) && is_present(frame, g);
}

/// A number that tells which grains are absent in this frame: 0 where all are there, and the same
/// for the same grains.
template <int D>
std::uint64_t which_are_absent(const Frame<D>& frame);

/// Marks grain g as absent in a frame whose arrays have their sizes.
template <int D>
void make_absent(Frame<D>& frame, std::size_t g);

/// Where two grains touch: x_i - branch (r_i + gap/2)/(r_i + r_j + gap); at a wall the contact
/// point is x_i - branch.
template <int D>
Vector<D> contact_point(const Grains& grains, const Frame<D>& frame, std::size_t contact);

/// Fraction of the branch that lies between the centre of grain i and the contact point; 1 at a
/// wall.
template <int D>
double share_of_first(const Grains& grains, const ContactList<D>& contacts, std::size_t contact);

/// Gravity of a run on a slope that is fixed or becomes steeper at a constant rate from t = 0 on. A
/// step is subject to gravity at its middle, which is the time of a frame. The slope turns about z.
template <int D>
struct Gravity {
  Vector<D> start = Vector<D>::Zero();  ///< m/s^2, at t = 0
  double slope_rate = 0;                ///< rad/s

  Gravity() = default;
  // Implicit: without a changing slope gravity is just a vector.
  Gravity(const Vector<D>& constant) : start(constant) {}
  Gravity(const Vector<D>& at_first, double rate) : start(at_first), slope_rate(rate) {}

  bool turns() const { return slope_rate != 0; }
  double norm() const { return start.norm(); }  // m/s^2, at any time
  /// m/s^2, at `time` in s.
  Vector<D> at(double time) const;
  /// The mean over `steps` >= 1 steps of length `step` (s), the last of which has its middle at
  /// `last` (s), all after t = 0.
  Vector<D> mean(double last, std::int64_t steps, double step) const;
};

/// Calls `work` with the number of dimensions, 2 or 3, as a constant, which chooses the templates
/// that it uses: with_dimension(run.dimension(), [&](auto d) { Frame<d> frame; ... }).
template <class Work>
decltype(auto) with_dimension(int dimension, const Work& work)
{
  if (dimension == 3) return work(std::integral_constant<int, 3>{});
  return work(std::integral_constant<int, 2>{});
}

}  // namespace grseg
