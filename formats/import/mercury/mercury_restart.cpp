// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/import/mercury/mercury_restart.hpp"

#include "formats/import/common/text_source.hpp"
#include "formats/import/common/text_values.hpp"

#include <fmt/format.h>

#include <cctype>
#include <cmath>
#include <string_view>

namespace grseg {
namespace {

/// Reads the lines of a .restart of MercuryDPM: words, each followed by its values, or only values.
class MercuryLines {
 public:
  explicit MercuryLines(const std::string& path) : source_({path}) {}

  /// Reads the next line; false at the end of the file.
  bool next()
  {
    if (!source_.next()) return false;
    words_ = words_of(source_.line());
    return true;
  }

  /// Reads the next line. Throws TruncatedArchive if the file ends before or inside it; `where` is
  /// part of the message, such as "in its particles".
  void need_next(const std::string& where)
  {
    if (!next() || !source_.line_is_whole())
      throw TruncatedArchive(
          fmt::format("{}: the file ends {}; copy it again", source_.place(), where));
    if (kind() == "...") fail("the rest of the block is left out; write the complete restart file");
  }

  bool has(std::string_view key) const { return place_of(key) < words_.size(); }
  /// The first word; empty in an empty line.
  std::string_view kind() const { return words_.empty() ? std::string_view() : words_[0]; }
  const std::vector<std::string_view>& words() const { return words_; }

  /// The value number `place`, from 0, behind a word of the line.
  double value(std::string_view key, std::size_t place = 0) const
  {
    const auto at = place_of(key) + 1 + place;
    if (at >= words_.size()) fail(fmt::format("'{}' with its value is missing", key));
    return number(at, key);
  }

  Vec3 vector(std::string_view key) const { return {value(key), value(key, 1), value(key, 2)}; }

  std::int64_t whole_number(std::string_view key, std::size_t place = 0) const
  {
    const double number = value(key, place);
    if (!is_whole(number, 2147483647))
      fail(fmt::format("{:g} after '{}' is not a whole number", number, key));
    return static_cast<std::int64_t>(number);
  }

  /// The count of a line "key count"; empty for other lines.
  std::optional<std::size_t> count(std::string_view key) const
  {
    if (kind() != key) return std::nullopt;
    const double number = value(key);
    if (number < 0 || !is_whole(number, 1e9))
      fail(fmt::format("{} is not the number of {}", in_quotes(source_.line()), key));
    return static_cast<std::size_t>(number);
  }

  /// The words from number `first`, from 0, to the end of the line, as numbers.
  std::vector<double> numbers(std::size_t first) const
  {
    std::vector<double> numbers;
    for (auto k = first; k < words_.size(); ++k)
      numbers.push_back(number(k, k > 0 ? words_[k - 1] : "the beginning of the line"));
    return numbers;
  }

  [[noreturn]] void fail(const std::string& why) const { source_.fail(why); }

 private:
  std::size_t place_of(std::string_view key) const
  {
    std::size_t at = 0;
    while (at < words_.size() && words_[at] != key) ++at;
    return at;
  }

  double number(std::size_t place, std::string_view behind) const
  {
    const auto word = words_[place];
    double number = 0;
    if (!parse_finite(word, number))
      fail(fmt::format("{} after '{}' is not a finite number", in_quotes(word), behind));
    return number;
  }

