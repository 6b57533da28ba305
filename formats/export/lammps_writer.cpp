// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/core/frame.hpp"
#include "formats/export/output_file.hpp"
#include "formats/export/run_writers.hpp"
#include "formats/export/view_cell.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <numbers>
#include <string>

namespace grseg {
namespace {

/// Path of the contacts' dump for the grains' dump `path`: run.dump.gz -> run.contacts.dump.gz.
std::string contacts_beside(const std::string& path)
{
  const std::string packed = path.ends_with(".gz") ? ".gz" : "";
  std::filesystem::path plain = path.substr(0, path.size() - packed.size());
  const auto ending = plain.extension().string();
  return plain.replace_extension(".contacts" + ending).string() + packed;
}

/// Lines BOX BOUNDS of a dump. For discs the cell is periodic along z, as in LAMMPS itself.
std::string bounds_of(const ViewCell& cell, int dimension)
{
  const auto word = [](bool periodic) { return periodic ? "pp" : "ff"; };
  std::string text = fmt::format("ITEM: BOX BOUNDS {} ff {}\n", word(cell.periodic_x),
                                 word(cell.periodic_z || dimension == 2));
  for (std::size_t axis = 0; axis < 3; ++axis)
    text += fmt::format("{} {}\n", cell.low[axis], cell.high[axis]);
  return text;
}

/// LAMMPS type of a species: 1, 2, ... for mobile species, then the boundary grains.
int type_of(Species species, std::size_t mobile)
{
  return species == Species::boundary ? static_cast<int>(mobile) + 1
                                      : static_cast<int>(species) + 1;
}

/// Options of grseg-import that assign species to types.
std::string species_options_for(const TrajectoryReader& run)
{
  const auto& list = run.species();
  const auto& species = run.grains().species;
  const auto type = [&](Species kind) -> std::string {
    const bool there = std::find(species.begin(), species.end(), kind) != species.end();
    return there ? std::to_string(type_of(kind, list.size())) : "none";
  };
  if (list.size() == 2 && list[0].name == "small" && list[1].name == "large")
    return fmt::format(
        "--small {} --large {} --boundary {} --small-diameter {} --large-diameter {}",
        type(Species::small), type(Species::large), type(Species::boundary), run.small_diameter(),
        run.large_diameter());
  std::string options;
  for (std::size_t k = 0; k < list.size(); ++k)
    options += fmt::format("--species {}={}:{} ", list[k].name, k + 1, list[k].diameter);
  return options + fmt::format("--boundary {}", type(Species::boundary));
}

/// Options of grseg-import for the facts that dumps cannot store.
std::string import_options_for(const TrajectoryReader& run)
{
  const Vec3 gravity =
      with_dimension(run.dimension(), [&](auto d) { return in_space<d>(run.gravity<d>().start); });
  const bool discs = run.dimension() == 2 && run.parameters().text("import_grains") != "spheres";
  const char* grains = discs                  ? "discs"
                       : run.dimension() == 2 ? "spheres"
                                              : "spheres --dimension 3 --axes xy";
  // Without a slope grseg-import lets x point downhill.
  const auto slope = gravity.x() < 0
                         ? fmt::format(" --slope {:.6g}", std::atan2(gravity.x(), -gravity.y()) *
                                                              180 / std::numbers::pi)
                         : "";
  return fmt::format("--units si --step {} --gravity {},{},{}{} --grains-are {} --origin 0 {}{}",
                     run.step(), gravity.x(), gravity.y(), gravity.z(), slope, grains,
                     species_options_for(run), run.stores_float32() ? " --float32" : "");
}

template <int D>
void add_vector(fmt::memory_buffer& text, const Eigen::Matrix<double, D, 1>& v)
{
  for (const double component : v) fmt::format_to(std::back_inserter(text), " {}", component);
}

class LammpsWriter : public RunWriter {
 public:
  LammpsWriter(const TrajectoryReader& run, const ViewCell& cell, const std::string& path,
               bool overwrite)
      : run_(run),
        bounds_(bounds_of(cell, run.dimension())),
        import_options_(import_options_for(run)),
        grains_path_(path),
        contacts_path_(contacts_beside(path)),
        grains_file_(grains_path_, overwrite, {run.path()}),
        contacts_file_(contacts_path_, overwrite, {run.path()})
  {
    grains_file_.write("ITEM: UNITS\nsi\n");
    contacts_file_.write("ITEM: UNITS\nsi\n");
  }

  void add(const Frame<2>& frame) override { add_frame(frame); }
  void add(const Frame<3>& frame) override { add_frame(frame); }

