// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/cli/words.hpp"

#include <cstddef>
#include <string>

namespace grseg {

/// What an interval is over: the population from which runs are taken to come, and what of it is
/// estimated. A mixture is what runs have in common that differ in their seed alone.
enum class Over {
  automatic,        ///< windows of one run, runs of one mixture, these mixtures of several
  windows,          ///< these very runs, had they lasted longer
  runs,             ///< one mixture, over all its runs
  mixtures,         ///< these mixtures, weighted as they are, over all their runs
  equal_mixtures,   ///< these mixtures, each counting the same, over all their runs
  random_mixtures,  ///< the mean over all mixtures of which these are a random sample
  compositions,     ///< runs about one function of composition that is common to all mixtures
};
inline constexpr Choice<Over> overs[] = {
    {"windows", Over::windows, "these runs, had they lasted longer"},
    {"runs", Over::runs, "one mixture, over all its runs"},
    {"mixtures", Over::mixtures, "these mixtures, weighted as they are"},
    {"equal-mixtures", Over::equal_mixtures, "these mixtures, each counting the same"},
    {"random-mixtures", Over::random_mixtures, "all mixtures of which these are a random sample"},
    {"compositions", Over::compositions,
     "these compositions, as if B were one function of composition"}};

/// The automatic one of so many runs and mixtures; the others stand for themselves.
Over resolved(Over over, std::size_t runs, std::size_t mixtures);

/// The population and what is estimated, as a sentence without its full stop; of so many mixtures.
std::string estimand_words(Over over, std::size_t mixtures);

}  // namespace grseg
