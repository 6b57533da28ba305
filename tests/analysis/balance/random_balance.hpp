// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/balance/momentum_balance.hpp"
#include "tests/analysis/grain_builder.hpp"

#include <random>
#include <vector>

/// Random grains and contacts for balances under every rule.
namespace grseg {

inline constexpr double gauge_step = 1e-3, kernel_width = 0.2;
inline const Kernel bell(kernel_width);
inline const std::vector<PartitionRule> all_rules = parse_rules(
    {"size", "contact-point", "half", "drop", "uniform:0", "uniform:0.3", "uniform:1", "power:2"});

template <int D>
Layers thin_layers()
{
  if constexpr (D == 2)
    return {1, 10};
  else
    return {1, 10, 7};
}

template <int D>
Vector<D> some_gravity()
{
  Vector<D> g = Vector<D>::Zero();
  g.x() = 3;
  g.y() = -9;
  return g;
}

/// Grains of several species and a base, with overlaps and gaps, joined by contacts with random
/// forces, and the stored forces on the grains. Radii differ within a species, so that shares under
/// size rules differ from contact to contact.
template <int D>
PackingOf<D> random_contacts(unsigned seed, int species = 2)
{
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> place(0, 3), any(-1, 1);
  const auto vector = [&] {
    Vector<D> v;
    for (auto& component : v) component = any(random);
    return v;
  };
  PackingOf<D> scene;
  for (int g = 0; g < 70; ++g) {
    const bool base = g < 5;
    Vector<D> position = Vector<D>::Zero();
    for (auto& component : position) component = place(random);
    if (base) position.y() = -0.1;
    scene.grain(base ? Species::boundary : static_cast<Species>(g % species),
                0.1 * (1 + g % species) * (1 + 0.1 * any(random)), position, vector());
  }
  std::uniform_int_distribution<std::int32_t> mobile(5, 69), either(0, 69);
  for (int k = 0; k < 200; ++k) {
    const auto i = mobile(random), j = either(random);
    if (i != j) scene.contact(i, j, vector());
  }
  Vector<D> arm = Vector<D>::Constant(0.05);
  scene.wall_contact(7, 0, vector(), arm);
  auto& stored = scene.frame.force;
  for (const double mass : scene.grains.mass) stored.emplace_back(mass * some_gravity<D>());
  const auto& list = scene.frame.contacts;
  for (std::size_t k = 0; k < list.size(); ++k) {
    stored[static_cast<std::size_t>(list.i[k])] += list.force[k];
    if (list.j[k] >= 0) stored[static_cast<std::size_t>(list.j[k])] -= list.force[k];
  }
  return scene;
}

template <int D>
PartitionedBalance<D> contacts_of(const std::vector<PackingOf<D>>& frames,
                                  const std::vector<PartitionRule>& rules = all_rules,
                                  std::size_t species = 2, const Kernel& kernel = bell)
{
  PartitionedBalance<D> contacts(thin_layers<D>(), kernel, rules, species);
  for (const auto& scene : frames) contacts.add(scene.grains, scene.frame);
  return contacts;
}

template <int D>
MomentumBalance<D> momentum_of(const std::vector<PackingOf<D>>& frames, std::size_t species = 2,
                               const Kernel& kernel = bell)
{
  MomentumBalance<D> balance(thin_layers<D>(), kernel, some_gravity<D>(), gauge_step, species);
  for (const auto& scene : frames) balance.add(scene.grains, scene.frame);
  return balance;
}

/// Two frames half a second apart, between which grains have moved.
inline std::vector<Packing> two_frames(unsigned seed)
{
  auto scene = random_contacts<2>(seed);
  // Most contacts are repulsive, so that there is a stress to share.
  auto& list = scene.frame.contacts;
  for (std::size_t k = 0; k < list.size(); ++k) {
    const Vec2 push = 2 * list.branch[k].normalized();
    scene.frame.force[static_cast<std::size_t>(list.i[k])] += push;
    if (list.j[k] >= 0) scene.frame.force[static_cast<std::size_t>(list.j[k])] -= push;
    list.force[k] += push;
  }
  auto later = scene;
  later.frame.time = 0.5;
  for (auto& velocity : later.frame.velocity) velocity *= 1.5;
  return {scene, later};
}

}  // namespace grseg
