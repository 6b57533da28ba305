// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

/// Files of VTK (VTK File Formats, "XML file formats").
namespace grseg {

/// Arrays of a file: each is described in XML, and the raw bytes of all, each preceded by its
/// length in 8 bytes, follow at the end.
class VtkArrays {
 public:
  /// Adds `count` numbers (float, double or std::int32_t); returns the line that describes them,
  /// which names the number of components unless it is 0.
  template <class Number>
  std::string add(const std::string& name, const Number* values, std::size_t count,
                  int components = 0);
  /// The bytes that end the file.
  std::string end() const;

 private:
  std::string bytes_;
};

/// A line of a .pvd file, and the file of these lines: times (s) and files.
std::string vtk_entry(double time, const std::string& file);
std::string vtk_collection(const std::string& entries);

/// One PolyData file (.vtp). Reals are single precision, which is enough for viewing.
class PolyData {
 public:
  enum class Cells { vertices, lines };

  /// `points` holds three coordinates each. Cells are made of the points in their order: a vertex
  /// per point, or a line per pair of points.
  PolyData(Cells cells, const std::vector<float>& points, double time);

  template <class Number>
  void point_array(const std::string& name, const std::vector<Number>& values, int components = 1)
  {
    point_xml_ += arrays_.add(name, values.data(), values.size(), components);
  }
  template <class Number>
  void cell_array(const std::string& name, const std::vector<Number>& values, int components = 1)
  {
    cell_xml_ += arrays_.add(name, values.data(), values.size(), components);
  }

  std::string text() const;

 private:
  Cells kind_;
  std::size_t points_, cells_;
  double time_;
  VtkArrays arrays_;
  std::string point_xml_, cell_xml_, points_xml_, connectivity_xml_;
};

}  // namespace grseg
