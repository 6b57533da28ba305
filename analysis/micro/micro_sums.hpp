// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/micro/fabric.hpp"
#include "analysis/stress/partial_stress.hpp"
#include "formats/core/frame.hpp"
#include "formats/core/pair_type.hpp"

#include <array>
#include <string>
#include <vector>

namespace grseg {

enum class ContactForce { modulus, normal };  ///< which force of a contact: |f| or f_n
enum class ForceAverage {
  contacts,  ///< over the contacts with at least one such grain, each once (Staron & Phillips 2015)
  ends,      ///< over the contact ends on such grains: a contact between two of them counts twice
};
struct ForceMeasure {
  ContactForce force = ContactForce::modulus;
  ForceAverage average = ForceAverage::contacts;
};

/// Contacts of one pair type; only contacts that carry a force count.
struct PairSums {
  double contacts = 0;
  double force = 0, normal = 0;  // N, sums of |f| and of f_n, repulsion positive
  double mobilised = 0;          // sum of |f_t|/f_n where f_n > 0
  double sliding = 0;            // contacts at the Coulomb limit; NaN where friction is unknown
  double strong = 0;             // contacts with more than the mean f_n of their layer and frame
  FabricSums fabric;
  Tensor2 stress = Tensor2::Zero();  // N m, force (x) branch, at the base cut at the contact point

  PairSums& operator+=(const PairSums& others);
};

/// Grains of one species and the contact ends on them, booked where the grain's centre is.
struct SpeciesSums {
  double area = 0;        // m^2
  double grains = 0;      // with their centre in the layer
  double ends = 0;        // base contacts included
  double mixed_ends = 0;  // of these, with a grain of the other species
  double base_ends = 0;   // with boundary grains and walls

  SpeciesSums& operator+=(const SpeciesSums& others);
};

/// What a layer, or the whole bed, holds: sums, as means per frame. Sums of several layers add up;
/// several windows or runs are merged as means weighted by their frames.
struct MicroSums {
  std::array<SpeciesSums, 2> species{};     // S, L
  std::array<PairSums, pair_types> pair{};  // by PairType, booked where the contact point is
  Tensor2 mixed_size = Tensor2::Zero();     // N m, of LS, the large grain's part by size
  Vec2 base_force = Vec2::Zero();           // N, of the base on the mobile grains

  MicroSums& operator+=(const MicroSums& others);
  MicroSums operator*(double factor) const;
  MicroSums operator/(double divisor) const;

  const SpeciesSums& of(Species s) const { return species[static_cast<std::size_t>(s)]; }
  const PairSums& of(PairType type) const { return pair[static_cast<std::size_t>(type)]; }
  /// Contacts between mobile grains: SS, LS and LL together.
  PairSums between_grains() const;

  /// NaN without grains.
  double phi_large() const;
  /// z_S, z_L: contact ends per grain; NaN without grains.
  double coordination(Species s) const;
  /// f_S, f_L, N, base contacts included; NaN without contacts.
  double mean_force(Species s, const ForceMeasure& measure) const;
  /// N_LS/(N_LL + N_LS + N_SS); base contacts do not count. NaN without contacts.
  double mixed_share() const;
  /// Contact stresses in the volume of the grains, N/m. `rule` is size, half, drop or uniform.
  PartialStress stress(const PartitionRule& rule) const;

  /// The numbers under the columns of grseg-micro, from area_S on.
  static std::vector<std::string> columns();
  std::vector<double> numbers() const;
  static MicroSums from_numbers(const std::vector<double>& numbers);
};

/// Heights of the bed, m, means per frame; NaN where there are no such grains, and in layers.
struct BedHeights {
  double large, small;  // y_L, y_S: centres of mass of the species
  double bed;           // twice the mean height of the mobile grains' area
};

}  // namespace grseg
