// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/import/mercury/mercury_restart.hpp"

#include "formats/import/mercury/mercury_boundary.hpp"
#include "formats/import/mercury/mercury_lines.hpp"
#include "formats/import/mercury/mercury_particle.hpp"

#include <fmt/format.h>

#include <numbers>

namespace grseg {
namespace {

/// The first line: the version.
void read_version(const MercuryLines& lines, const std::string& path, MercuryRestart& restart)
{
  const auto& words = lines.words();
  const auto version = words.size() > 1 ? words[1] : std::string_view();
  if (words.empty() || (words[0] != "MercuryDPM" && words[0] != "restart_version"))
    throw FormatError(fmt::format(
        "{} is not a .restart of MercuryDPM: it does not begin with 'MercuryDPM 1.0' or "
        "'restart_version'. Files older than that name nothing; give --step, --gravity and "
        "--density instead",
        path));
  if (words[0] == "MercuryDPM") return;  // then the version of the program, or "x.x"
  if (version == "2" || version == "3")
    restart.positional = version == "2" ? 2 : 3;
  else if (version != "1.0")
    lines.fail(
        fmt::format("version {} of .restart is not known; 1.0, 2 and 3 are", in_quotes(version)));
}

/// A line above the species.
void read_of_run(const MercuryLines& lines, MercuryRestart& restart)
{
  if (lines.kind() == "name") return;
  for (const char* key : {"timeStep", "dt"})
    if (lines.has(key)) restart.step = lines.value(key);
  for (const char* key : {"time", "t"})
    if (lines.has(key)) restart.time = lines.value(key);
  if (lines.has("particleDimensions"))
    restart.particle_dimensions = static_cast<int>(lines.value("particleDimensions"));
  if (lines.has("gravity")) restart.gravity = lines.vector("gravity");
  constexpr std::pair<const char*, const char*> ends[][3] = {
      {{"xMin", "xMax"}, {"yMin", "yMax"}, {"zMin", "zMax"}},
      {{"xmin", "xmax"}, {"ymin", "ymax"}, {"zmin", "zmax"}}};
  for (const auto& names : ends)
    for (int axis = 0; axis < 3; ++axis) {
      const auto& [low, high] = names[axis];
      if (!lines.has(low)) continue;
      restart.domain_low[axis] = lines.value(low);
      restart.domain_high[axis] = lines.value(high);
    }
  if (lines.has("numberOfProcessors") && lines.value("numberOfProcessors") > 1)
    lines.fail(
        "the file holds the part of one of several processors; combine the parts with "
        "CombineParallelRestartFiles.py of MercuryDPM's Tools");
}

/// Of the species that are mentioned in turn with their mixtures with those before.
bool is_mixture(const MercuryLines& lines)
{
  return lines.kind().find("Mixed") != std::string_view::npos || lines.has("(mixed)");
}

void read_species(MercuryLines& lines, MercuryRestart& restart)
{
  while (is_mixture(lines)) lines.need_next("in its species");
  restart.density.push_back(lines.value(lines.has("rho") ? "rho" : "density"));
  if (lines.has("dim_particle"))
    restart.particle_dimensions = static_cast<int>(lines.value("dim_particle"));
}

void read_wall(const MercuryLines& lines, MercuryRestart& restart)
{
  if (!lines.has("id")) return;
  MercuryRestart::Wall wall;
  wall.kind = lines.kind();
  if (lines.has("position")) wall.position = lines.vector("position");
  if (lines.has("normal")) wall.normal = lines.vector("normal");
  restart.walls[lines.whole_number("id")] = wall;
}

void read_interaction(const MercuryLines& lines, MercuryRestart& restart)
{
  MercuryRestart::Interaction interaction;
  interaction.wall = lines.has("particleWallIds");
  const char* ids = interaction.wall ? "particleWallIds" : "particleIds";
  interaction.i = lines.whole_number(ids);
  interaction.j = lines.whole_number(ids, 1);
  interaction.force = lines.vector("force");
  if (lines.has("contactPoint")) interaction.point = lines.vector("contactPoint");
  restart.interactions.push_back(interaction);
}

/// The lines of the block that the line at hand begins, if it begins one.
void read_block(MercuryLines& lines, MercuryRestart& restart)
{
  const auto each = [&](const char* where, std::size_t count, const auto& read) {
    for (std::size_t k = 0; k < count; ++k) {
      lines.need_next(where);
      read(k);
    }
  };
  if (const auto species = lines.count("Species"))
    each("in its species", *species, [&](std::size_t) { read_species(lines, restart); });
  else if (const auto walls = lines.count("Walls"))
    each("in its walls", *walls, [&](std::size_t) { read_wall(lines, restart); });
  else if (const auto old_periods = lines.count("WallsPeriodic"))
    each("in its periods", *old_periods,
         [&](std::size_t) { read_mercury_boundary(lines, restart); });
  else if (const auto boundaries = lines.count("Boundaries"))
    each("in its boundaries", *boundaries,
         [&](std::size_t) { read_mercury_boundary(lines, restart); });
  else if (const auto particles = lines.count("Particles"))
    each("in its particles", *particles, [&](std::size_t k) {
      restart.particles.push_back(read_mercury_particle(lines, restart, k));
    });
  else if (const auto interactions = lines.count("Interactions"))
    each("in its interactions", *interactions,
         [&](std::size_t) { read_interaction(lines, restart); });
}

}  // namespace

bool MercuryRestart::ids_are_rows() const
{
  for (std::size_t g = 0; g < particles.size(); ++g)
    if (particles[g].id != static_cast<std::int64_t>(g)) return false;
  return true;
}

double MercuryRestart::mass_of(const Particle& particle) const
{
  if (particle.inverse_mass > 0) return 1 / particle.inverse_mass;
  const double r = particle.radius;
  const double content = discs() ? std::numbers::pi * r * r : 4 * std::numbers::pi / 3 * r * r * r;
  return density[static_cast<std::size_t>(particle.species)] * content;
}

MercuryRestart read_mercury_restart(const std::string& path, MercuryBlocks blocks)
{
  MercuryRestart restart;
  MercuryLines lines(path);
  lines.next();
  read_version(lines, path, restart);
  const bool to_the_end = blocks == MercuryBlocks::all && restart.positional == 0;
  const std::string_view last = to_the_end ? "Interactions" : "Particles";
  for (bool done = false; !done;) {
    lines.need_next(fmt::format("before its {}", last));
    done = lines.kind() == last;
    if (restart.density.empty()) read_of_run(lines, restart);
    read_block(lines, restart);
  }
  if (!(restart.step > 0))
    throw FormatError(fmt::format("{}: its time step is missing or not positive", path));
  return restart;
}

bool is_mercury_restart(const std::string& path)
{
  MercuryLines lines(path);
  return lines.next() && (lines.kind() == "MercuryDPM" || lines.kind() == "restart_version");
}

}  // namespace grseg
