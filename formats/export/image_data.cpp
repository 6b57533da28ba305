// SPDX-License-Identifier: GPL-3.0-or-later
// VTK image data (.vti; VTK File Formats, "XML file formats"): arrays described in XML, followed by
// their raw bytes, each preceded by its length in 8 bytes.
#include "formats/export/map_file.hpp"

#include <fmt/format.h>

#include <bit>
#include <cstdint>

namespace grseg {
namespace {

static_assert(std::endian::native == std::endian::little, "the files are marked LittleEndian");

class Arrays {
 public:
  void add(const std::string& name, const double* values, std::size_t count)
  {
    xml_ += fmt::format(
        "        <DataArray type=\"Float64\" Name=\"{}\" format=\"appended\" offset=\"{}\"/>\n",
        name, bytes_.size());
    const std::uint64_t length = count * sizeof(double);
    bytes_.append(reinterpret_cast<const char*>(&length), sizeof length);
    bytes_.append(reinterpret_cast<const char*>(values), length);
  }
  const std::string& xml() const { return xml_; }
  const std::string& bytes() const { return bytes_; }

 private:
  std::string xml_, bytes_;
};

/// As VTK writes texts: the numbers of their bytes, then 0.
std::string text_array(const std::string& name, const std::string& text)
{
  std::string codes;
  for (const char c : text) codes += fmt::format("{} ", static_cast<unsigned char>(c));
  return fmt::format(
      "      <Array type=\"String\" Name=\"{}\" NumberOfTuples=\"1\" format=\"ascii\">{}0</Array>\n",
      name, codes);
}

/// Numbers of the axes x, y, z that a map lies along; r is drawn along x.
std::size_t direction(const std::string& axis)
{
  return axis == "z" ? 2 : axis == "y" ? 1 : 0;
}

}  // namespace

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

  Arrays arrays;
  for (const auto& field : map.fields)
    arrays.add(field.unit.empty() ? field.name : field.name + " (" + field.unit + ")",
               field.values.data() + window * map.cells(), map.cells());
  arrays.add("V (" + map.volume.unit + ")", map.volume.values.data(), map.cells());
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
  <AppendedData encoding="raw">
_)",
                     extent, origin[0], origin[1], origin[2], spacing[0], spacing[1], spacing[2],
                     map.windows[window].middle(), begin, end, frames, header, extent,
                     arrays.xml()) +
         arrays.bytes() + "\n  </AppendedData>\n</VTKFile>\n";
}

}  // namespace grseg
