// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/frames/composition.hpp"
#include "analysis/frames/layers.hpp"
#include "analysis/frames/sums.hpp"
#include "analysis/micro/fabric.hpp"
#include "analysis/stress/partial_stress.hpp"
#include "formats/core/frame.hpp"
#include "formats/core/species.hpp"

#include <array>
#include <string>
#include <tuple>
#include <vector>

namespace grseg {

enum class ContactForce { modulus, normal };  ///< which force of a contact: |f| or f_n
enum class ForceAverage {
  contacts,  ///< over the contacts with at least one such grain, each once (the paper's f_S, f_L)
  ends,      ///< over the contact ends on such grains: a contact between two of them counts twice
};
/// The force of a contact, and the average over contacts, that make the mean force of a species.
/// The paper (Staron & Phillips 2015, section V) takes moduli over contacts.
struct ForceMeasure {
  ContactForce force = ContactForce::modulus;
  ForceAverage average = ForceAverage::contacts;
};

/// Contacts of one pair type. Only contacts that bear a force count.
template <int D>
struct PairSums {
  double contacts = 0;
  double force = 0, normal = 0;  // N, sums of |f| and of f_n, repulsion positive
  double mobilised = 0;          // sum of |f_t|/f_n where f_n > 0
  double sliding = 0;            // contacts at the Coulomb limit; NaN where friction is unknown
  double strong = 0;             // contacts with more than the mean f_n of their layer and frame
  FabricSums<D> fabric;
  Tensor<D> stress =
      Tensor<D>::Zero();  // N m, force (x) branch, at the base cut at the contact point

  static constexpr auto members =
      std::tuple(&PairSums::contacts, &PairSums::force, &PairSums::normal, &PairSums::mobilised,
                 &PairSums::sliding, &PairSums::strong, &PairSums::fabric, &PairSums::stress);
};

/// Grains of one species and the contact ends on them, in the layer of the grain's centre.
struct SpeciesSums {
  double content = 0;     // m^2 or m^3
  double grains = 0;      // with their centre in the layer
  double ends = 0;        // all of them, base contacts included
  double mixed_ends = 0;  // of contacts with a grain of the other species
  double base_ends = 0;   // of contacts with boundary grains and walls

  static constexpr auto members =
      std::tuple(&SpeciesSums::content, &SpeciesSums::grains, &SpeciesSums::ends,
                 &SpeciesSums::mixed_ends, &SpeciesSums::base_ends);
};

/// Grains, contacts and forces in a layer or in the whole bed: sums, as means per frame. Sums of
/// several layers add up; several windows or runs are merged as means weighted by their frames.
template <int D>
struct StructureSums {
  static constexpr std::size_t dimension = D;

  std::array<SpeciesSums, 2> species{};        // S, L
  std::array<PairSums<D>, pair_types> pair{};  // by PairType, in the layer of the contact point
  Tensor<D> mixed_size = Tensor<D>::Zero();    // N m, of LS, the large grain's part by size
  Vector<D> base_force = Vector<D>::Zero();    // N, of the base on the mobile grains

  static constexpr auto members =
      std::tuple(&StructureSums::species, &StructureSums::pair, &StructureSums::mixed_size,
                 &StructureSums::base_force);

  const SpeciesSums& of(Species s) const { return species[static_cast<std::size_t>(s)]; }
  const PairSums<D>& of(PairType type) const { return pair[static_cast<std::size_t>(type)]; }
  /// Contacts between mobile grains: SS, LS and LL together.
  PairSums<D> between_grains() const;

  /// Area or volume of all grains, m^2 or m^3.
  double content() const { return species[0].content + species[1].content; }
  /// phi_L by area or volume; NaN without grains.
  double phi_large() const;
  /// z_S, z_L: contact ends per grain; NaN without grains.
  double coordination(Species s) const;
  /// f_S, f_L, N, base contacts included; NaN without contacts.
  double mean_force(Species s, const ForceMeasure& measure) const;
  /// N_LS/(N_LL + N_LS + N_SS), as in figure 2c of the paper; base contacts do not count. NaN
  /// without contacts.
  double mixed_share() const;
  /// Contact stresses in the volume of the grains, N/m or Pa (eq. 1 of the paper). `rule` is size,
  /// half, drop or uniform.
  PartialStress<D> stress(const PartitionRule& rule) const;

  /// The sums with their columns in the table of grseg-micro, from area_S or volume_S on.
  std::vector<Cell> cells() const;
  /// The sums whose cells have these values.
  static StructureSums from_values(const std::vector<double>& values);
};

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
  /// 1 where a contact slides, else 0; NaN where friction is unknown.
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