  void publish() override
  {
    contacts_file_.close();
    grains_file_.close();
    contacts_file_.publish();
    grains_file_.publish();
  }

  std::string import_command() const override
  {
    return fmt::format(
        "grseg-import --format lammps --grains {} --contacts {} --columns "
        "i=batom1,j=batom2,fx=forcex,fy=forcey{},bx=branchx,by=branchy{},overlap=overlap{} {} -o "
        "again.h5",
        grains_path_, contacts_path_, run_.dimension() == 3 ? ",fz=forcez" : "",
        run_.dimension() == 3 ? ",bz=branchz" : "", has_walls_ ? ",wall=wall" : "",
        import_options_);
  }

 private:
  template <int D>
  void add_frame(const Frame<D>& frame)
  {
    add_grains(frame);
    add_contacts(frame);
  }

  template <int D>
  std::string head(const Frame<D>& frame, const char* label, std::size_t rows) const
  {
    return fmt::format("ITEM: TIME\n{}\nITEM: TIMESTEP\n{}\nITEM: NUMBER OF {}\n{}\n{}ITEM: {} ",
                       frame.time, frame.step, label, rows, bounds_, label);
  }

  template <int D>
  void add_grains(const Frame<D>& frame)
  {
    const auto& grains = run_.grains();
    const bool has_force = run_.has_force(), has_images = run_.has_images();
    fmt::memory_buffer text;
    const auto end = std::back_inserter(text);
    fmt::format_to(end, "{}id type mass radius x y z{} vx vy vz {}omegaz{}\n",
                   head(frame, "ATOMS", number_present(frame)), has_images ? " ix iy iz" : "",
                   D == 3 ? "omegax omegay " : "", has_force ? " fx fy fz" : "");
    for (std::size_t g = 0; g < grains.size(); ++g) {
      if (!is_present(frame, g)) continue;
      const auto& image = frame.image[g];
      fmt::format_to(end, "{} {} {} {}", grains.id[g],
                     type_of(grains.species[g], run_.species().size()), grains.mass[g],
                     grains.radius[g]);
      add_vector(text, in_space<D>(frame.position[g]));
      if (has_images)
        fmt::format_to(end, " {} {} {}", image[0], image[1], D == 3 ? image[D - 1] : 0);
      add_vector(text, in_space<D>(frame.velocity[g]));
      if constexpr (D == 2)
        fmt::format_to(end, " {}", frame.angular_velocity[g]);
      else
        add_vector(text, frame.angular_velocity[g]);
      if (has_force) add_vector(text, in_space<D>(frame.force[g]));
      text.push_back('\n');
    }
    grains_file_.write({text.data(), text.size()});
  }

  template <int D>
  void add_contacts(const Frame<D>& frame)
  {
    const auto& contacts = frame.contacts;
    const auto& id = run_.grains().id;
    fmt::memory_buffer text;
    const auto end = std::back_inserter(text);
    fmt::format_to(end,
                   "{}index batom1 batom2 dist fx fy fz p1 p2 p3 forcex forcey {}branchx branchy {}"
                   "overlap wall\n",
                   head(frame, "ENTRIES", contacts.size()), D == 3 ? "forcez " : "",
                   D == 3 ? "branchz " : "");
    for (std::size_t c = 0; c < contacts.size(); ++c) {
      const auto i = static_cast<std::size_t>(contacts.i[c]);
      const auto j = contacts.j[c];
      has_walls_ = has_walls_ || j < 0;
      const auto parts = contact_parts(contacts, c);
      const auto &force = contacts.force[c], &branch = contacts.branch[c];
      const Vector<D> normal = parts.normal * parts.n, tangential = force - normal;
      fmt::format_to(end, "{} {} {} {}", c + 1, id[i],
                     j < 0 ? id[i] : id[static_cast<std::size_t>(j)], branch.norm());
      add_vector(text, in_space<D>(normal));
      add_vector(text, in_space<D>(tangential));
      add_vector(text, force);
      add_vector(text, branch);
      fmt::format_to(end, " {} {}\n", -contacts.gap[c], j < 0 ? -j - 1 : -1);
    }
    contacts_file_.write({text.data(), text.size()});
  }

  const TrajectoryReader& run_;
  std::string bounds_, import_options_, grains_path_, contacts_path_;
  bool has_walls_ = false;
  OutputFile grains_file_, contacts_file_;
};

}  // namespace

std::unique_ptr<RunWriter> lammps_writer(const TrajectoryReader& run, const ViewCell& cell,
                                         const std::string& path, bool overwrite)
{
  return std::make_unique<LammpsWriter>(run, cell, path, overwrite);
}

}  // namespace grseg
