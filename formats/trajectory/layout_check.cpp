// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/trajectory/layout_check.hpp"

#include "formats/trajectory/hdf5_attributes.hpp"
#include "formats/trajectory/layout.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <set>
#include <string_view>

namespace grseg {
namespace {

using namespace hdf5;

constexpr const char* names_of_numbers[] = {"int32", "int64", "uint8", "uint64", "float64"};

std::string name_of(Number number, bool float32)
{
  if (number == Number::real) return float32 ? "float32" : "float64";
  return names_of_numbers[static_cast<std::size_t>(number)];
}

/// True if both types are equal apart from their byte order.
bool is_like(hid_t type, hid_t wanted)
{
  return H5Tget_class(type) == H5Tget_class(wanted) && H5Tget_size(type) == H5Tget_size(wanted) &&
         H5Tget_sign(type) == H5Tget_sign(wanted);
}

std::vector<hsize_t> dims_of(const Dataset& dataset)
{
  const Space space(H5Dget_space(dataset));
  std::vector<hsize_t> dims(
      static_cast<std::size_t>(std::max(H5Sget_simple_extent_ndims(space), 0)));
  if (!dims.empty()) H5Sget_simple_extent_dims(space, dims.data(), nullptr);
  return dims;
}

class LayoutCheck {
 public:
  explicit LayoutCheck(const TrajectoryReader& run) : run_(run), file_(open_for_reading(run.path()))
  {
  }

  LayoutReport report()
  {
    check_attributes();
    const std::string_view force = row_of(Field::force).path;
    for (const auto& row : layout)
      if (run_.has_force() || row.path != force) check_row(row.path, row);
    for (const char* element : {"velocity", "angular_velocity", "image", "force"})
      if (run_.has_force() || std::string(element) != "force")
        check_times(std::string("/particles/grains/") + element);
    for (const auto& [name, unit] : run_.observables()) {
      check_row("/observables/" + name + "/value", {"", Number::f64, "F", unit.c_str()});
      check_times("/observables/" + name);
    }
    read_all_in("");
    return report_;
  }

 private:
  void add_departure(const std::string& path, const std::string& what)
  {
    report_.departures.push_back({path, what});
  }

  /// Checks the text attribute `name` of `path`. If `wanted` is empty, any non-empty text is right.
  void check_text(const std::string& path, const std::string& name, const std::string& wanted)
  {
    const auto found = read_texts(Object(H5Oopen(file_, path.c_str(), H5P_DEFAULT)), name);
    const bool right =
        found.size() == 1 && (wanted.empty() ? !found[0].empty() : found[0] == wanted);
    if (right) return;
    add_departure(path, wanted.empty() ? fmt::format("has no text `{}`", name)
                                       : fmt::format("should have the {} \"{}\", but has \"{}\"",
                                                     name, wanted, fmt::join(found, "\", \"")));
  }

  void check_attributes()
  {
    check_text("/h5md/author", "name", "");
    check_text("/h5md/creator", "name", "");
    check_text("/h5md/creator", "version", "");
    check_text("/h5md/modules/units", "system", "SI");
    const auto numbers = [&](const char* path, const char* name,
                             const std::vector<double>& wanted) {
      const auto found = numbers_in_attribute(file_, path, name, run_.path());
      if (found != wanted)
        add_departure(path, fmt::format("should have the {} {}, but has {}", name, wanted, found));
    };
    numbers("/h5md", "version", {1, 1});
    numbers("/h5md/modules/units", "version", {1, 0});
    numbers("/h5md/modules/grseg", "version", {1, 0});
    if (run_.grains_come_and_go()) numbers("/particles/grains", "come_and_go", {1});
    numbers("/particles/grains/box", "dimension", {static_cast<double>(run_.dimension())});
  }

  /// Checks type, shape and unit of a dataset. If the run was not closed, the dataset may be
  /// longer, by data written after the last committed frame.
  void check_row(const std::string& path, const LayoutRow& row)
  {
    const Dataset dataset(H5Dopen2(file_, path.c_str(), H5P_DEFAULT));
    if (!dataset.valid()) return add_departure(path, "is missing or not a dataset");
    const bool float32 = run_.stores_float32();
    if (!is_like(Type(H5Dget_type(dataset)), type_of(row.type, float32)))
      add_departure(path, fmt::format("should be of type {}", name_of(row.type, float32)));
    auto found = dims_of(dataset);
    const auto wanted = shape_of(row.shape, {run_.size(), run_.contacts(), run_.grains().size(),
                                             run_.species().size(), run_.dimension()});
    if (!run_.closed() && !found.empty() && found[0] > wanted[0]) found[0] = wanted[0];
    if (found != wanted)
      add_departure(path, fmt::format("should have the shape {}, but has {}", wanted, found));
    if (*row.unit != '\0') check_text(path, "unit", row.unit);
  }

