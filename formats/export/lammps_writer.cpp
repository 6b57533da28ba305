// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/export/lammps_writer.hpp"

#include "formats/export/contact_parts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <string>

namespace grseg {
namespace {

/// run.dump.gz -> run.contacts.dump.gz
std::string contacts_beside(const std::string& path)
{
  const std::string packed = path.ends_with(".gz") ? ".gz" : "";
  std::filesystem::path plain = path.substr(0, path.size() - packed.size());
  const auto ending = plain.extension().string();
  return plain.replace_extension(".contacts" + ending).string() + packed;
}

std::string bounds_of(const ViewCell& cell)
{
  std::string text = fmt::format("ITEM: BOX BOUNDS {} ff pp\n", cell.periodic_x ? "pp" : "ff");
  for (std::size_t axis = 0; axis < 3; ++axis)
    text += fmt::format("{} {}\n", cell.low[axis], cell.high[axis]);
  return text;
}

/// Types begin at 1; that of boundary grains is the last one.
int type_of(Species species, std::size_t mobile)
{
  return species == Species::boundary ? static_cast<int>(mobile) + 1
                                      : static_cast<int>(species) + 1;
}

/// Options of grseg-import for what dumps cannot hold.
std::string import_options_for(const TrajectoryReader& run)
{
  const auto& species = run.grains().species;
  const auto type = [&](Species kind) -> std::string {
    const bool there = std::find(species.begin(), species.end(), kind) != species.end();
    return there ? std::to_string(type_of(kind, run.species().size())) : "none";
  };
  const Vec2 gravity = run.gravity<2>().start;
  return fmt::format(
      "--units si --step {} --gravity {},{},0 --grains-are discs --origin 0 --small {} --large {} "
      "--boundary {} --small-diameter {} --large-diameter {}{}",
      run.step(), gravity.x(), gravity.y(), type(Species::small), type(Species::large),
      type(Species::boundary), run.small_diameter(), run.large_diameter(),
      run.stores_float32() ? " --float32" : "");
}

}  // namespace

LammpsWriter::LammpsWriter(const TrajectoryReader& run, const ViewCell& cell,
                           const std::string& path, bool overwrite)
    : run_(run),
      bounds_(bounds_of(cell)),
      import_options_(import_options_for(run)),
      grains_path_(path),
      contacts_path_(contacts_beside(path)),
      grains_file_(grains_path_, overwrite, {run.path()}),
      contacts_file_(contacts_path_, overwrite, {run.path()})
{
  grains_file_.write("ITEM: UNITS\nsi\n");
  contacts_file_.write("ITEM: UNITS\nsi\n");
}

std::string LammpsWriter::head(const Frame<2>& frame, const char* label, std::size_t rows) const
{
  return fmt::format("ITEM: TIME\n{}\nITEM: TIMESTEP\n{}\nITEM: NUMBER OF {}\n{}\n{}ITEM: {} ",
                     frame.time, frame.step, label, rows, bounds_, label);
}

void LammpsWriter::add(const Frame<2>& frame)
{
  add_grains(frame);
  add_contacts(frame);
}

void LammpsWriter::add_grains(const Frame<2>& frame)
{
  const auto& grains = run_.grains();
  const bool has_force = run_.has_force();
  fmt::memory_buffer text;
  const auto end = std::back_inserter(text);
  fmt::format_to(end, "{}id type mass radius x y z ix iy iz vx vy vz omegaz{}\n",
                 head(frame, "ATOMS", grains.size()), has_force ? " fx fy fz" : "");
  for (std::size_t g = 0; g < grains.size(); ++g) {
    const auto &x = frame.position[g], &v = frame.velocity[g];
    fmt::format_to(end, "{} {} {} {} {} {} 0 {} {} 0 {} {} 0 {}", grains.id[g],
                   type_of(grains.species[g], run_.species().size()), grains.mass[g],
                   grains.radius[g], x.x(), x.y(), frame.image[g][0], frame.image[g][1], v.x(),
                   v.y(), frame.angular_velocity[g]);
    if (has_force) fmt::format_to(end, " {} {} 0", frame.force[g].x(), frame.force[g].y());
    text.push_back('\n');
  }
  grains_file_.write({text.data(), text.size()});
}

void LammpsWriter::add_contacts(const Frame<2>& frame)
{
  const auto& contacts = frame.contacts;
  const auto& id = run_.grains().id;
  fmt::memory_buffer text;
  const auto end = std::back_inserter(text);
  fmt::format_to(end,
                 "{}index batom1 batom2 dist fx fy fz p1 p2 p3 forcex forcey branchx branchy "
                 "overlap wall\n",
                 head(frame, "ENTRIES", contacts.size()));
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    const auto i = static_cast<std::size_t>(contacts.i[c]);
    const auto j = contacts.j[c];
    has_walls_ = has_walls_ || j < 0;
    const auto parts = contact_parts(contacts, c);
    const auto &force = contacts.force[c], &branch = contacts.branch[c];
    const Vec2 normal = parts.normal * parts.n, tangential = force - normal;
    fmt::format_to(end, "{} {} {} {} {} {} 0 {} {} 0 {} {} {} {} {} {}\n", c + 1, id[i],
                   j < 0 ? id[i] : id[static_cast<std::size_t>(j)], branch.norm(), normal.x(),
                   normal.y(), tangential.x(), tangential.y(), force.x(), force.y(), branch.x(),
                   branch.y(), -contacts.gap[c], j < 0 ? -j - 1 : -1);
  }
  contacts_file_.write({text.data(), text.size()});
}

void LammpsWriter::publish()
{
  contacts_file_.close();
  grains_file_.close();
  contacts_file_.publish();
  grains_file_.publish();
}

std::string LammpsWriter::import_command() const
{
  return fmt::format(
      "grseg-import --format lammps --grains {} --contacts {} --columns "
      "i=batom1,j=batom2,fx=forcex,fy=forcey,bx=branchx,by=branchy,overlap=overlap{} {} -o "
      "again.h5",
      grains_path_, contacts_path_, has_walls_ ? ",wall=wall" : "", import_options_);
}

}  // namespace grseg
