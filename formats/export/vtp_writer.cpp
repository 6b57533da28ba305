// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/core/species.hpp"
#include "formats/export/output_file.hpp"
#include "formats/export/run_writers.hpp"
#include "formats/export/view_cell.hpp"
#include "formats/export/vtk.hpp"

#include <fmt/format.h>

#include <vector>

namespace grseg {
namespace {

std::vector<float> single(const std::vector<double>& values)
{
  std::vector<float> out;
  out.reserve(values.size());
  for (const double value : values) out.push_back(static_cast<float>(value));
  return out;
}

void append(std::vector<float>& out, const Vec3& v)
{
  for (const double component : v) out.push_back(static_cast<float>(component));
}

std::vector<float> single(const std::vector<Vec3>& vectors)
{
  std::vector<float> out;
  out.reserve(3 * vectors.size());
  for (const auto& v : vectors) append(out, v);
  return out;
}

template <int D>
std::vector<float> padded(const std::vector<Vector<D>>& vectors)
{
  return single(all_in_space<D>(vectors));
}

/// Entries of `all`, which has one per grain, for the grains that are present in the frame.
template <int D, class T>
std::vector<T> of_present(const Frame<D>& frame, std::vector<T> all)
{
  std::size_t next = 0;
  for (std::size_t g = 0; g < all.size(); ++g)
    if (is_present(frame, g)) all[next++] = all[g];
  all.resize(next);
  return all;
}

class VtpWriter : public RunWriter {
 public:
  VtpWriter(const TrajectoryReader& run, const std::string& folder, bool overwrite)
      : run_(run), folder_(folder, "grains.pvd", overwrite, {run.path()})
  {
    folder_.add_folder("grains");
    folder_.add_folder("contacts");
  }

  void add(const Frame<2>& frame) override { add_frame(frame); }
  void add(const Frame<3>& frame) override { add_frame(frame); }

  void publish() override
  {
    folder_.add_file("contacts.pvd", vtk_collection(contacts_list_));
    folder_.add_file("grains.pvd", vtk_collection(grains_list_));
    folder_.publish();
  }

 private:
  template <int D>
  void add_frame(const Frame<D>& frame)
  {
    const auto add = [&](const char* what, const std::string& text, std::string& list) {
      const auto name = fmt::format("{}/{:06}.vtp", what, frames_);
      folder_.add_file(name, text);
      list += vtk_entry(frame.time, name);
    };
    add("grains", grains_text(frame), grains_list_);
    add("contacts", contacts_text(frame), contacts_list_);
    ++frames_;
  }

  template <int D>
  std::string grains_text(const Frame<D>& frame) const
  {
    const auto& grains = run_.grains();
    const auto own = [&](const auto& all) { return of_present(frame, all); };
    const auto radius = own(grains.radius);
    auto diameter = radius;
    for (auto& value : diameter) value *= 2;

    PolyData data(PolyData::Cells::vertices, padded<D>(own(frame.position)), frame.time);
    data.point_array("diameter", single(diameter));
    data.point_array("radius", single(radius));
    data.point_array("mass", single(own(grains.mass)));
    data.point_array("species", own(species_numbers(grains.species, run_.species().size())));
    data.point_array("id", own(grains.id));
    data.point_array("velocity", padded<D>(own(frame.velocity)), 3);
    data.point_array("angular_velocity", single(own(frame.angular_velocity)), D == 2 ? 1 : 3);
    if (run_.has_force()) data.point_array("force", padded<D>(own(frame.force)), 3);
    return data.text();
  }

  template <int D>
  std::string contacts_text(const Frame<D>& frame) const
  {
    const auto& grains = run_.grains();
    const auto& contacts = frame.contacts;
    std::vector<float> points, normal_at_points, normal, tangential;
    std::vector<std::int32_t> id_i, id_j, type, species_i, species_j;
    const auto mobile = run_.species().size();
    const auto species = species_numbers(grains.species, mobile);
    for (std::size_t c = 0; c < contacts.size(); ++c) {
      const auto i = static_cast<std::size_t>(contacts.i[c]);
      const auto j = contacts.j[c];
      append(points, in_space<D>(frame.position[i]));
      append(points, in_space<D>(frame.position[i] - contacts.branch[c]));
      const auto parts = contact_parts(contacts, c);
      normal.push_back(static_cast<float>(parts.normal));
      normal_at_points.insert(normal_at_points.end(), 2, normal.back());
      tangential.push_back(static_cast<float>(parts.tangential));
      id_i.push_back(grains.id[i]);
      id_j.push_back(j < 0 ? j : grains.id[static_cast<std::size_t>(j)]);
      if (mobile == 2) {
        type.push_back(static_cast<std::int32_t>(pair_type(grains, frame, c)));
        continue;
      }
      species_i.push_back(species[i]);
      species_j.push_back(j < 0 ? static_cast<std::int32_t>(mobile)
                                : species[static_cast<std::size_t>(j)]);
    }
    PolyData data(PolyData::Cells::lines, points, frame.time);
    data.point_array("normal_force", normal_at_points);
    data.cell_array("normal_force", normal);
    data.cell_array("tangential_force", tangential);
    data.cell_array("force", padded<D>(contacts.force), 3);
    data.cell_array("gap", single(contacts.gap));
    if (mobile == 2) {
      data.cell_array("pair_type", type);
    } else {
      data.cell_array("species_i", species_i);
      data.cell_array("species_j", species_j);
    }
    data.cell_array("i", id_i);
    data.cell_array("j", id_j);
    return data.text();
  }

  const TrajectoryReader& run_;
  OutputFolder folder_;
  std::size_t frames_ = 0;
  std::string grains_list_, contacts_list_;
};

}  // namespace

std::unique_ptr<RunWriter> vtp_writer(const TrajectoryReader& run, const ViewCell&,
                                      const std::string& path, bool overwrite)
{
  return std::make_unique<VtpWriter>(run, path, overwrite);
}

}  // namespace grseg