  void check_times(const std::string& element)
  {
    for (const std::string name : {"step", "time"}) {
      const auto own = fmt::format("{}/{}", element, name);
      const auto first = fmt::format("/particles/grains/position/{}", name);
      H5O_info_t a, b;
      if (!exists(file_, own) || H5Oget_info_by_name(file_, own.c_str(), &a, H5P_DEFAULT) < 0 ||
          H5Oget_info_by_name(file_, first.c_str(), &b, H5P_DEFAULT) < 0 || a.addr != b.addr ||
          a.fileno != b.fileno)
        add_departure(own, "is not a hard link to " + first);
    }
  }

  void read_all_in(const std::string& group)
  {
    for (const auto& name : names_in(file_, group.empty() ? "/" : group)) {
      const auto path = fmt::format("{}/{}", group, name);
      H5L_info_t link;
      if (H5Lget_info(file_, path.c_str(), &link, H5P_DEFAULT) < 0 || link.type != H5L_TYPE_HARD) {
        add_departure(path, "is a soft or external link, which readers do not follow");
        continue;
      }
      const Object object(H5Oopen(file_, path.c_str(), H5P_DEFAULT));
      const auto kind = H5Iget_type(object);
      H5O_info_t info;
      if (H5Oget_info(object, &info) >= 0 && !seen_.insert(info.addr).second) continue;
      if (kind == H5I_GROUP) read_all_in(path);
      if (kind == H5I_DATASET) read_whole(path);
      if (kind != H5I_GROUP && kind != H5I_DATASET)
        add_departure(path, "is neither a group nor a dataset");
    }
  }

  /// Adds the number of chunks to the report, and returns the number of rows of a chunk. The number
  /// is computed from the shape, because HDF5's chunk index may be damaged.
  hsize_t count_chunks(const Dataset& dataset, const std::vector<hsize_t>& dims)
  {
    const Properties create(H5Dget_create_plist(dataset));
    if (H5Pget_layout(create) != H5D_CHUNKED) return 1;
    std::vector<hsize_t> chunk(dims.size());
    H5Pget_chunk(create, static_cast<int>(chunk.size()), chunk.data());
    hsize_t chunks = 1;
    for (std::size_t k = 0; k < chunk.size(); ++k) chunks *= (dims[k] + chunk[k] - 1) / chunk[k];
    report_.chunks += chunks;
    return chunk[0];
  }

  void read_whole(const std::string& path)
  {
    constexpr hsize_t at_a_time = 1 << 23;  // bytes per read
    const Dataset dataset(H5Dopen2(file_, path.c_str(), H5P_DEFAULT));
    const Type type(H5Dget_type(dataset));
    const auto kind = H5Tget_class(type);
    if (kind != H5T_INTEGER && kind != H5T_FLOAT && kind != H5T_STRING)
      return add_departure(path, "is neither numbers nor text");
    const auto dims = dims_of(dataset);
    const CheckedDataset checked(file_, path, kind, static_cast<int>(dims.size()), run_.path());
    ++report_.datasets;
    if (std::count(dims.begin(), dims.end(), hsize_t{0}) > 0) return;
    checked.require_possible(dims.empty() ? 1 : dims[0]);
    const hsize_t chunk = count_chunks(dataset, dims);
    hsize_t bytes = H5Tget_size(type);  // bytes of a row
    for (std::size_t k = 1; k < dims.size(); ++k) bytes *= dims[k];
    const hsize_t rows = std::max<hsize_t>(at_a_time / (bytes * chunk), 1) * chunk;
    std::vector<char> buffer(bytes * (dims.empty() ? 1 : std::min(rows, dims[0])));
    if (dims.empty()) return checked.read_all(type, buffer.data());
    for (hsize_t first = 0; first < dims[0]; first += rows)
      checked.read_rows(type, first, std::min(rows, dims[0] - first), buffer.data());
  }

  const TrajectoryReader& run_;
  File file_;
  LayoutReport report_;
  std::set<haddr_t>
      seen_;  // addresses of objects read so far: links may lead to one twice, or in circles
};

}  // namespace

LayoutReport check_layout(const TrajectoryReader& run)
{
  return LayoutCheck(run).report();
}

}  // namespace grseg
