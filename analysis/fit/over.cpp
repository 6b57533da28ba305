// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/fit/over.hpp"

#include <fmt/format.h>

namespace grseg {

Over resolved(Over over, std::size_t runs, std::size_t mixtures)
{
  if (over == Over::compositions && runs < 2) return Over::windows;
  if (over != Over::automatic) return over;
  if (mixtures > 1) return Over::mixtures;
  return runs > 1 ? Over::runs : Over::windows;
}

std::string estimand_words(Over over, std::size_t mixtures)
{
  const std::string within = "over all their runs; from the scatter of runs within mixtures";
  const std::string weighted =
      "weighted as they are (B_half by frames x grains of the rarer species, B_sums by frames x "
      "phi_L phi_S), ";
  switch (over) {
    case Over::automatic:
      break;
    case Over::windows:
      return "B of these very runs, had they lasted longer; from the scatter of windows inside runs: "
             "how other runs would differ is not in it";
    case Over::runs:
      return "B of one mixture, over all its runs; from the scatter of runs";
    case Over::mixtures:
      return fmt::format("B of these {} mixtures, {}{}", mixtures, weighted, within);
    case Over::equal_mixtures:
      return fmt::format("mean B of these {} mixtures, each counting the same, {}", mixtures,
                         within);
    case Over::random_mixtures:
      return fmt::format(
          "mean B of all mixtures of which these {} are a random sample, each counting the same; "
          "from the scatter between mixtures. Mixtures that were chosen are not a sample of that kind",
          mixtures);
    case Over::compositions:
      return fmt::format(
          "B of these layers' compositions, {}if ln(sigma^S/sigma^L) is one function of composition "
          "for all runs; from the scatter of runs about its regression on ln(phi_S/phi_L) and phi_L, "
          "which is taken out before runs are drawn: how mixtures differ beyond it counts as "
          "scatter of runs",
          weighted);
  }
  return {};
}

}  // namespace grseg
