// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/core/errors.hpp"
#include "formats/export/run_writers.hpp"
#include "formats/export/view_cell.hpp"
#include "formats/trajectory/h5md.hpp"
#include "formats/trajectory/hdf5.hpp"
#include "formats/trajectory/hdf5_attributes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace grseg {
namespace {

using namespace hdf5;

const std::string group = "/particles/trajectory/";
const std::string position = group + "position";
constexpr hsize_t scalar_chunk = 1024;
constexpr int compression = 1;  // removes the zeros along z

template <std::size_t D>
auto padded(const std::vector<std::array<std::int32_t, D>>& images)
{
  std::vector<std::array<std::int32_t, 3>> out(images.size());
  for (std::size_t g = 0; g < images.size(); ++g)
    std::copy(images[g].begin(), images[g].end(), out[g].begin());
  return out;
}

}  // namespace

struct H5md3dWriter::Impl {
  Impl(const TrajectoryReader& its_run, const ViewCell& cell, const std::string& its_path,
       bool overwrite);

  void create_position();
  Dataset create_element(const std::string& name, const std::string& unit, hid_t type,
                         const std::vector<hsize_t>& shape, hsize_t chunk_rows = 1) const;
  void write_grains() const;

  const TrajectoryReader& run;
  std::string path;
  Output output;
  File file;
  std::array<double, 9> edges;
  Dataset positions, steps, times, box, velocities, forces, images, spins;
  /// Values of all frames of the run, and where those of the frames that are exported go.
  std::vector<std::pair<std::vector<double>, Dataset>> observables;
};

H5md3dWriter::Impl::Impl(const TrajectoryReader& its_run, const ViewCell& cell,
                         const std::string& its_path, bool overwrite)
    : run(its_run),
      path(its_path),
      output(path, overwrite, {run.path()}),
      edges{cell.length(0), 0, 0, 0, cell.length(1), 0, 0, 0, cell.length(2)}
{
  silence();
  file = File(H5Fcreate(output.temporary().c_str(), H5F_ACC_TRUNC, without_time(), H5P_DEFAULT));
  if (!file.valid()) throw RunError(fmt::format("cannot create {}: {}", path, reason_of_failure()));
  h5md::write_root(file);
  const auto word = [](bool periodic) { return periodic ? "periodic" : "none"; };
  h5md::write_box(file, "trajectory", {word(cell.periodic_x), "none", word(cell.periodic_z)});

  const hsize_t n = run.grains().size();
  create_position();
  box = create_element(group + "box/edges", "", H5T_IEEE_F64LE, {3, 3}, scalar_chunk);
  velocities = create_element(group + "velocity", "", H5T_IEEE_F64LE, {n, 3});
  if (run.has_force()) forces = create_element(group + "force", "", H5T_IEEE_F64LE, {n, 3});
  images = create_element(group + "image", "", H5T_STD_I32LE, {n, 3});
  const std::vector<hsize_t> spin_shape =
      run.dimension() == 2 ? std::vector{n} : std::vector{n, hsize_t{3}};
  spins = create_element(group + "angular_velocity", "", H5T_IEEE_F64LE, spin_shape);
  for (const auto& [name, unit] : run.observables())
    observables.emplace_back(
        run.observable(name),
        create_element("/observables/" + name, unit, H5T_IEEE_F64LE, {}, scalar_chunk));
  write_grains();
}

void H5md3dWriter::Impl::create_position()
{
  positions = create_growing(file, position + "/value", H5T_IEEE_F64LE, {run.grains().size(), 3},
                             {1, compression});
  steps = create_growing(file, position + "/step", H5T_STD_I64LE, {}, {scalar_chunk, compression});
  times = create_growing(file, position + "/time", H5T_IEEE_F64LE, {}, {scalar_chunk, compression});
}

Dataset H5md3dWriter::Impl::create_element(const std::string& name, const std::string& unit,
                                           hid_t type, const std::vector<hsize_t>& shape,
                                           hsize_t chunk_rows) const
{
  auto value = create_growing(file, name + "/value", type, shape, {chunk_rows, compression});
  if (!unit.empty()) write_attribute(value, "unit", unit);
  h5md::link_times(file, position, name);
  return value;
}

void H5md3dWriter::Impl::write_grains() const
{
  const auto& grains = run.grains();
  const std::vector<hsize_t> shape{grains.size()};
  write_fixed(file, group + "id", H5T_STD_I32LE, H5T_NATIVE_INT32, shape, grains.id.data());
  const auto species = species_numbers(grains.species, run.species().size());
  write_fixed(file, group + "species", H5T_STD_I32LE, H5T_NATIVE_INT32, shape, species.data());
  write_fixed(file, group + "radius", H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, shape,
              grains.radius.data());
  write_fixed(file, group + "mass", H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, shape, grains.mass.data());
}

H5md3dWriter::H5md3dWriter(const TrajectoryReader& run, const ViewCell& cell,
                           const std::string& path, bool overwrite)
    : impl_(std::make_unique<Impl>(run, cell, path, overwrite))
{
}
H5md3dWriter::~H5md3dWriter() = default;
H5md3dWriter::H5md3dWriter(H5md3dWriter&&) noexcept = default;

template <int D>
void H5md3dWriter::add(const Frame<D>& frame)
{
  const auto& my = *impl_;
  const auto append = [&](const Dataset& dataset, hid_t type, const void* data) {
    append_rows(dataset, type, 1, data, my.path);
  };
  append(my.positions, H5T_NATIVE_DOUBLE, all_in_space<D>(frame.position).data());
  append(my.steps, H5T_NATIVE_INT64, &frame.step);
  append(my.times, H5T_NATIVE_DOUBLE, &frame.time);
  append(my.box, H5T_NATIVE_DOUBLE, my.edges.data());
  append(my.velocities, H5T_NATIVE_DOUBLE, all_in_space<D>(frame.velocity).data());
  if (my.forces.valid()) append(my.forces, H5T_NATIVE_DOUBLE, all_in_space<D>(frame.force).data());
  append(my.images, H5T_NATIVE_INT32, padded(frame.image).data());
  append(my.spins, H5T_NATIVE_DOUBLE, frame.angular_velocity.data());
  const auto& all = my.run.steps();
  const auto index = std::lower_bound(all.begin(), all.end(), frame.step) - all.begin();
  for (const auto& [values, dataset] : my.observables)
    append(dataset, H5T_NATIVE_DOUBLE, &values[static_cast<std::size_t>(index)]);
}

void H5md3dWriter::publish()
{
  auto& my = *impl_;
  // Datasets are closed first: while one is open, closing the file does not write it.
  my.observables.clear();
  for (auto* dataset : {&my.positions, &my.steps, &my.times, &my.box, &my.velocities, &my.forces,
                        &my.images, &my.spins})
    *dataset = Dataset();
  if (close_file(my.file.release()) < 0)
    throw RunError(fmt::format("cannot write {}: {}", my.path, reason_of_failure()));
  my.output.publish();
}

template void H5md3dWriter::add(const Frame<2>&);
template void H5md3dWriter::add(const Frame<3>&);

}  // namespace grseg
