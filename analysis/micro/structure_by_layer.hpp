// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/frames/composition.hpp"
#include "analysis/frames/layers.hpp"
#include "analysis/frames/sums.hpp"
#include "analysis/micro/structure_sums.hpp"
#include "formats/core/frame.hpp"

#include <string>
#include <vector>

namespace grseg {

/// A contact slides where |f_t| >= (1 - tolerance) mu f_n. The solver leaves sliding contacts at
/// the Coulomb limit to round-off; the tolerance allows for files in single precision.
constexpr double sliding_tolerance = 1e-6;

/// Numbers of grains and contacts and the forces of the contacts, by layer and of the whole bed.
template <int D>
class StructureByLayer {
 public:
  /// `friction` is the mu of the Coulomb limit; NaN where it is unknown.
  StructureByLayer(const Layers& layers, GrainArea area, double friction = no_number);

  void add(const Grains& grains, const Frame<D>& frame);
  void merge(const StructureByLayer& others);
  std::size_t layers() const { return sums_.size(); }
  StructureSums<D> mean(std::size_t layer) const;
  StructureSums<D> mean() const;
  BedHeights heights() const { return heights_ / static_cast<double>(frames_); }

  /// The columns of grseg-micro from area_S or volume_S on, and the values of a layer and of the
  /// whole bed.
  static std::vector<std::string> columns() { return columns_of(cells({}, {})); }
  std::vector<double> row(std::size_t layer) const { return values_of(cells(mean(layer), {})); }
  std::vector<double> bed_row() const { return values_of(cells(mean(), heights())); }

 private:
  std::size_t holding(const Vector<D>& position) const
  {
    return layers_.template holding<D>(position, position.y());
  }
  void add_grains(const Grains& grains, const Frame<D>& frame);
  void add_contacts(const Grains& grains, const Frame<D>& frame);
  /// Whether a contact slides, as 1 or 0; NaN where friction is unknown.
  double slides(double f_n, double f_t) const;
  static std::vector<Cell> cells(const StructureSums<D>& sums, const BedHeights& heights)
  {
    auto cells = sums.cells();
    return add_all(cells, grseg::cells(heights));
  }
  void add_ends(const Grains& grains, const Frame<D>& frame, std::size_t contact, PairType type);

  Layers layers_;
  Composition<D> composition_;
  double friction_;
  std::size_t frames_ = 0;
  std::vector<StructureSums<D>> sums_;  // without contents: those are in composition_
  BedHeights heights_{0, 0, 0};         // sums over frames
};

/// The sums of a cell of a map, and what is looked at: contacts per grain, mean normal force, and
/// the parts of contacts that slide and that are mixed.
template <int D>
std::vector<Cell> map_cells(const StructureSums<D>& sums);

}  // namespace grseg
