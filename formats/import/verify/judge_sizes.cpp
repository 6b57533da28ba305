// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/import/verify/judge.hpp"

#include <fmt/format.h>

namespace grseg {
namespace {

/// By how much a nominal diameter may lie outside those of the grains.
constexpr double largest_factor = 1.5;

std::string named(const SpeciesSizes& species)
{
  return species.types.empty() ? species.name
                               : fmt::format("{} (types {})", species.name, species.types);
}

Finding failed(const std::string& sentence, double measure)
{
  return {"sizes", Verdict::failed, sentence, measure};
}

std::string exchange(const SpeciesSizes& lower, const SpeciesSizes& upper)
{
  if (lower.types.empty() || upper.types.empty()) return "exchange them";
  return fmt::format("exchange them, --small {} --large {}", upper.types, lower.types);
}

}  // namespace

Finding judge_sizes(const CheckContext& context)
{
  const auto& all = context.species;
  const double length = context.units.length;
  for (const auto& species : all) {
    const double factor =
        std::max(species.smallest / species.nominal, species.nominal / species.largest);
    if (species.nominal > 0 && factor > largest_factor)
      return failed(
          fmt::format("the nominal diameter of {}, {:.4g}, is far from those of its grains, {:.4g} "
                      "to {:.4g}: is it that of another species, or in other units?",
                      named(species), species.nominal / length, species.smallest / length,
                      species.largest / length),
          factor - 1);
  }
  for (std::size_t k = 0; k + 1 < all.size(); ++k)
    if (!(all[k].mean < all[k + 1].mean))
      return failed(fmt::format("the mean diameter of {} is {:.4g}, and that of {} is {:.4g}: {}",
                                named(all[k]), all[k].mean / length, named(all[k + 1]),
                                all[k + 1].mean / length, exchange(all[k], all[k + 1])),
                    all[k].mean / all[k + 1].mean - 1);
  for (std::size_t k = 0; k + 1 < all.size(); ++k)
    if (all[k].nominal > all[k + 1].nominal)
      return failed(fmt::format("the nominal diameter of {} is {:.4g}, and that of {} is {:.4g}: "
                                "exchange the two diameters",
                                named(all[k]), all[k].nominal / length, named(all[k + 1]),
                                all[k + 1].nominal / length),
                    all[k].nominal / all[k + 1].nominal - 1);
  std::string sentence = "mean diameters are";
  for (const auto& species : all)
    sentence += fmt::format("{} {:.4g} ({})", &species == &all.front() ? "" : ",",
                            species.mean / length, species.name);
  return {"sizes", Verdict::passed, sentence, 0};
}

}  // namespace grseg
