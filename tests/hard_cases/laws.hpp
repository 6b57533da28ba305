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

/// Those under which an impact takes one step.
inline std::vector<Law> immediate_laws()
{
  return {{"touch", [](World&) {}},
          {"centred", [](World& w) { w.forecast = 0.5; }},
          {"predictive", [](World& w) { w.forecast = 1; }}};
}

/// Those that act no earlier than the step in whose middle the touch lies nearest.
inline std::vector<Law> late_laws()
{
  auto laws = immediate_laws();
  laws.pop_back();
  return laws;
}

/// All; a speculative contact is slowed down in one step and rebounds in the next.
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
          {"speculative", [](World& w) { w.horizon = w.forecast = 0.5; }},
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
