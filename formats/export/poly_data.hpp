// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace grseg {

/// One VTK PolyData file (.vtp; VTK File Formats, "XML file formats"): arrays described in XML,
/// followed by their raw bytes, each preceded by its length in 8 bytes. Reals are single precision,
/// which is enough for viewing.
class PolyData {
 public:
  enum class Cells { vertices, lines };

  /// `points` holds three coordinates each. Cells are made of the points in their order: a vertex
  /// per point, or a line per pair of points.
  PolyData(Cells cells, const std::vector<float>& points, double time);

  void point_array(const std::string& name, const std::vector<float>& values, int components = 1);
  void point_array(const std::string& name, const std::vector<std::int32_t>& values);
  void cell_array(const std::string& name, const std::vector<float>& values, int components = 1);
  void cell_array(const std::string& name, const std::vector<std::int32_t>& values);

  std::string text() const;

 private:
  template <class Number>
  std::string describe(const std::string& name, const std::vector<Number>& values, int components);

  Cells kind_;
  std::size_t points_, cells_;
  double time_;
  std::string point_xml_, cell_xml_, points_xml_, connectivity_xml_, bytes_;
};

}  // namespace grseg
