// SPDX-License-Identifier: GPL-3.0-or-later
#include "sim/run/summary.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace grseg {
namespace {

/// Staron & Phillips' bed: sixty layers of 5 mm, density 1 kg/m^2, with fifty sweeps per 0.2 ms.
StiffnessInput paper_bed()
{
  return {.sweeps = 50,
          .step = 2e-4,
          .mass = std::numbers::pi / 4 * 25e-6,
          .diameter = 5e-3,
          .base_pressure = 2.35,
          .layers = 60,
          .gravity = 9.8};
}

TEST(NumericalStiffness, OfThePapersBedAtFiftySweeps)
{
  const auto s = numerical_stiffness(paper_bed());
  EXPECT_NEAR(s.stiffness, 2.4544e4, 1);
  EXPECT_NEAR(s.rigidity, 1.0444e4, 1);
  EXPECT_NEAR(s.sound_speed, 176.78, 0.01);
}

TEST(NumericalStiffness, SoundIsThatOfAChainOfTheStiffness)
{
  const auto in = paper_bed();
  const auto s = numerical_stiffness(in);
  EXPECT_NEAR(s.sound_speed, in.diameter * std::sqrt(s.stiffness / in.mass), 1e-9);
}

TEST(NumericalStiffness, WhatItAdvisesIsRigidAndSinksByAThousandthOfADiameter)
{
  for (const double pressure : {0.01, 2.35, 1e3}) {
    auto in = paper_bed();
    in.base_pressure = pressure;
    const auto advised = numerical_stiffness(in);
    auto with_step = in, with_sweeps = in;
    with_step.step = advised.advised_step;
    with_sweeps.sweeps = advised.advised_sweeps;
    for (const auto& then : {with_step, with_sweeps}) {
      const double rigidity = numerical_stiffness(then).rigidity;
      const double sinking =
          then.layers * then.layers * then.gravity * then.step * then.step / (2 * then.sweeps);
      EXPECT_GE(rigidity, 1e4 * (1 - 1e-12));
      EXPECT_LE(sinking, 1e-3 * then.diameter * (1 + 1e-12));
      EXPECT_NEAR(std::max(1e4 / rigidity, sinking / (1e-3 * then.diameter)), 1, 1e-12);
    }
  }
}

}  // namespace
}  // namespace grseg
