// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

/// Writers of VTK files (VTK File Formats, "XML file formats").
namespace grseg {

/// Arrays of a VTK file. XML elements describe them; their raw bytes follow at the end of the file,
/// each array preceded by its length (8 bytes).
class VtkArrays {
 public:
  /// Adds an array of `count` numbers (float or std::int32_t). Returns its XML line.
  template <class Number>
  std::string add(const std::string& name, const Number* values, std::size_t count, int components);
  /// End of the file: the raw bytes of all arrays, and the closing XML.
  std::string end() const;

 private:
  std::string bytes_;
};

/// Line of a .pvd file for the VTK file of one time (s), and content of a .pvd file with `entries`.
std::string vtk_entry(double time, const std::string& file);
std::string vtk_collection(const std::string& entries);

/// One PolyData file (.vtp). Reals are single precision, which is enough for viewing.
class PolyData {
 public:
  enum class Cells { vertices, lines };

  /// `points` lists three coordinates (m) per point. Cells use the points in order: a vertex per
  /// point, or a line per pair of points. `time` is in s.
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