  TextSource source_;
  std::vector<std::string_view> words_;
};

struct Refused {
  std::string_view part;  // part of the name of the boundary's kind
  const char* why;
};

constexpr Refused refused[] = {
    {"TimeDependentPeriodic", "moves and shifts grains with time"},
    {"LeesEdwards",
     "shears the cell: grains that leave at the top enter at the bottom at another place"},
    {"AngledPeriodic", "rotates grains that leave the cell"},
    {"CircularPeriodic", "rotates grains that leave the cell"},
    {"StressStrainControl", "changes the size of the cell"},
    {"Maser", "is periodic in a part of the cell only, and puts copies of grains into the rest"},
};

/// The two positions of a periodic boundary along its normal, in all versions of the file.
std::array<double, 2> places_of(const MercuryLines& lines)
{
  for (const auto& [left, right] : {std::pair{"distanceLeft", "distanceRight"},
                                    {"position_left", "position_right"},
                                    {"pos_left", "pos_right"}})
    if (lines.has(left)) return {lines.value(left), lines.value(right)};
  lines.fail("'distanceLeft' of the periodic boundary is missing");
}

/// Reads a boundary from the current line; if it is periodic, stores the period in `restart`.
/// Throws FormatError for a kind of periodicity that cannot be imported.
void read_boundary(MercuryLines& lines, MercuryRestart& restart)
{
  const auto kind = lines.kind();
  for (const auto& [part, why] : refused)
    if (kind.find(part) != std::string_view::npos)
      lines.fail(fmt::format("the {} {}; such a cell cannot be imported", kind, why));
  restart.removes_grains |= kind.find("Deletion") != std::string_view::npos;
  if (kind != "PeriodicBoundary" && kind != "normal") return;
  const Vec3 normal = lines.has("normal") ? lines.vector("normal") : Vec3(NAN, NAN, NAN);
  const auto [left, right] = places_of(lines);
  const Vec3 shift = lines.has("shift") ? lines.vector("shift") : Vec3((right - left) * normal);
  for (int axis = 0; axis < 3; ++axis) {
    if (!(std::abs(normal[axis]) > 1 - 1e-12)) continue;
    if (!((shift - (right - left) * normal).norm() < 1e-6 * std::abs(right - left)))
      lines.fail("the periodic boundary shifts grains obliquely, which cannot be imported");
    restart.periodic[static_cast<std::size_t>(axis)] = true;
    restart.low[axis] = std::min(normal[axis] * left, normal[axis] * right);
    restart.high[axis] = std::max(normal[axis] * left, normal[axis] * right);
    return;
  }
  lines.fail(
      "the direction of the periodic boundary is not one of the axes, which cannot be imported");
}

using Particle = MercuryRestart::Particle;

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
  // Until 2015 a fourth number, which is ignored, followed the angular velocity.
  particle.force = lines.vector("force");
  return particle;
}

/// True if `rest` is `before` numbers and n springs of `size` numbers, where n is rest[at].
bool has_springs(const std::vector<double>& rest, std::size_t at, std::size_t before, double size)
{
  return at < rest.size() && static_cast<double>(rest.size() - before) == rest[at] * size;
}

/// The species of a particle, from the numbers behind its inertia. Version 3: the species; or the
/// species, n, and n springs of 12 numbers. (MercuryDPM's own reader expects the species behind the
/// springs, which its files contradict.) Version 2: n and n springs of 6 numbers, with or without
/// the species before.
std::int32_t species_in(const std::vector<double>& rest, const MercuryRestart& restart,
                        const MercuryLines& lines)
{
  const double spring = restart.positional == 3 ? 12 : 6;
  if (restart.positional == 3 && rest.size() == 1) return static_cast<std::int32_t>(rest[0]);
  if (has_springs(rest, 1, 2, spring)) return static_cast<std::int32_t>(rest[0]);
  if (restart.positional == 2 && has_springs(rest, 0, 1, spring)) {
    if (restart.density.size() == 1) return 0;
    lines.fail(fmt::format("the row of a particle does not state to which of {} species it belongs",
                           restart.density.size()));
  }
  lines.fail(
      fmt::format("the {} numbers behind the inertia of a particle are not its species and springs "
                  "as version {} has them",
                  rest.size(), restart.positional));
}

Particle positional_particle(const MercuryLines& lines, const MercuryRestart& restart)
{
  std::size_t first = 0;
  while (first < lines.words().size() &&
         std::isalpha(static_cast<unsigned char>(lines.words()[first][0])))
    ++first;  // skips words such as TSP and BP
  const auto numbers = lines.numbers(first);
  if (numbers.size() < 16)
    lines.fail(fmt::format(
        "a particle of {} numbers; restart files of versions 2 and 3 have 16 or more: position, "
        "velocity, radius, angle, angular velocity, inverse mass and inertia, species or springs",
        numbers.size()));
  Particle particle;
  particle.id = std::ssize(restart.particles);
  particle.position = three(numbers, 0);
  particle.velocity = three(numbers, 3);
  particle.radius = numbers[6];
  particle.angular_velocity = three(numbers, 10);
  particle.inverse_mass = numbers[13];
  particle.species = species_in({numbers.begin() + 15, numbers.end()}, restart, lines);
  return particle;
}

/// Throws FormatError for a class of particles that is not known to be of single spheres.
void require_sphere(const MercuryLines& lines)
{
  constexpr const char* spheres[] = {"BaseParticle",       "SphericalParticle",
                                     "ThermalParticle",    "HeatFluidCoupledParticle",
                                     "LiquidFilmParticle", "LiquidMigrationLSParticle",
                                     "MeltableParticle"};
  const auto kind = lines.kind();
  const bool is_class = kind.find("Particle") != std::string_view::npos || kind == "Clump";
  if (is_class && std::ranges::find(spheres, kind) == std::end(spheres))
    lines.fail(fmt::format(
        "a {} cannot be imported: grains must be single spheres or discs, of the classes {}", kind,
        fmt::join(spheres, ", ")));
}

/// Reads a particle. Throws FormatError if it is not a single sphere or belongs to no species.
void read_particle(MercuryLines& lines, MercuryRestart& restart)
{
  require_sphere(lines);
  auto particle =
      restart.positional > 0 ? positional_particle(lines, restart) : named_particle(lines);
  if (particle.species < 0 || particle.species >= std::ssize(restart.density))
    lines.fail("the particle belongs to none of the species listed above it");
  if (!(particle.radius > 0) || particle.inverse_mass < 0)
    lines.fail("the radius of the particle is not positive, or its mass is negative");
  restart.particles.push_back(particle);
}

/// Reads the first line, which states the version.
void read_version(const MercuryLines& lines, const std::string& path, MercuryRestart& restart)
{
  const auto& words = lines.words();
  const auto version = words.size() > 1 ? words[1] : std::string_view();
  if (words.empty() || (words[0] != "MercuryDPM" && words[0] != "restart_version"))
    throw FormatError(fmt::format(
        "{} is not a .restart of MercuryDPM: it does not begin with 'MercuryDPM 1.0' or "
        "'restart_version'. Older files have no words and cannot be read; "
        "pass --step, --gravity and --density instead",
        path));
  if (words[0] == "MercuryDPM") return;  // the next word is the program's version, or "x.x"
  if (version == "2" || version == "3")
    restart.positional = version == "2" ? 2 : 3;
  else if (version != "1.0")
    lines.fail(fmt::format("version {} of .restart is unknown; known versions are 1.0, 2 and 3",
                           in_quotes(version)));
}

/// Reads a line above the species: time, step, gravity, cell.
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
        "the file is the part of one of several processors; combine the parts with "
        "CombineParallelRestartFiles.py of MercuryDPM's Tools");
}

