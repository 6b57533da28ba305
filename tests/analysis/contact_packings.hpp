// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/stress/partial_contact_stress.hpp"
#include "tests/analysis/grain_builder.hpp"

#include <optional>
#include <random>
#include <vector>

/// Packings whose partial contact stresses are known by hand or from a sum over contacts. Layers
/// have the height 1, the cell the length 10.
namespace grseg {

inline const Layers unit_layers(1, 10);
inline const Vec2 push{-0.5, 3};

/// Dyadic product force (x) branch, computed by hand.
inline Tensor2 dyad(const Vec2& f, const Vec2& b)
{
  Tensor2 t;
  t << f.x() * b.x(), f.x() * b.y(), f.y() * b.x(), f.y() * b.y();
  return t;
}

inline constexpr Assignment all_assignments[] = {Assignment::contact_point, Assignment::branch,
                                                 Assignment::grain, Assignment::kernel};
inline const Kernel smooth(0.3);

inline PartialContactStress<2> stress_of(const Packing& packing, Assignment assignment,
                                         std::optional<double> power = std::nullopt,
                                         const Kernel& kernel = smooth)
{
  PartialContactStress<2> stress(unit_layers, assignment, power, kernel);
  stress.add(packing.grains, packing.frame);
  return stress;
}

/// A large grain at height 2.75 on a small one at height 1.25, touching at 1.75: the large grain's
/// share is two thirds, the branch is (0, 1.5).
inline Packing large_on_small()
{
  Packing packing;
  const auto large = packing.grain(Species::large, 1, {5, 2.75});
  const auto small = packing.grain(Species::small, 0.5, {5, 1.25});
  packing.contact(large, small, push);
  return packing;
}
inline const Tensor2 mixed = dyad(push, {0, 1.5});

/// A small grain of radius 0.5 at height 1.25 on a base grain of radius 1 at -0.25, touching at
/// 0.75. Its force (x) branch also equals `mixed`.
inline Packing small_on_base()
{
  Packing packing;
  const auto small = packing.grain(Species::small, 0.5, {5, 1.25});
  const auto base = packing.grain(Species::boundary, 1, {5, -0.25});
  packing.contact(small, base, push);
  return packing;
}

/// A heap of grains in a cell of 10 x 5 with random contacts and forces. Forces are not in balance,
/// which sums do not require.
inline Packing heap()
{
  std::mt19937 random(7);
  std::uniform_real_distribution<double> number(0, 1);
  Packing packing;
  for (int g = 0; g < 60; ++g) {
    const auto species = g % 3 == 0    ? Species::large
                         : g % 10 == 1 ? Species::boundary
                                       : Species::small;
    packing.grain(species, 0.2 + 0.5 * number(random), {10 * number(random), 5 * number(random)});
  }
  for (std::int32_t i = 0; i < 60; ++i)
    for (std::int32_t j = 0; j < 60; j += 7)
      if (i != j && packing.grains.fixed[static_cast<std::size_t>(i)] == 0)
        packing.contact(i, j, {number(random) - 0.5, number(random) - 0.5});
  return packing;
}

/// Sum of the contact forces on each grain.
inline std::vector<Vec2> net_forces(const Packing& packing)
{
  const auto& list = packing.frame.contacts;
  std::vector<Vec2> net(packing.grains.size(), Vec2::Zero());
  for (std::size_t k = 0; k < list.size(); ++k) {
    net[static_cast<std::size_t>(list.i[k])] += list.force[k];
    net[static_cast<std::size_t>(list.j[k])] -= list.force[k];
  }
  return net;
}

inline std::vector<double> total(const PartialContactStress<2>& stress)
{
  std::vector<double> sum(stress.row(0).size());
  for (std::size_t n = 0; n < stress.layers(); ++n)
    for (std::size_t c = 0; c < sum.size(); ++c) sum[c] += stress.row(n)[c];
  return sum;
}

}  // namespace grseg
