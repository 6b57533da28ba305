// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/cli/words.hpp"

#include <cstddef>
#include <string>

namespace grseg {

/// What an interval is over: the population from which runs are taken to come, and what of it is
/// estimated. A flow is what runs have in common that differ in their seed alone.
enum class Population {
  automatic,     ///< windows of one run, runs of one flow, these flows of several
  windows,       ///< these very runs, had they lasted longer
  runs,          ///< one flow, over all its runs
  flows,         ///< these flows, weighted as they are, over all their runs
  equal_flows,   ///< these flows, each counting the same, over all their runs
  random_flows,  ///< the mean over all flows of which these are a random sample
  compositions,  ///< runs about one function of composition that is common to all flows
};
inline constexpr Choice<Population> populations[] = {
    {"windows", Population::windows, "these runs, had they lasted longer"},
    {"runs", Population::runs, "one flow, over all its runs"},
    {"flows", Population::flows, "these flows, weighted as they are"},
    {"equal-flows", Population::equal_flows, "these flows, each counting the same"},
    {"random-flows", Population::random_flows, "all flows of which these are a random sample"},
    {"compositions", Population::compositions,
     "these compositions, as if B were one function of composition"}};

/// The automatic one of so many runs and flows; the others stand for themselves.
Population resolved(Population over, std::size_t runs, std::size_t flows);

/// The population and what is estimated, as a sentence without its full stop; of so many flows.
std::string estimand_words(Population over, std::size_t flows);

}  // namespace grseg
