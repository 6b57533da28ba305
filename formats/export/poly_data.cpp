// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/export/poly_data.hpp"

#include <fmt/format.h>

#include <bit>
#include <numeric>
#include <type_traits>

namespace grseg {

static_assert(std::endian::native == std::endian::little, "the files are marked LittleEndian");

PolyData::PolyData(Cells cells, const std::vector<float>& points, double time)
    : kind_(cells),
      points_(points.size() / 3),
      cells_(cells == Cells::vertices ? points_ : points_ / 2),
      time_(time)
{
  std::vector<std::int32_t> connectivity(points_), offsets(cells_);
  std::iota(connectivity.begin(), connectivity.end(), 0);
  for (std::size_t c = 0; c < cells_; ++c)
    offsets[c] = static_cast<std::int32_t>((c + 1) * points_ / cells_);
  points_xml_ = describe("Points", points, 3);
  connectivity_xml_ = describe("connectivity", connectivity, 1) + describe("offsets", offsets, 1);
}

template <class Number>
std::string PolyData::describe(const std::string& name, const std::vector<Number>& values,
                               int components)
{
  auto xml = fmt::format(
      "        <DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\" format=\"appended\" "
      "offset=\"{}\"/>\n",
      std::is_same_v<Number, float> ? "Float32" : "Int32", name, components, bytes_.size());
  const std::uint64_t length = values.size() * sizeof(Number);
  bytes_.append(reinterpret_cast<const char*>(&length), sizeof length);
  bytes_.append(reinterpret_cast<const char*>(values.data()), length);
  return xml;
}

void PolyData::point_array(const std::string& name, const std::vector<float>& values,
                           int components)
{
  point_xml_ += describe(name, values, components);
}

void PolyData::point_array(const std::string& name, const std::vector<std::int32_t>& values)
{
  point_xml_ += describe(name, values, 1);
}

void PolyData::cell_array(const std::string& name, const std::vector<float>& values, int components)
{
  cell_xml_ += describe(name, values, components);
}

void PolyData::cell_array(const std::string& name, const std::vector<std::int32_t>& values)
{
  cell_xml_ += describe(name, values, 1);
}

std::string PolyData::text() const
{
  const bool lines = kind_ == Cells::lines;
  const char* cells = lines ? "Lines" : "Verts";
  return fmt::format(
             R"(<?xml version="1.0"?>
<VTKFile type="PolyData" version="1.0" byte_order="LittleEndian" header_type="UInt64">
  <PolyData>
    <FieldData>
      <DataArray type="Float64" Name="TimeValue" NumberOfTuples="1" format="ascii">{}</DataArray>
    </FieldData>
    <Piece NumberOfPoints="{}" NumberOfVerts="{}" NumberOfLines="{}" NumberOfStrips="0" NumberOfPolys="0">
      <PointData>
{}      </PointData>
      <CellData>
{}      </CellData>
      <Points>
{}      </Points>
      <{}>
{}      </{}>
    </Piece>
  </PolyData>
  <AppendedData encoding="raw">
_)",
             time_, points_, lines ? 0 : cells_, lines ? cells_ : 0, point_xml_, cell_xml_,
             points_xml_, cells, connectivity_xml_, cells) +
         bytes_ + "\n  </AppendedData>\n</VTKFile>\n";
}

}  // namespace grseg
