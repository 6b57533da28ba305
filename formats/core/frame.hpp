// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

/// The data that simulator and analysis share. Everything is in SI units and two-dimensional: a
/// density is in kg/m^2, a force in N, a stress in N/m. x points down the slope and may be
/// periodic, y is normal to the base and points up.
namespace grseg {

using Vec2 = Eigen::Vector2d;
using Tensor2 = Eigen::Matrix2d;

enum class Species : std::int32_t { small = 0, large = 1, boundary = 2 };

/// What never changes during a run; entry g describes grain g in every frame.
struct Grains {
  std::vector<std::int32_t> id;
  std::vector<Species> species;
  std::vector<double> radius;       // m
  std::vector<double> mass;         // kg; boundary grains have one, too, but it has no effect
  std::vector<std::uint8_t> fixed;  // 1: moves only as prescribed, and is not part of phi

  std::size_t size() const { return radius.size(); }
};

/// Whether a grain belongs to the flow. Boundary grains are in the file, but not in phi.
inline bool is_mobile(const Grains& grains, std::size_t grain)
{
  return grains.fixed[grain] == 0 && grains.species[grain] != Species::boundary;
}

/// The cell. Where it is periodic, positions lie in [0, length_x).
struct Box {
  double length_x = 0;  // m
  double length_y = 0;  // m, only for viewers: nothing is periodic in y
  bool periodic_x = true;
};

/// Touching pairs as parallel arrays, one entry per contact.
///
/// `force` is the force ON i FROM j, `branch` is x_i - x_j (minimum image), so that
/// sigma = (1/V) sum force (x) branch is positive in compression (Rothenburg & Selvadurai 1981).
/// i is a mobile grain. i and j are rows of Grains, not ids; j < 0 is straight wall number -j-1,
/// and then `branch` is x_i minus the contact point. Two boundary grains never form a contact.
struct ContactList {
  std::vector<std::int32_t> i, j;
  std::vector<Vec2> force;   // N, impulse of the whole step divided by the step
  std::vector<Vec2> branch;  // m
  std::vector<double> gap;   // m, negative where the two overlap

  std::size_t size() const { return i.size(); }
  void clear();
  void reserve(std::size_t contacts);
};

/// One step of the run, frozen. `time`, `position`, `branch` and `gap` belong to the middle of the
/// step, at which contacts are detected; `velocity` and `angular_velocity` are those after the
/// solve; `force` is m (v_after - v_before)/h, so that for every mobile grain
/// sum of its contact forces + m g - force = 0 to round-off.
struct Frame {
  std::int64_t step = 0;                           // time = (step + 1/2) h
  double time = 0;                                 // s, 0 at the tilt
  std::vector<Vec2> position;                      // m, x wrapped into [0, length_x)
  std::vector<std::array<std::int32_t, 2>> image;  // periods to add to `position`
  std::vector<Vec2> velocity;                      // m/s
  std::vector<double> angular_velocity;            // rad/s, counter-clockwise
  std::vector<Vec2> force;                         // N; empty where an import had none
  ContactList contacts;
};

/// Where two grains touch: x_i - branch (r_i + gap/2)/(r_i + r_j + gap); at a wall the contact
/// point is x_i - branch.
Vec2 contact_point(const Grains& grains, const Frame& frame, std::size_t contact);

/// Fraction of the branch that lies between the centre of grain i and the contact point; 1 at a
/// wall.
double share_of_first(const Grains& grains, const ContactList& contacts, std::size_t contact);

}  // namespace grseg
