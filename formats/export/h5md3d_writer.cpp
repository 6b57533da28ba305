// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/cli/output.hpp"
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

class H5md3dWriter : public RunWriter {
 public:
  H5md3dWriter(const TrajectoryReader& run, const ViewCell& cell, const std::string& path,
               bool overwrite)
      : run_(run),
        path_(path),
        output_(path, overwrite, {run.path()}),
        edges_{cell.length(0), 0, 0, 0, cell.length(1), 0, 0, 0, cell.length(2)}
  {
    silence();
    const Properties access(H5Pcreate(H5P_FILE_ACCESS));
    H5Pset_file_locking(access, false, true);  // many file systems of clusters have no locks
    file_ = File(H5Fcreate(output_.temporary().c_str(), H5F_ACC_TRUNC, without_time(), access));
    if (!file_.valid())
      throw RunError(fmt::format("cannot create {}: {}", path_, reason_of_failure()));
    h5md::write_root(file_);
    const auto word = [](bool periodic) { return periodic ? "periodic" : "none"; };
    h5md::write_box(file_, "trajectory", {word(cell.periodic_x), "none", word(cell.periodic_z)});

    const hsize_t n = run_.grains().size();
    positions_ =
        create_growing(file_, position + "/value", H5T_IEEE_F64LE, {n, 3}, {1, compression});
    const Storage of_scalars{scalar_chunk, compression};
    steps_ = create_growing(file_, position + "/step", H5T_STD_I64LE, {}, of_scalars);
    times_ = create_growing(file_, position + "/time", H5T_IEEE_F64LE, {}, of_scalars);
    box_ = create_element(group + "box/edges", "", H5T_IEEE_F64LE, {3, 3}, scalar_chunk);
    velocities_ = create_element(group + "velocity", "", H5T_IEEE_F64LE, {n, 3});
    if (run_.has_force()) forces_ = create_element(group + "force", "", H5T_IEEE_F64LE, {n, 3});
    if (run_.has_images()) images_ = create_element(group + "image", "", H5T_STD_I32LE, {n, 3});
    const std::vector<hsize_t> spin_shape =
        run_.dimension() == 2 ? std::vector{n} : std::vector{n, hsize_t{3}};
    spins_ = create_element(group + "angular_velocity", "", H5T_IEEE_F64LE, spin_shape);
    for (const auto& [name, unit] : run_.observables())
      observables_.emplace_back(
          run_.observable(name),
          create_element("/observables/" + name, unit, H5T_IEEE_F64LE, {}, scalar_chunk));
    write_grains();
  }

  void add(const Frame<2>& frame) override { add_frame(frame); }
  void add(const Frame<3>& frame) override { add_frame(frame); }

  void publish() override
  {
    // Datasets are closed first: while one is open, closing the file does not write it.
    observables_.clear();
    for (auto* dataset :
         {&positions_, &steps_, &times_, &box_, &velocities_, &forces_, &images_, &spins_})
      *dataset = Dataset();
    if (close_file(file_.release()) < 0)
      throw RunError(fmt::format("cannot write {}: {}", path_, reason_of_failure()));
    output_.publish();
  }

 private:
  template <int D>
  void add_frame(const Frame<D>& frame)
  {
    const auto append = [&](const Dataset& dataset, hid_t type, const void* data) {
      append_rows(dataset, type, 1, data, path_);
    };
    append(positions_, H5T_NATIVE_DOUBLE, all_in_space<D>(frame.position).data());
    append(steps_, H5T_NATIVE_INT64, &frame.step);
    append(times_, H5T_NATIVE_DOUBLE, &frame.time);
    append(box_, H5T_NATIVE_DOUBLE, edges_.data());
    append(velocities_, H5T_NATIVE_DOUBLE, all_in_space<D>(frame.velocity).data());
    if (forces_.valid()) append(forces_, H5T_NATIVE_DOUBLE, all_in_space<D>(frame.force).data());
    if (images_.valid()) append(images_, H5T_NATIVE_INT32, padded(frame.image).data());
    append(spins_, H5T_NATIVE_DOUBLE, frame.angular_velocity.data());
    const auto& all = run_.steps();
    const auto index = std::lower_bound(all.begin(), all.end(), frame.step) - all.begin();
    for (const auto& [values, dataset] : observables_)
      append(dataset, H5T_NATIVE_DOUBLE, &values[static_cast<std::size_t>(index)]);
  }

  Dataset create_element(const std::string& name, const std::string& unit, hid_t type,
                         const std::vector<hsize_t>& shape, hsize_t chunk_rows = 1) const
  {
    auto value = create_growing(file_, name + "/value", type, shape, {chunk_rows, compression});
    if (!unit.empty()) write_attribute(value, "unit", unit);
    h5md::link_times(file_, position, name);
    return value;
  }

  void write_grains() const
  {
    const auto& grains = run_.grains();
    const auto write = [&](const char* name, hid_t type, const auto& numbers) {
      write_fixed(file_, group + name, type, type, {numbers.size()}, numbers.data());
    };
    write("id", H5T_STD_I32LE, grains.id);
    write("species", H5T_STD_I32LE, species_numbers(grains.species, run_.species().size()));
    write("radius", H5T_IEEE_F64LE, grains.radius);
    write("mass", H5T_IEEE_F64LE, grains.mass);
  }

  const TrajectoryReader& run_;
  std::string path_;
  Output output_;
  File file_;
  std::array<double, 9> edges_;
  Dataset positions_, steps_, times_, box_, velocities_, forces_, images_, spins_;
  /// For each observable: its values in all frames of the run, and the dataset of exported values.
  std::vector<std::pair<std::vector<double>, Dataset>> observables_;
};

}  // namespace

std::unique_ptr<RunWriter> h5md3d_writer(const TrajectoryReader& run, const ViewCell& cell,
                                         const std::string& path, bool overwrite)
{
  return std::make_unique<H5md3dWriter>(run, cell, path, overwrite);
}

}  // namespace grseg
