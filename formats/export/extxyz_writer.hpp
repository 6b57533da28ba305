// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/export/output_file.hpp"
#include "formats/export/view_cell.hpp"
#include "formats/trajectory/reader.hpp"

#include <string>

namespace grseg {

/// Extended XYZ as OVITO and ASE read it: per frame the number of grains that are present, a line
/// of keys, a row for each. Types are numbers (1 the smallest species, the
/// last one the boundary), since ASE refuses species that are not
/// chemical symbols. Reals have the fewest digits that read back exactly; discs have z = 0;
/// contacts cannot be stored.
class ExtxyzWriter {
 public:
  ExtxyzWriter(const TrajectoryReader& run, const ViewCell& cell, const std::string& path,
               bool overwrite);

  /// Needs velocities, and forces where the run has them.
  template <int D>
  void add(const Frame<D>& frame);
  void publish() { file_.publish(); }

 private:
  const Grains& grains_;
  std::vector<std::int32_t> species_;
  bool has_force_;
  std::string keys_;
  OutputFile file_;
};

}  // namespace grseg
