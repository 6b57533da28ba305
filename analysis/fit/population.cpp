// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/fit/population.hpp"

#include <fmt/format.h>

namespace grseg {

Population resolved(Population over, std::size_t runs, std::size_t flows)
{
  if (over == Population::compositions && runs < 2) return Population::windows;
  if (over != Population::automatic) return over;
  if (flows > 1) return Population::flows;
  return runs > 1 ? Population::runs : Population::windows;
}

std::string estimand_words(Population over, std::size_t flows)
{
  const std::string within = "over all their runs; from the scatter of runs within flows";
  const std::string weighted = "weighted as they are (by frames x phi_L phi_S), ";
  switch (over) {
    case Population::automatic:
      break;
    case Population::windows:
      return "B of these very runs, had they lasted longer; from the scatter of windows inside runs: "
             "how other runs would differ is not in it";
    case Population::runs:
      return "B of one flow, over all its runs; from the scatter of runs";
    case Population::flows:
      return fmt::format("B of these {} flows, {}{}", flows, weighted, within);
    case Population::equal_flows:
      return fmt::format("mean B of these {} flows, each counting the same, {}", flows, within);
    case Population::random_flows:
      return fmt::format(
          "mean B of all flows of which these {} are a random sample, each counting the same; "
          "from the scatter between flows. Flows that were chosen are not a sample of that kind",
          flows);
    case Population::compositions:
      return fmt::format(
          "B of these layers' compositions, {}if B is one function of composition "
          "for all runs; from the scatter of runs about its regression on ln(phi_S/phi_L) and phi_L, "
          "which is taken out before runs are drawn: how flows differ beyond it counts as "
          "scatter of runs",
          weighted);
  }
  return {};
}

}  // namespace grseg
