// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/export/output_file.hpp"
#include "formats/export/run_writers.hpp"
#include "formats/export/view_cell.hpp"

#include <fmt/format.h>

#include <iterator>

namespace grseg {
namespace {

std::string keys_of(const ViewCell& cell, bool has_force)
{
  return fmt::format(R"(Lattice="{} 0 0 0 {} 0 0 0 {}" Origin="{} {} {}" pbc="{} F {}" )"
                     "Properties=id:I:1:type:I:1:pos:R:3:velo:R:3:radius:R:1:mass:R:1:omega:R:3:"
                     "masses:R:1:momenta:R:3{}",
                     cell.length(0), cell.length(1), cell.length(2), cell.low[0], cell.low[1],
                     cell.low[2], cell.periodic_x ? 'T' : 'F', cell.periodic_z ? 'T' : 'F',
                     has_force ? ":forces:R:3" : "");
}

class ExtxyzWriter : public RunWriter {
 public:
  ExtxyzWriter(const TrajectoryReader& run, const ViewCell& cell, const std::string& path,
               bool overwrite)
      : grains_(run.grains()),
        species_(species_numbers(run.grains().species, run.species().size())),
        has_force_(run.has_force()),
        keys_(keys_of(cell, run.has_force())),
        file_(path, overwrite, {run.path()})
  {
  }

  void add(const Frame<2>& frame) override { add_frame(frame); }
  void add(const Frame<3>& frame) override { add_frame(frame); }
  void publish() override { file_.publish(); }

 private:
  template <int D>
  void add_frame(const Frame<D>& frame)
  {
    fmt::memory_buffer text;
    const auto end = std::back_inserter(text);
    fmt::format_to(end, "{}\n{} Time={}\n", number_present(frame), keys_, frame.time);
    for (std::size_t g = 0; g < grains_.size(); ++g) {
      if (!is_present(frame, g)) continue;
      const Vec3 x = in_space<D>(frame.position[g]), v = in_space<D>(frame.velocity[g]);
      const Vec3 spin = spin_in_space(frame.angular_velocity[g]);
      const double mass = grains_.mass[g];
      fmt::format_to(end, "{} {}", grains_.id[g], species_[g] + 1);
      const auto add = [&](const Vec3& vector) {
        fmt::format_to(end, " {} {} {}", vector.x(), vector.y(), vector.z());
      };
      add(x);
      add(v);
      fmt::format_to(end, " {} {}", grains_.radius[g], mass);
      add(spin);
      fmt::format_to(end, " {}", mass);
      add(mass * v);
      if (has_force_) add(in_space<D>(frame.force[g]));
      text.push_back('\n');
    }
    file_.write({text.data(), text.size()});
  }

  const Grains& grains_;
  std::vector<std::int32_t> species_;
  bool has_force_;
  std::string keys_;
  OutputFile file_;
};

}  // namespace

std::unique_ptr<RunWriter> extxyz_writer(const TrajectoryReader& run, const ViewCell& cell,
                                         const std::string& path, bool overwrite)
{
  return std::make_unique<ExtxyzWriter>(run, cell, path, overwrite);
}

}  // namespace grseg
