// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/frames/composition.hpp"
#include "analysis/frames/layers.hpp"
#include "analysis/micro/micro_sums.hpp"
#include "formats/core/frame.hpp"

#include <limits>
#include <string>
#include <vector>

namespace grseg {

/// A contact slides where |f_t| >= (1 - tolerance) mu f_n. The solver puts sliding contacts on the
/// Coulomb limit to round-off; the tolerance leaves room for single precision.
constexpr double sliding_tolerance = 1e-6;

/// Normal and tangential part of a contact's force; see FabricSums.
struct ForceParts {
  Vec2 n;           // from j to i
  double f_n, f_t;  // N
};
ForceParts force_parts(const ContactList& contacts, std::size_t contact);

/// Number of grains and contacts, and the forces on them, by layer and of the whole bed.
class MicroStructure {
 public:
  /// `friction` is the mu of the Coulomb limit; NaN where it is unknown.
  MicroStructure(const Layers& layers, GrainArea area,
                 double friction = std::numeric_limits<double>::quiet_NaN());

  void add(const Grains& grains, const Frame& frame);
  void merge(const MicroStructure& others);
  std::size_t layers() const { return sums_.size(); }
  MicroSums mean(std::size_t layer) const;
  MicroSums mean() const;
  BedHeights heights() const;

  /// The columns of grseg-micro from area_S on; a layer's numbers, and those of the whole bed.
  static std::vector<std::string> columns();
  std::vector<double> row(std::size_t layer) const;
  std::vector<double> bed_row() const;

 private:
  void add_grains(const Grains& grains, const Frame& frame);
  void add_contacts(const Grains& grains, const Frame& frame);
  /// 1 or 0; NaN where friction is unknown.
  double slides(double f_n, double f_t) const;
  void add_ends(const Grains& grains, const Frame& frame, std::size_t contact, PairType type);

  Layers layers_;
  Composition composition_;
  double friction_;
  std::size_t frames_ = 0;
  std::vector<MicroSums> sums_;  // without areas: those are in composition_
  BedHeights heights_{0, 0, 0};
};

}  // namespace grseg
