// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "tests/sim/worlds.hpp"

#include <gtest/gtest.h>

#include <ostream>
#include <string>
#include <vector>

/// Contact laws of the simulator, which set when a pair acts in a step (docs/glossary.md).
/// Expectations of a test with a parameter must be true under each law.
namespace grseg::hard_cases {

struct Law {
  std::string name;
  LawParameters parameters;

  friend void PrintTo(const Law& law, std::ostream* out) { *out << law.name; }
};

/// Parameters without a margin: the margin of the speculative law allows for neighbours, and a few
/// discs have hardly any.
inline LawParameters without_margin(ContactLaw law, double horizon)
{
  return law_parameters(law, horizon, 0, 0, 0);
}

/// Laws under which a pair acts no earlier than in the step whose middle is nearest to the touch;
/// the bounds of the tests are for these laws.
inline std::vector<Law> laws()
{
  return {{"touch", without_margin(ContactLaw::touch, 0)},
          {"centred", without_margin(ContactLaw::centred, 0)}};
}

/// The other laws: predictive contacts act earlier; speculative ones are slowed down in one step
/// and rebound in the next.
inline std::vector<Law> early_laws()
{
  return {{"predictive", without_margin(ContactLaw::predictive, 0)},
          {"speculativeHalfStep", without_margin(ContactLaw::speculative, 0.5)},
          {"speculative", without_margin(ContactLaw::speculative, 0.75)},
          {"speculativeWholeStep", without_margin(ContactLaw::speculative, 1)}};
}

class UnderEveryLaw : public testing::TestWithParam<Law> {
 protected:
  World<2> world_of(const std::vector<worlds::Disc>& discs) const
  {
    auto world = worlds::world_of(discs);
    world.law = GetParam().parameters;
    return world;
  }
};

inline std::string name_of(const testing::TestParamInfo<Law>& law)
{
  return law.param.name;
}

}  // namespace grseg::hard_cases
