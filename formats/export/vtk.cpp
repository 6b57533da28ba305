// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/export/vtk.hpp"

#include <fmt/format.h>

#include <bit>
#include <numeric>
#include <type_traits>

namespace grseg {

static_assert(std::endian::native == std::endian::little, "the files are marked LittleEndian");

template <class Number>
std::string VtkArrays::add(const std::string& name, const Number* values, std::size_t count,
                           int components)
{
  const char* type = std::is_same_v<Number, float> ? "Float32" : "Int32";
  auto xml = fmt::format(
      "        <DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\" format=\"appended\" "
      "offset=\"{}\"/>\n",
      type, name, components, bytes_.size());
  const std::uint64_t length = count * sizeof(Number);
  bytes_.append(reinterpret_cast<const char*>(&length), sizeof length);
  bytes_.append(reinterpret_cast<const char*>(values), length);
  return xml;
}

template std::string VtkArrays::add(const std::string&, const float*, std::size_t, int);
template std::string VtkArrays::add(const std::string&, const std::int32_t*, std::size_t, int);

std::string VtkArrays::end() const
{
  return "  <AppendedData encoding=\"raw\">\n_" + bytes_ + "\n  </AppendedData>\n</VTKFile>\n";
}

std::string vtk_entry(double time, const std::string& file)
{
  return fmt::format("    <DataSet timestep=\"{}\" part=\"0\" file=\"{}\"/>\n", time, file);
}

std::string vtk_collection(const std::string& entries)
{
  return fmt::format(R"(<?xml version="1.0"?>
<VTKFile type="Collection" version="1.0" byte_order="LittleEndian">
  <Collection>
{}  </Collection>
</VTKFile>
)",
                     entries);
}

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
  points_xml_ = arrays_.add("Points", points.data(), points.size(), 3);
  connectivity_xml_ = arrays_.add("connectivity", connectivity.data(), points_, 1) +
                      arrays_.add("offsets", offsets.data(), cells_, 1);
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
)",
             time_, points_, lines ? 0 : cells_, lines ? cells_ : 0, point_xml_, cell_xml_,
             points_xml_, cells, connectivity_xml_, cells) +
         arrays_.end();
}

}  // namespace grseg
