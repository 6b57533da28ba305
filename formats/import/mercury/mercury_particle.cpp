// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/import/mercury/mercury_particle.hpp"

#include <fmt/format.h>

#include <cctype>
#include <cmath>

namespace grseg {
namespace {

using Particle = MercuryRestart::Particle;

Vec3 three(const std::vector<double>& numbers, std::size_t first)
{
  return {numbers[first], numbers[first + 1], numbers[first + 2]};
}

Particle named_particle(const MercuryLines& lines)
{
  Particle particle;
  particle.id = lines.whole_number("id");
  particle.species =
      static_cast<std::int32_t>(lines.has("indSpecies") ? lines.whole_number("indSpecies") : -1);
  particle.radius = lines.value("radius");
  particle.inverse_mass = lines.value("invMass");
  particle.position = lines.vector("position");
  particle.velocity = lines.vector("velocity");
  particle.angular_velocity = lines.vector("angularVelocity");
  // Until 2015 the angular velocity had a fourth number, but no word has.
  particle.force = lines.vector("force");
  return particle;
}

/// Whether `rest` is `before` numbers and then n springs of `size` numbers, n being its `at`-th.
bool has_springs(const std::vector<double>& rest, std::size_t at, std::size_t before, double size)
{
  return at < rest.size() && static_cast<double>(rest.size() - before) == rest[at] * size;
}

/// The species in what follows the inertia. Version 3: it, or it, n and n springs of 12 numbers.
/// (The program's own reader looks for it behind the springs, where its files do not have it.)
/// Version 2: n and n springs of 6 numbers, with or without it before them.
std::int32_t species_in(const std::vector<double>& rest, const MercuryRestart& restart,
                        const MercuryLines& lines)
{
  const double spring = restart.positional == 3 ? 12 : 6;
  if (restart.positional == 3 && rest.size() == 1) return static_cast<std::int32_t>(rest[0]);
  if (has_springs(rest, 1, 2, spring)) return static_cast<std::int32_t>(rest[0]);
  if (restart.positional == 2 && has_springs(rest, 0, 1, spring)) {
    if (restart.density.size() == 1) return 0;
    lines.fail(fmt::format("the row of a particle does not say to which of {} species it belongs",
                           restart.density.size()));
  }
  lines.fail(
      fmt::format("the {} numbers behind the inertia of a particle are not its species and springs "
                  "as version {} has them",
                  rest.size(), restart.positional));
}

Particle positional_particle(const MercuryLines& lines, const MercuryRestart& restart,
                             std::size_t row)
{
  std::size_t first = 0;
  while (first < lines.words().size() &&
         std::isalpha(static_cast<unsigned char>(lines.words()[first][0])))
    ++first;  // TSP BP
  const auto numbers = lines.numbers(first);
  if (numbers.size() < 16)
    lines.fail(fmt::format(
        "a particle of {} numbers; restart files of versions 2 and 3 have 16 or more: position, "
        "velocity, radius, angle, angular velocity, inverse mass and inertia, species or springs",
        numbers.size()));
  Particle particle;
  particle.id = static_cast<std::int64_t>(row);
  particle.position = three(numbers, 0);
  particle.velocity = three(numbers, 3);
  particle.radius = numbers[6];
  particle.angular_velocity = three(numbers, 10);
  particle.inverse_mass = numbers[13];
  particle.species = species_in({numbers.begin() + 15, numbers.end()}, restart, lines);
  return particle;
}

}  // namespace

MercuryRestart::Particle read_mercury_particle(const MercuryLines& lines,
                                               const MercuryRestart& restart, std::size_t row)
{
  if (lines.kind() == "Clump" || lines.kind() == "SuperQuadricParticle")
    lines.fail(fmt::format("a {} is not one sphere or disc, as grains are here", lines.kind()));
  auto particle =
      restart.positional > 0 ? positional_particle(lines, restart, row) : named_particle(lines);
  if (particle.species < 0 || particle.species >= std::ssize(restart.density))
    lines.fail("the particle belongs to none of the species above");
  if (!(particle.radius > 0) || particle.inverse_mass < 0)
    lines.fail("the radius of the particle is not positive, or its mass is negative");
  return particle;
}

}  // namespace grseg
