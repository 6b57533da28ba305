// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "tests/sim/worlds.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

/// The contact laws of the simulator: when a pair takes part in a step. What a test with a
/// parameter expects must hold under each.
namespace grseg::hard_cases {

struct Law {
  std::string name;
  void (*choose)(World&);
};

inline std::vector<Law> laws()
{
  return {{"touch", [](World&) {}}};
}

class UnderEveryLaw : public testing::TestWithParam<Law> {
 protected:
  World world_of(const std::vector<worlds::Disc>& discs) const
  {
    auto world = worlds::world_of(discs);
    GetParam().choose(world);
    return world;
  }
};

inline std::string name_of(const testing::TestParamInfo<Law>& law)
{
  return law.param.name;
}

}  // namespace grseg::hard_cases
