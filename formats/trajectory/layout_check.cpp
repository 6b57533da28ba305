// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/trajectory/layout_check.hpp"

#include "formats/trajectory/digest.hpp"
#include "formats/trajectory/hdf5_attributes.hpp"
#include "formats/trajectory/run_description.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <set>

namespace grseg {
namespace {

using namespace hdf5;

struct NumberType {
  const char* name;
  H5T_class_t kind;
  std::size_t bytes;
  H5T_sign_t sign = H5T_SGN_ERROR;  // of integers
};
constexpr NumberType i32{"int32", H5T_INTEGER, 4, H5T_SGN_2};
constexpr NumberType i64{"int64", H5T_INTEGER, 8, H5T_SGN_2};
constexpr NumberType u8{"uint8", H5T_INTEGER, 1, H5T_SGN_NONE};
constexpr NumberType u64{"uint64", H5T_INTEGER, 8, H5T_SGN_NONE};
constexpr NumberType f32{"float32", H5T_FLOAT, 4};
constexpr NumberType f64{"float64", H5T_FLOAT, 8};

/// A row of the table of formats/README.md. A letter of `shape` is F frames, O = F+1, N grains, C
/// contacts, K species, D digests of a frame, d dimensions, w those of a spin, or 4. `stored`: float32 where the run says so.
struct Row {
  const char* path;
  NumberType type;
  bool stored;
  const char* shape;
  const char* unit;
};
constexpr std::array table{
    Row{"/particles/grains/box/edges", f64, false, "d", ""},
    Row{"/particles/grains/id", i32, false, "N", ""},
    Row{"/particles/grains/species", i32, false, "N", ""},
    Row{"/particles/grains/radius", f64, false, "N", ""},
    Row{"/particles/grains/mass", f64, false, "N", ""},
    Row{"/particles/grains/fixed", u8, false, "N", ""},
    Row{"/particles/grains/position/value", f64, true, "FNd", "m"},
    Row{"/particles/grains/position/step", i64, false, "F", ""},
    Row{"/particles/grains/position/time", f64, false, "F", "s"},
    Row{"/particles/grains/image/value", i32, false, "FNd", ""},
    Row{"/particles/grains/velocity/value", f64, true, "FNd", "m s-1"},
    Row{"/particles/grains/angular_velocity/value", f64, true, "FNw", "s-1"},
    Row{"/particles/grains/force/value", f64, true, "FNd", "N"},
    Row{"/grseg/contacts/offset", u64, false, "O", ""},
    Row{"/grseg/contacts/i", i32, false, "C", ""},
    Row{"/grseg/contacts/j", i32, false, "C", ""},
    Row{"/grseg/contacts/force", f64, true, "Cd", "N"},
    Row{"/grseg/contacts/branch", f64, true, "Cd", "m"},
    Row{"/grseg/contacts/gap", f64, true, "C", "m"},
    Row{"/grseg/digest", u64, false, "F", ""},
    Row{"/grseg/field_digest", u64, false, "FD", ""},
    Row{"/grseg/static_digest", u64, false, "", ""},
    Row{"/grseg/seal", u64, false, "4", ""},
    Row{"/grseg/species/diameter", f64, false, "K", ""},
    Row{"/grseg/species/mobile", u8, false, "K", ""},
};

bool is_of(const Type& type, const NumberType& wanted)
{
  return H5Tget_class(type) == wanted.kind && H5Tget_size(type) == wanted.bytes &&
         (wanted.kind != H5T_INTEGER || H5Tget_sign(type) == wanted.sign);
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
    for (const auto& row : table)
      if (run_.has_force() || std::string(row.path) != "/particles/grains/force/value")
        check_row(row);
    for (const char* element : {"velocity", "angular_velocity", "image", "force"})
      if (run_.has_force() || std::string(element) != "force")
        check_times(std::string("/particles/grains/") + element);
    for (const auto& [name, unit] : run_.observables()) {
      check_row({("/observables/" + name + "/value").c_str(), f64, false, "F", unit.c_str()});
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
  void check_attributes();
  void check_text(const std::string& path, const std::string& name, const std::string& wanted);
  void check_row(const Row& row);
  void check_times(const std::string& element);
  void read_all_in(const std::string& group);
  hsize_t count_chunks(const Dataset& dataset, const std::vector<hsize_t>& dims);
  void read_whole(const std::string& path);
  std::vector<hsize_t> shape_of(const std::string& letters) const;

  const TrajectoryReader& run_;
  File file_;
  LayoutReport report_;
  std::set<haddr_t>
      seen_;  // objects that have been read: links may lead to one twice, or in circles
};

/// An empty `wanted` accepts any text that is not empty.
void LayoutCheck::check_text(const std::string& path, const std::string& name,
                             const std::string& wanted)
{
  const auto found = read_texts(Object(H5Oopen(file_, path.c_str(), H5P_DEFAULT)), name);
  const bool right = found.size() == 1 && (wanted.empty() ? !found[0].empty() : found[0] == wanted);
  if (right) return;
  add_departure(path, wanted.empty() ? fmt::format("has no text `{}`", name)
                                     : fmt::format("should have the {} \"{}\", but has \"{}\"",
                                                   name, wanted, fmt::join(found, "\", \"")));
}

void LayoutCheck::check_attributes()
{
  check_text("/h5md/author", "name", "");
  check_text("/h5md/creator", "name", "");
  check_text("/h5md/creator", "version", "");
  check_text("/h5md/modules/units", "system", "SI");
  const auto numbers = [&](const char* path, const char* name, const std::vector<int>& wanted) {
    const auto found = read_integers(Object(H5Oopen(file_, path, H5P_DEFAULT)), name);
    if (found != wanted)
      add_departure(path, fmt::format("should have the {} {}, but has {}", name, wanted, found));
  };
  numbers("/h5md", "version", {1, 1});
  numbers("/h5md/modules/units", "version", {1, 0});
  numbers("/h5md/modules/grseg", "version", {1, 0});
  if (run_.grains_come_and_go()) numbers("/particles/grains", "come_and_go", {1});
  numbers("/particles/grains/box", "dimension", {run_.dimension()});
}

std::vector<hsize_t> LayoutCheck::shape_of(const std::string& letters) const
{
  std::vector<hsize_t> shape;
  for (const char letter : letters) {
    if (letter == 'F') shape.push_back(run_.size());
    if (letter == 'O') shape.push_back(run_.size() + 1);
    if (letter == 'N') shape.push_back(run_.grains().size());
    if (letter == 'C') shape.push_back(run_.contacts());
    if (letter == 'K') shape.push_back(run_.species().size() + 1);
    if (letter == 'D') shape.push_back(number_of_fields);
    if (letter == 'd' || (letter == 'w' && run_.dimension() == 3))
      shape.push_back(static_cast<hsize_t>(run_.dimension()));
    if (letter == '4') shape.push_back(4);
  }
  return shape;
}

/// Datasets of a run that was not closed may hold more: what it wrote after its last committed
/// frame.
void LayoutCheck::check_row(const Row& row)
{
  const Dataset dataset(H5Dopen2(file_, row.path, H5P_DEFAULT));
  if (!dataset.valid()) return add_departure(row.path, "is missing or not a dataset");
  const auto& type = row.stored && run_.stores_float32() ? f32 : row.type;
  if (!is_of(Type(H5Dget_type(dataset)), type))
    add_departure(row.path, fmt::format("should be of type {}", type.name));
  auto found = dims_of(dataset);
  const auto wanted = shape_of(row.shape);
  if (!run_.closed() && !found.empty() && found[0] > wanted[0]) found[0] = wanted[0];
  if (found != wanted)
    add_departure(row.path, fmt::format("should have the shape {}, but has {}", wanted, found));
  if (*row.unit != '\0') check_text(row.path, "unit", row.unit);
}

void LayoutCheck::check_times(const std::string& element)
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

void LayoutCheck::read_all_in(const std::string& group)
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

/// Adds to the report the chunks that the shape needs (HDF5 would count them in an index, which may
/// claim any number); returns the rows of a chunk.
hsize_t LayoutCheck::count_chunks(const Dataset& dataset, const std::vector<hsize_t>& dims)
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

void LayoutCheck::read_whole(const std::string& path)
{
  constexpr hsize_t at_a_time = 1 << 23;  // bytes
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
  hsize_t bytes = H5Tget_size(type);  // of a row
  for (std::size_t k = 1; k < dims.size(); ++k) bytes *= dims[k];
  const hsize_t rows = std::max<hsize_t>(at_a_time / (bytes * chunk), 1) * chunk;
  std::vector<char> buffer(bytes * (dims.empty() ? 1 : std::min(rows, dims[0])));
  if (dims.empty()) return checked.read_all(type, buffer.data());
  for (hsize_t first = 0; first < dims[0]; first += rows)
    checked.read_rows(type, first, std::min(rows, dims[0] - first), buffer.data());
}

}  // namespace

LayoutReport check_layout(const TrajectoryReader& run)
{
  return LayoutCheck(run).report();
}

}  // namespace grseg
