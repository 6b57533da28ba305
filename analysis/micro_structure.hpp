// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/composition.hpp"
#include "analysis/layers.hpp"
#include "analysis/pair_type.hpp"
#include "formats/frame.hpp"

#include <array>
#include <string>
#include <vector>

namespace grseg {

/// Share of mixed contacts in the neutral model, where contact ends are in proportion to perimeter
/// and pair at random: 2 x_L x_S with x_L = phi_L/(phi_L + r phi_S), r = d_L/d_S. For r = 2 it is
/// 4 phi_L phi_S/(1 + phi_S)^2, at most 1/2, at phi_L = 2/3.
double neutral_mixed_share(double phi_large, double size_ratio);

/// What a layer, or the whole bed, holds: means per frame. Only contacts that carry a force count.
struct MicroSums {
  std::array<double, 2> grains{};  // S and L grains, by their centre
  std::array<double, 2> ends{};    // contact ends on them, base contacts included, likewise
  // By PairType, where the contact point is:
  std::array<double, pair_types> contacts{};
  std::array<double, pair_types> force{};   // N, sum of moduli
  std::array<double, pair_types> normal{};  // N, sum of normal parts, repulsion positive
  Vec2 base_force = Vec2::Zero();           // N, of boundary grains and walls on the mobile grains

  MicroSums& operator+=(const MicroSums& other);
  MicroSums operator/(double number) const;

  /// z_S, z_L: contact ends per grain; NaN without grains.
  double coordination(Species species) const;
  /// f_S, f_L, N: mean modulus over the contacts with at least one such grain, base contacts
  /// included (Staron & Phillips 2015, below eq. for Pi); NaN without contacts.
  double mean_force(Species species) const;
  /// N_LS/(N_LL + N_LS + N_SS); base contacts do not count. NaN without contacts.
  double mixed_share() const;
};

/// The paper's estimates of the pressure, N/m, from phi, z, f and nominal diameters d:
///   Pi_S = phi_S z_S f_S/(pi d_S), Pi_L likewise, Pi = Pi_S + Pi_L.
/// The paper prints 2/(pi d), which lacks the 1/2 of P = tr(sigma)/2 and gives twice the pressure.
/// Since phi_S + phi_L = 1 these are stresses in the volume of the grains, V_solid; the stress in
/// the whole volume is nu times as large. NaN where z or f is, unless the species is absent.
struct PressureEstimate {
  double small = 0, large = 0;
  double total() const { return small + large; }
};
PressureEstimate estimate_pressure(const MicroSums& sums, double phi_large, double small_diameter,
                                   double large_diameter);

/// Heights of the bed, m, means per frame.
struct BedHeights {
  double large = 0, small = 0;  // y_L, y_S: centres of mass of the species; NaN without grains
  double bed = 0;               // twice the mean height of the mobile grains' area
};

/// Number of grains and contacts, and the forces on them, by layer and of the whole bed.
class MicroStructure {
 public:
  MicroStructure(const Layers& layers, GrainArea area, double small_diameter,
                 double large_diameter);

  void add(const Grains& grains, const Frame& frame);
  void merge(const MicroStructure& others);
  std::size_t layers() const { return sums_.size(); }
  MicroSums mean(std::size_t layer) const;
  MicroSums mean() const;
  BedHeights heights() const;

  /// The columns of grseg-micro from grains_S on; a layer's numbers, and those of the whole bed.
  static std::vector<std::string> columns();
  std::vector<double> row(std::size_t layer) const;
  std::vector<double> bed_row() const;

 private:
  void add_heights(const Grains& grains, const Frame& frame);
  std::vector<double> row(const MicroSums& sums, double phi_large, const BedHeights& heights) const;

  Layers layers_;
  Composition composition_;
  double small_diameter_, large_diameter_;
  std::size_t frames_ = 0;
  std::vector<MicroSums> sums_;
  BedHeights heights_;
};

}  // namespace grseg
