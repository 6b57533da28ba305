// SPDX-License-Identifier: GPL-3.0-or-later
#include "sim/scene/keys/keys.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace grseg {
namespace {

/// An effect that other programs have, by a part of its name, and the answer to those who ask for it.
struct AbsentEffect {
  const char *part, *answer;
};

constexpr auto no_attraction = "contacts do not attract; they have friction and restitution";
constexpr auto no_springs = "grains are rigid; an impact has restitution, and friction";
constexpr auto only_two =
    "there are two species, small and large (size-ratio, phi-large, density-ratio), each with a range of "
    "sizes (spread); grseg-import makes runs of more species from archives of other programs";
constexpr auto discs_or_spheres = "grains are discs, or spheres (dimension = 3)";
constexpr auto no_fluid = "grains are dry, and nothing but contacts and gravity acts on them";

constexpr AbsentEffect absent_effects[] = {
    {"rolling", "contacts do not resist rolling; they have friction, and grains rotate"},
    {"torsion", "contacts do not resist twisting; they have friction, and grains rotate"},
    {"cohes", no_attraction},
    {"adhes", no_attraction},
    {"attract", no_attraction},
    {"capillar", no_attraction},
    {"liquid", no_attraction},
    {"bond", no_attraction},
    {"species", only_two},
    {"third", only_two},
    {"medium", only_two},
    {"middle", only_two},
    {"dispers", only_two},
    {"distribution", only_two},
    {"stiffness", no_springs},
    {"young", no_springs},
    {"poisson", no_springs},
    {"damping", no_springs},
    {"grain-shape", discs_or_spheres},
    {"superquadric", discs_or_spheres},
    {"clump", discs_or_spheres},
    {"aspect", discs_or_spheres},
    {"fluid", no_fluid},
    {"viscos", no_fluid},
    {"drag", no_fluid},
    {"wall-friction", "all contacts, also of walls, have one coefficient: friction"},
    {"static-friction", "all contacts have one coefficient: friction"},
};

}  // namespace

std::string absent_effect(std::string key)
{
  std::ranges::replace(key, '_', '-');
  for (const auto& [part, answer] : absent_effects)
    if (key.find(part) != std::string::npos)
      return fmt::format("in grseg-sim {}; docs/guide/limits.md names programs with more", answer);
  return "";
}

}  // namespace grseg
