// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "tests/sim/worlds.hpp"

#include <gtest/gtest.h>

#include <ostream>
#include <string>
#include <vector>

/// The contact laws of the simulator: when a pair takes part in a step. What a test with a
/// parameter expects must hold under each.
namespace grseg::hard_cases {

struct Law {
  std::string name;
  void (*choose)(World&);

  friend void PrintTo(const Law& law, std::ostream* out) { *out << law.name; }
};

/// Those that act no earlier than in the step in whose middle the touch lies nearest; the bounds of
/// the tests are theirs.
inline std::vector<Law> laws()
{
  return {{"touch", [](World&) {}}, {"centred", [](World& w) { w.forecast = 0.5; }}};
}

/// The others: predictive contacts act earlier, speculative ones are slowed down in one step and
/// rebound in the next.
inline std::vector<Law> early_laws()
{
  return {{"predictive", [](World& w) { w.forecast = 1; }},
          {"speculativeHalfStep", [](World& w) { w.horizon = w.forecast = 0.5; }},
          {"speculative", [](World& w) { w.horizon = w.forecast = 0.75; }},
          {"speculativeWholeStep", [](World& w) { w.horizon = w.forecast = 1; }}};
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
