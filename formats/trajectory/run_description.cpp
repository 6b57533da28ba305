// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/trajectory/run_description.hpp"

#include "formats/trajectory/digest.hpp"

#include <algorithm>

namespace grseg {
namespace {

/// Adds the parameters that are known only at the end, or else all others, in alphabetical order,
/// numbers before texts. `complete` is skipped, because it only repeats that there is a seal.
void add_parameters(Digester& digester, const Parameters& parameters, bool known_at_end)
{
  const auto add = [&](const auto& all) {
    for (const auto& [name, value] : all) {
      if (name == "complete" || is_known_at_end(name) != known_at_end) continue;
      digester.add(name);
      digester.add(value);
    }
  };
  add(parameters.numbers);
  add(parameters.texts);
}

void add_grains(Digester& digester, const Grains& grains, std::size_t mobile_species)
{
  digester.add(grains.id);
  digester.add(species_numbers(grains.species, mobile_species));
  digester.add(grains.radius);
  digester.add(grains.mass);
  digester.add(grains.fixed);
}

}  // namespace

bool is_known_at_end(const std::string& parameter)
{
  return parameter == "complete" || parameter.starts_with("summary_");
}

std::uint64_t static_digest(const RunDescription& run)
{
  Digester digester;
  digester.add(run.box.length_x);
  digester.add(run.box.length_y);
  digester.add(run.box.periodic_x);
  if (run.box.dimension == 3) {
    digester.add(run.box.length_z);
    digester.add(run.box.periodic_z);
  }
  const auto species = species_of(run);
  add_grains(digester, run.grains, species.size());
  const auto add_species = [&](const std::string& name, double diameter, bool mobile) {
    digester.add(name);
    digester.add(diameter);
    digester.add(mobile);
  };
  for (const auto& [name, diameter] : species) add_species(name, diameter, true);
  add_species(name_of_boundary, 0, false);
  digester.add(run.has_force);
  if (run.grains_come_and_go) digester.add(run.grains_come_and_go);
  auto observables = run.observables;
  std::sort(observables.begin(), observables.end(),
            [](const Observable& a, const Observable& b) { return a.name < b.name; });
  for (const auto& [name, unit] : observables) {
    digester.add(name);
    digester.add(unit);
  }
  add_parameters(digester, run.parameters, false);
  return digester.digest();
}

Seal make_seal(std::uint64_t frames, std::uint64_t contacts, std::uint64_t chain,
               std::uint64_t static_digest, const Parameters& parameters)
{
  Digester digester;
  for (const auto number : {frames, contacts, chain, static_digest}) digester.add(number);
  add_parameters(digester, parameters, true);
  return {frames, contacts, chain, digester.digest()};
}

}  // namespace grseg
