// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/core/species.hpp"

namespace grseg {

SpeciesList two_sizes(double small_diameter, double large_diameter)
{
  return {{"small", small_diameter}, {"large", large_diameter}};
}

std::vector<std::int32_t> species_numbers(const std::vector<Species>& species, std::size_t mobile)
{
  std::vector<std::int32_t> numbers;
  numbers.reserve(species.size());
  for (const auto kind : species)
    numbers.push_back(kind == Species::boundary ? static_cast<std::int32_t>(mobile)
                                                : static_cast<std::int32_t>(kind));
  return numbers;
}

}  // namespace grseg
