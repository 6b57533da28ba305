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

enum class ContactForce { modulus, normal };  ///< force of a contact: |f| or f_n
enum class ForceAverage {
  contacts,  ///< over contacts with at least one grain of the species, each once
  ends,      ///< over contact ends on the species: a contact of two such grains counts twice
};
/// Definition of the mean forces f_S and f_L of the species. Staron & Phillips (2015, section V)
/// use the modulus, averaged over contacts.
struct ForceMeasure {
  ContactForce force = ContactForce::modulus;
  ForceAverage average = ForceAverage::contacts;
};

/// Sums over contacts of one pair type, without contacts that bear no force.
template <int D>
struct PairSums {
  double contacts = 0;           // number of contacts
  double force = 0, normal = 0;  // sums of |f| and of f_n (positive in repulsion), N
  double mobilised = 0;          // sum of |f_t|/f_n over contacts with f_n > 0
  double sliding = 0;            // number of contacts at the Coulomb limit; NaN without friction mu
  double strong = 0;             // number of contacts with f_n above the mean of layer and frame
  FabricSums<D> fabric;
  Tensor<D> stress =
      Tensor<D>::Zero();  // sum of force (x) branch, N m; at the base only to the contact point

  static constexpr auto members =
      std::tuple(&PairSums::contacts, &PairSums::force, &PairSums::normal, &PairSums::mobilised,
                 &PairSums::sliding, &PairSums::strong, &PairSums::fabric, &PairSums::stress);
};

/// Numbers of grains of one species and of their contact ends, in the layer of the grain's centre.
struct SpeciesSums {
  double content = 0;     // area or volume of the grains in the layer, m^2 or m^3
  double grains = 0;      // number of grains with their centre in the layer
  double ends = 0;        // number of contact ends, including contacts with the base
  double mixed_ends = 0;  // number of ends of contacts with a grain of the other species
  double base_ends = 0;   // number of ends of contacts with boundary grains and walls

  static constexpr auto members =
      std::tuple(&SpeciesSums::content, &SpeciesSums::grains, &SpeciesSums::ends,
                 &SpeciesSums::mixed_ends, &SpeciesSums::base_ends);
};

/// Sums over grains and contacts in a layer or in the whole bed, averaged over frames. Sums of
/// layers add up to sums of the bed. Windows and runs are merged as means weighted by frames.
template <int D>
struct StructureSums {
  static constexpr std::size_t dimension = D;

  std::array<SpeciesSums, 2> species{};        // sums of species S and L
  std::array<PairSums<D>, pair_types> pair{};  // sums by PairType, in the contact point's layer
  Tensor<D> mixed_size = Tensor<D>::Zero();    // large grains' part of LS under rule `size`, N m
  Vector<D> base_force = Vector<D>::Zero();    // force of the base on the mobile grains, N

  static constexpr auto members =
      std::tuple(&StructureSums::species, &StructureSums::pair, &StructureSums::mixed_size,
                 &StructureSums::base_force);

  const SpeciesSums& of(Species s) const { return species[static_cast<std::size_t>(s)]; }
  const PairSums<D>& of(PairType type) const { return pair[static_cast<std::size_t>(type)]; }
  /// Sums over all contacts between mobile grains: SS, LS and LL.
  PairSums<D> between_grains() const;

  /// Area or volume of all grains, m^2 or m^3.
  double content() const { return species[0].content + species[1].content; }
  /// Composition phi_L by area or volume; NaN without grains.
  double phi_large() const;
  /// Contact ends per grain, z_S or z_L; NaN without grains.
  double coordination(Species s) const;
  /// Mean force f_S or f_L, N, including contacts with the base; NaN without contacts.
  double mean_force(Species s, const ForceMeasure& measure) const;
  /// Share of mixed contacts N_LS/(N_LL + N_LS + N_SS), as in figure 2c of Staron & Phillips
  /// (2015), without contacts with the base. NaN without contacts.
  double mixed_share() const;
  /// Contact stresses in the volume of the grains, N/m or Pa (Staron & Phillips 2015, eq. 1).
  /// `rule` is size, half, drop or uniform.
  PartialStress<D> stress(const PartitionRule& rule) const;

  /// The sums with the names of their columns in tables of grseg-micro, from area_S or volume_S on.
  std::vector<Cell> cells() const;
  /// The sums with these values of cells(): the inverse function.
  static StructureSums from_values(const std::vector<double>& values);
};

/// A contact slides if |f_t| >= (1 - tolerance) mu f_n. In simulations sliding contacts are at the
/// Coulomb limit to round-off; the tolerance allows for files in single precision.
constexpr double sliding_tolerance = 1e-6;

/// Numbers of grains and contacts and the forces of the contacts, by layer and of the whole bed.
template <int D>
class StructureByLayer {
 public:
  /// `friction` is the coefficient mu of the Coulomb limit; NaN if it is unknown.
  StructureByLayer(const Layers& layers, GrainArea area, double friction = no_number);

  void add(const Grains& grains, const Frame<D>& frame);
  void merge(const StructureByLayer& others);
  std::size_t layers() const { return sums_.size(); }
  StructureSums<D> mean(std::size_t layer) const;
  StructureSums<D> mean() const;
  BedHeights heights() const { return heights_ / static_cast<double>(frames_); }

  /// The columns of grseg-micro from area_S or volume_S on, and their values in a layer or in the
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
  /// 1 if a contact slides, else 0; NaN if friction is unknown.
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
  // Sums by layer; their `content` stays 0, because composition_ has it.
  std::vector<StructureSums<D>> sums_;
  BedHeights heights_{0, 0, 0};  // sums of heights over frames, m
};

/// The sums of a map's cell, and fields for pictures: contacts per grain, mean normal force, and
/// the shares of sliding and of mixed contacts.
template <int D>
std::vector<Cell> map_cells(const StructureSums<D>& sums);

}  // namespace grseg
