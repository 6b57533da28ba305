// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/import/mercury/mercury_grains.hpp"

#include <fmt/format.h>

#include <cmath>

namespace grseg {
namespace {

constexpr const char* removed =
    "MercuryDPM moves the last row to the place of a grain that it removes, so that rows no longer "
    "name grains; import the .restart files of the moments instead, which have ids "
    "(restartFile.setFileType(FileType::MULTIPLE_FILES); --restart 'run.restart.*')";

void add_period(const MercuryRestart& restart, ArchiveMoment& moment)
{
  for (int axis = 0; axis < 3; ++axis) {
    if (!restart.periodic[static_cast<std::size_t>(axis)]) continue;
    moment.periodic[static_cast<std::size_t>(axis)] = true;
    moment.low[axis] = restart.low[axis];
    moment.high[axis] = restart.high[axis];
  }
}

}  // namespace

MercuryDataGrains::MercuryDataGrains(std::vector<std::string> files, std::string restart_path,
                                     bool info_is_species)
    : data_(std::move(files)),
      restart_path_(std::move(restart_path)),
      info_is_species_(info_is_species)
{
  if (!restart_path_.empty())
    restart_ = read_mercury_restart(restart_path_, MercuryBlocks::up_to_particles);
}

void MercuryDataGrains::require_rows_that_name_grains(const MercuryGrains& block) const
{
  const auto now = block.grains.size(), before = last_radius_.size();
  if (now < before)
    throw FormatError(
        fmt::format("{}: {} grains, but {} before: {}", block.place, now, before, removed));
  for (std::size_t g = 0; g < before; ++g)
    if (std::abs(block.grains.radius[g] - last_radius_[g]) > 1e-5 * last_radius_[g])
      throw FormatError(fmt::format("{}: row {} has the radius {:g}, but {:g} before: {}",
                                    block.place, g, block.grains.radius[g], last_radius_[g],
                                    removed));
  if (!restart_ || restart_->ids_are_rows()) return;
  if (restart_->removes_grains || now != restart_->particles.size() ||
      (before > 0 && now != before))
    throw FormatError(fmt::format("{}: grains were removed, as the ids in {} show: {}", block.place,
                                  restart_path_, removed));
}

void MercuryDataGrains::add_restart_facts(const std::string& place, ArchiveGrains& grains) const
{
  if (restart_->particles.size() < grains.size())
    throw FormatError(
        fmt::format("{}: {} grains, but only {} in {}; give the last .restart of the run", place,
                    grains.size(), restart_->particles.size(), restart_path_));
  for (std::size_t g = 0; g < grains.size(); ++g) {
    const auto& particle = restart_->particles[g];
    if (std::abs(particle.radius - grains.radius[g]) > 1e-5 * particle.radius)
      throw FormatError(fmt::format(
          "{}: grain {} has the radius {:g}, but {:g} in {}; are they from the same run?", place, g,
          grains.radius[g], particle.radius, restart_path_));
    grains.fixed.push_back(particle.inverse_mass == 0);
    grains.mass.push_back(restart_->mass_of(particle));
    if (!info_is_species_) grains.type.push_back(particle.species);
  }
}

bool MercuryDataGrains::next(ArchiveMoment& moment)
{
  MercuryGrains block;
  if (!data_.next(block)) return false;
  require_rows_that_name_grains(block);
  last_radius_ = block.grains.radius;
  moment = ArchiveMoment{};
  moment.time = block.time;
  moment.place = block.place;
  moment.low = block.low;
  moment.high = block.high;
  moment.grains = std::move(block.grains);
  if (restart_) {
    add_restart_facts(moment.place, moment.grains);
    add_period(*restart_, moment);
  }
  if (info_is_species_)
    for (const double info : block.info)
      moment.grains.type.push_back(static_cast<std::int32_t>(std::lround(info)));
  return true;
}

MercuryRestartGrains::MercuryRestartGrains(std::vector<std::string> files)
    : files_(std::move(files)), restart_(read_mercury_restart(files_[0], MercuryBlocks::all))
{
}

bool MercuryRestartGrains::next(ArchiveMoment& moment)
{
  if (at_ == files_.size()) return false;
  const Vec3 gravity = restart_.gravity;
  if (at_ > 0) restart_ = read_mercury_restart(files_[at_], MercuryBlocks::all);
  ++at_;
  if (!(restart_.gravity - gravity).isZero(1e-12 * gravity.norm()))
    throw FormatError(
        fmt::format("{}: gravity is ({:g} {:g} {:g}), but ({:g} {:g} {:g}) in the file before; "
                    "import the files of each gravity separately",
                    path(), restart_.gravity.x(), restart_.gravity.y(), restart_.gravity.z(),
                    gravity.x(), gravity.y(), gravity.z()));
  moment = ArchiveMoment{};
  moment.time = restart_.time;
  moment.place = path();
  moment.low = restart_.domain_low;
  moment.high = restart_.domain_high;
  add_period(restart_, moment);
  auto& grains = moment.grains;
  for (const auto& particle : restart_.particles) {
    grains.id.push_back(particle.id);
    grains.type.push_back(particle.species);
    grains.radius.push_back(particle.radius);
    grains.mass.push_back(restart_.mass_of(particle));
    grains.fixed.push_back(particle.inverse_mass == 0);
    grains.position.push_back(particle.position);
    grains.velocity.push_back(particle.velocity);
    grains.angular_velocity.push_back(particle.angular_velocity);
    if (restart_.positional == 0) grains.force.push_back(particle.force);
  }
  return true;
}

}  // namespace grseg
