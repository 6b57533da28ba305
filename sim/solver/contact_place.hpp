// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "sim/contact/contact_blocks.hpp"

#include <algorithm>
#include <cstdint>
#include <span>

namespace grseg {

constexpr std::uint32_t doubles_per_body = sizeof(Motion) / sizeof(double);

/// Where a contact is that is solved by itself.
struct ContactPlace {
  ContactBlock* block;
  std::uint32_t lane;

  /// Indices in the span of Motion.
  std::uint32_t i() const { return block->i[lane] / doubles_per_body; }
  std::uint32_t j() const { return block->j[lane] / doubles_per_body; }

  Contact contact() const
  {
    const auto& b = *block;
    return {{b.nx[lane], b.ny[lane], b.kappa[lane], b.mass_n[lane], b.mass_t[lane], b.rebound[lane],
             b.impulse_n[lane], b.impulse_t[lane]},
            static_cast<std::int32_t>(i()),
            static_cast<std::int32_t>(j())};
  }
  void set_impulse(double n, double t) const
  {
    block->impulse_n[lane] = n;
    block->impulse_t[lane] = t;
  }
  /// The contact need no more than stop its approach.
  void bar_rebound() const { block->rebound[lane] = std::min(block->rebound[lane], 0.0); }
  /// One relaxation. Without `restitution` rebounds are 0.
  Relaxed<double> relax(Relax relax_alone, bool restitution, std::span<Motion> motion,
                        double friction) const
  {
    auto alone = contact();
    if (!restitution) alone.rebound = 0;
    const auto change = relax_alone(alone, motion[i()], motion[j()], friction);
    set_impulse(alone.impulse_n, alone.impulse_t);
    return change;
  }
};

}  // namespace grseg
