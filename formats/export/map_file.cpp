// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/export/map_file.hpp"

#include "formats/core/errors.hpp"
#include "formats/core/files.hpp"
#include "formats/core/text.hpp"
#include "formats/export/output_file.hpp"
#include "formats/export/vtk.hpp"

#include <fmt/format.h>

#include <filesystem>

namespace grseg {
namespace {

const std::string first_image = "000000.vti";

std::string folder_of(const std::string& list)
{
  return list.substr(0, list.size() - std::string(".pvd").size());
}

/// XML element of a text as VTK writes it: the numbers of its bytes, then 0.
std::string text_array(const std::string& name, const std::string& text)
{
  std::string codes;
  for (const char c : text) codes += fmt::format("{} ", static_cast<unsigned char>(c));
  return fmt::format(
      "      <Array type=\"String\" Name=\"{}\" NumberOfTuples=\"1\" format=\"ascii\">{}0</Array>\n",
      name, codes);
}

/// Index of a map axis in the VTK image: x 0, y 1, z 2; an axis r is drawn along x.
std::size_t direction(const std::string& axis)
{
  return axis == "z" ? 2 : axis == "y" ? 1 : 0;
}

/// Content of a .vti file for one window of a map.
std::string image_data(const MapTable& map, std::size_t window)
{
  std::size_t cells[3] = {0, 0, 0};
  double origin[3] = {0, 0, 0}, spacing[3] = {1, 1, 1};
  for (const auto& axis : map.axes) {
    const auto k = direction(axis.name);
    cells[k] = axis.cells();
    origin[k] = axis.edges.front();
    spacing[k] = (axis.edges.back() - axis.edges.front()) / static_cast<double>(axis.cells());
  }
  const auto extent = fmt::format("0 {} 0 {} 0 {}", cells[0], cells[1], cells[2]);

  VtkArrays arrays;
  std::string fields;
  for (const auto& field : map.fields)
    fields += arrays.add(field.unit.empty() ? field.name : field.name + " (" + field.unit + ")",
                         field.values.data() + window * map.cells(), map.cells());
  fields += arrays.add("V (" + map.volume.unit + ")", map.volume.values.data(), map.cells());
  std::string header;
  for (const auto& [key, value] : map.header) header += text_array(key, value);
  const auto& [begin, end, frames] = map.windows[window];
  return fmt::format(R"(<?xml version="1.0"?>
<VTKFile type="ImageData" version="1.0" byte_order="LittleEndian" header_type="UInt64">
  <ImageData WholeExtent="{}" Origin="{} {} {}" Spacing="{} {} {}">
    <FieldData>
      <DataArray type="Float64" Name="TimeValue" NumberOfTuples="1" format="ascii">{}</DataArray>
      <DataArray type="Float64" Name="t0" NumberOfTuples="1" format="ascii">{}</DataArray>
      <DataArray type="Float64" Name="t1" NumberOfTuples="1" format="ascii">{}</DataArray>
      <DataArray type="Float64" Name="frames" NumberOfTuples="1" format="ascii">{}</DataArray>
{}    </FieldData>
    <Piece Extent="{}">
      <CellData>
{}      </CellData>
    </Piece>
  </ImageData>
)",
                     extent, origin[0], origin[1], origin[2], spacing[0], spacing[1], spacing[2],
                     map.windows[window].middle(), begin, end, frames, header, extent, fields) +
         arrays.end();
}

void write_series(const MapTable& map, const OutputOptions& output,
                  const std::vector<std::string>& inputs)
{
  const auto path = folder_of(output.path);
  const auto name = xml_escaped(std::filesystem::path(path).filename().string());
  OutputFolder folder(path, first_image, output.overwrite, inputs);
  std::string list;
  for (std::size_t w = 0; w < map.windows.size(); ++w) {
    const auto file = fmt::format("{:06}.vti", w);
    folder.add_file(file, image_data(map, w));
    list += vtk_entry(map.windows[w].middle(), fmt::format("{}/{}", name, file));
  }
  folder.publish();
  write_whole(output, vtk_collection(list));
}

}  // namespace

bool is_map_file(const std::string& path)
{
  return path.ends_with(".h5") || path.ends_with(".vti") || path.ends_with(".pvd");
}

void check_map_file(const OutputOptions& output, const std::vector<std::string>& inputs)
{
  check_output(output.path, output.overwrite, inputs);
  if (!output.path.ends_with(".pvd")) return;
  const auto folder = folder_of(output.path);
  refuse_input_as_output(folder, inputs);
  if (is_taken(folder) && !output.overwrite) throw UsageError(already_exists(folder));
}

void write_map_file(const Table& table, const OutputOptions& output,
                    const std::vector<std::string>& inputs)
{
  const auto map = map_table(table);
  if (output.path.ends_with(".pvd")) return write_series(map, output, inputs);
  if (output.path.ends_with(".h5")) {
    Output file(output.path, output.overwrite, inputs);
    write_map_hdf5(map, file.temporary(), output.path);
    return file.publish();
  }
  if (map.windows.size() > 1)
    throw UsageError(fmt::format(
        "a .vti file stores one window, and there are {}: use -o {}.pvd or a longer --window",
        map.windows.size(), output.path.substr(0, output.path.size() - 4)));
  write_whole(output, image_data(map, 0));
}

}  // namespace grseg
