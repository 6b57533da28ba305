// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/import/mercury/mercury_restart.hpp"

#include "formats/import/common/text_source.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>

namespace grseg {
namespace {

/// Lines as words and values.
class Lines {
 public:
  explicit Lines(const std::string& path) : source_({path}) {}

  bool next()
  {
    if (!source_.next()) return false;
    words_ = words_of(source_.line());
    return true;
  }
  void need_next(const char* what)
  {
    if (!next()) fail(fmt::format("the file ends in its {}; copy it again", what));
  }
  bool has(std::string_view key) const { return place_of(key) < words_.size(); }
  /// The `place`-th value behind a word of the line.
  double value(std::string_view key, std::size_t place = 0) const
  {
    const auto at = place_of(key) + 1 + place;
    double number = 0;
    if (at >= words_.size()) fail(fmt::format("'{}' with its value is missing", key));
    const auto word = words_[at];
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
    if (error != std::errc() || end != word.data() + word.size() || !std::isfinite(number))
      fail(fmt::format("{} after '{}' is not a finite number", in_quotes(word), key));
    return number;
  }
  Vec3 vector(std::string_view key) const { return {value(key), value(key, 1), value(key, 2)}; }
  /// Where the line is "key count".
  std::optional<std::size_t> count(std::string_view key) const
  {
    if (words_.empty() || words_[0] != key) return std::nullopt;
    const double number = value(key);
    if (number < 0 || number > 1e9 || std::trunc(number) != number)
      fail(fmt::format("{} is not a number of {}", in_quotes(source_.line()), key));
    return static_cast<std::size_t>(number);
  }
  std::string_view kind() const { return words_.empty() ? std::string_view() : words_[0]; }
  [[noreturn]] void fail(const std::string& why) const
  {
    throw FormatError(fmt::format("{}: {}", source_.place(), why));
  }

 private:
  std::size_t place_of(std::string_view key) const
  {
    std::size_t at = 0;
    while (at < words_.size() && words_[at] != key) ++at;
    return at;
  }
  TextSource source_;
  std::vector<std::string_view> words_;
};

void read_boundary(const Lines& lines, MercuryRestart& restart)
{
  if (lines.kind().find("Periodic") == std::string_view::npos) return;
  const Vec3 normal = lines.has("normal") ? lines.vector("normal") : Vec3(NAN, NAN, NAN);
  for (int axis = 0; axis < 3; ++axis) {
    if (!(std::abs(normal[axis]) > 1 - 1e-12)) continue;
    const double left = normal[axis] * lines.value("distanceLeft");
    const double right = normal[axis] * lines.value("distanceRight");
    restart.periodic[static_cast<std::size_t>(axis)] = true;
    restart.low[axis] = std::min(left, right);
    restart.high[axis] = std::max(left, right);
    return;
  }
  lines.fail(fmt::format("{} is periodic along none of the axes, which is not imported",
                         in_quotes(lines.kind())));
}

MercuryRestart::Particle read_particle(const Lines& lines, const MercuryRestart& restart)
{
  MercuryRestart::Particle particle;
  const double species = lines.has("indSpecies") ? lines.value("indSpecies") : NAN;
  if (!(species >= 0 && species < static_cast<double>(restart.density.size())))
    lines.fail(
        "the particle belongs to none of the species above; was the file written by an old "
        "version?");
  particle.species = static_cast<std::int32_t>(species);
  particle.radius = lines.value("radius");
  particle.inverse_mass = lines.value("invMass");
  if (!(particle.radius > 0) || particle.inverse_mass < 0)
    lines.fail("the radius of the particle is not positive, or its mass is negative");
  return particle;
}

}  // namespace

MercuryRestart read_mercury_restart(const std::string& path)
{
  MercuryRestart restart;
  Lines lines(path);
  bool has_step = false, has_particles = false;
  while (!has_particles && lines.next()) {
    if (lines.has("timeStep")) {
      restart.step = lines.value("timeStep");
      has_step = true;
    }
    if (lines.has("particleDimensions"))
      restart.particle_dimensions = static_cast<int>(lines.value("particleDimensions"));
    if (lines.has("gravity")) restart.gravity = lines.vector("gravity");
    if (const auto species = lines.count("Species")) {
      for (std::size_t k = 0; k < *species; ++k) {
        lines.need_next("species");
        restart.density.push_back(lines.value("density"));
      }
    } else if (const auto boundaries = lines.count("Boundaries")) {
      for (std::size_t k = 0; k < *boundaries; ++k) {
        lines.need_next("boundaries");
        read_boundary(lines, restart);
      }
    } else if (const auto particles = lines.count("Particles")) {
      for (std::size_t k = 0; k < *particles; ++k) {
        lines.need_next("particles");
        restart.particles.push_back(read_particle(lines, restart));
      }
      has_particles = true;
    }
  }
  if (!has_step || !has_particles)
    lines.fail("is not a .restart of MercuryDPM: 'timeStep' and 'Particles' are missing");
  return restart;
}

}  // namespace grseg