/// True for a mixed species, which MercuryDPM lists after the two species it joins.
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

void read_wall(MercuryLines& lines, MercuryRestart& restart)
{
  if (!lines.has("id")) return;
  MercuryRestart::Wall wall;
  wall.kind = lines.kind();
  if (lines.has("position")) wall.position = lines.vector("position");
  if (lines.has("normal")) wall.normal = lines.vector("normal");
  restart.walls[lines.whole_number("id")] = wall;
}

void read_interaction(MercuryLines& lines, MercuryRestart& restart)
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

struct Block {
  const char* key;
  void (*read)(MercuryLines& lines, MercuryRestart& restart);  // reads one line of the block
};

constexpr Block blocks[] = {{"Species", read_species},        {"Walls", read_wall},
                            {"WallsPeriodic", read_boundary}, {"Boundaries", read_boundary},
                            {"Particles", read_particle},     {"Interactions", read_interaction}};

/// Reads the lines of a block, if the current line begins one.
void read_block(MercuryLines& lines, MercuryRestart& restart)
{
  for (const auto& [key, read] : blocks) {
    const auto count = lines.count(key);
    if (!count) continue;
    const auto where = fmt::format("in its {}", key);
    for (std::size_t k = 0; k < *count; ++k) {
      lines.need_next(where);
      read(lines, restart);
    }
    return;
  }
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
  const double content =
      discs() ? grain_volume<2>(particle.radius) : grain_volume<3>(particle.radius);
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
