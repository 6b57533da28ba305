// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/core/errors.hpp"
#include "formats/export/map_file.hpp"
#include "formats/trajectory/hdf5.hpp"
#include "formats/trajectory/hdf5_attributes.hpp"

#include <fmt/format.h>
#include <hdf5_hl.h>

#include <functional>

namespace grseg {
namespace {

using namespace hdf5;

class MapFile {
 public:
  MapFile(const std::string& path, const std::string& name) : name_(name)
  {
    silence();
    file_ = File(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, without_time(), newest_format()));
    require(file_.valid());
  }

  /// Writes an attribute of the file.
  void attribute(const std::string& key, const std::string& text) const
  {
    write_attribute(Object(H5Oopen(file_, "/", H5P_DEFAULT)), key, text);
  }

  /// Writes the dimension scale `name`: the coordinates along a dimension of this name.
  void scale(const std::string& name, const std::string& unit, const std::vector<double>& numbers)
  {
    const auto dataset = write(name, unit, {numbers.size()}, numbers);
    require(H5DSset_scale(dataset, name.c_str()) >= 0);
  }

  /// Writes a field over the dimensions with the names `dimensions`.
  void field(const std::string& name, const std::string& unit,
             const std::vector<std::string>& dimensions, const std::vector<double>& numbers)
  {
    std::vector<hsize_t> shape;
    for (const auto& dimension : dimensions) {
      const Space space(H5Dget_space(opened(dimension)));
      shape.push_back(static_cast<hsize_t>(H5Sget_simple_extent_npoints(space)));
    }
    const auto dataset = write(name, unit, shape, numbers);
    for (unsigned k = 0; k < dimensions.size(); ++k)
      require(H5DSattach_scale(dataset, opened(dimensions[k]), k) >= 0);
  }

  void close() { require(close_file(file_.release()) >= 0); }

 private:
  void require(bool done) const
  {
    if (!done) throw RunError(fmt::format("cannot write {}: {}", name_, reason_of_failure()));
  }
  Dataset opened(const std::string& name) const
  {
    Dataset dataset(H5Dopen2(file_, name.c_str(), H5P_DEFAULT));
    require(dataset.valid());
    return dataset;
  }
  Dataset write(const std::string& name, const std::string& unit, const std::vector<hsize_t>& shape,
                const std::vector<double>& numbers) const
  {
    write_fixed(file_, name, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, shape, numbers.data());
    auto dataset = opened(name);
    if (!unit.empty()) write_attribute(dataset, "units", unit);
    return dataset;
  }

  std::string name_;
  File file_;
};

template <class Member>
std::vector<double> of_windows(const MapTable& map, const Member& member)
{
  std::vector<double> numbers;
  for (const auto& window : map.windows) numbers.push_back(std::invoke(member, window));
  return numbers;
}

/// Name of the dataset of a column. A slash would create a group, so "sum_ft/fn_SS" becomes
/// "sum_ft_per_fn_SS". A coordinate keeps its name, so the column "z", contacts per grain, becomes
/// "z_all" beside "z_S" and "z_L" in maps with the coordinate z.
std::string dataset_name(const std::string& column, const MapTable& map)
{
  if (column == map.axes[0].name || column == map.axes[1].name) return column + "_all";
  const auto slash = column.find('/');
  return slash == std::string::npos ? column
                                    : column.substr(0, slash) + "_per_" + column.substr(slash + 1);
}

}  // namespace

void write_map_file(const Table& table, const OutputOptions& output,
                    const std::vector<std::string>& inputs)
{
  const auto map = map_table(table);
  Output whole(output.path, output.overwrite, inputs);
  MapFile file(whole.temporary(), output.path);
  for (const auto& [key, value] : map.header) file.attribute(key, value);
  file.scale("time", "s", of_windows(map, &MapTable::Window::middle));
  for (const auto& axis : map.axes) {
    std::vector<double> middles;
    for (std::size_t cell = 0; cell < axis.cells(); ++cell) middles.push_back(axis.middle(cell));
    file.scale(axis.name, "m", middles);
    file.scale(axis.name + "_edges", "m", axis.edges);
  }
  file.field("t0", "s", {"time"}, of_windows(map, &MapTable::Window::begin));
  file.field("t1", "s", {"time"}, of_windows(map, &MapTable::Window::end));
  file.field("frames", "", {"time"}, of_windows(map, &MapTable::Window::frames));
  const auto &first = map.axes[0].name, &second = map.axes[1].name;
  file.field("V", map.volume.unit, {second, first}, map.volume.values);
  for (const auto& field : map.fields)
    file.field(dataset_name(field.name, map), field.unit, {"time", second, first}, field.values);
  file.close();
  whole.publish();
}

}  // namespace grseg
