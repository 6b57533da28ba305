// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/frames/coarse_graining.hpp"
#include "analysis/frames/layers.hpp"
#include "analysis/frames/sums.hpp"
#include "analysis/stress/partition_rule.hpp"
#include "formats/core/frame.hpp"

#include <tuple>
#include <vector>

namespace grseg {

/// What a partition rule makes of the contacts of one species in one layer; means over the layer and
/// over frames. Force densities N/m^2 or N/m^3, stress N/m or Pa, compression positive.
template <int D>
struct PartitionedForces {
  Tensor<D> stress = Tensor<D>::Zero();
  Vector<D> contact = Vector<D>::Zero();      // C = -d/dy of that stress
  Vector<D> interaction = Vector<D>::Zero();  // beta, from the other species
  Vector<D> base = Vector<D>::Zero();         // from boundary grains and walls, under any rule

  static constexpr auto members =
      std::tuple(&PartitionedForces::stress, &PartitionedForces::contact,
                 &PartitionedForces::interaction, &PartitionedForces::base);
  /// N: the same under every rule, to round-off.
  Vector<D> sum() const { return contact + interaction + base; }
};

/// The contact forces on each species under several partition rules. A rule cuts the branch of a
/// mixed contact: with the share p of the larger grain (of the species of larger diameter) the cut
/// is p of the branch away from that grain's centre. Up to the cut the contact is a stress of the
/// larger grain's species, from there on one of the smaller grain's, and at the cut the two species
/// act on each other. With S(y') as in MomentumBalance, y_i the height of a grain, c that of the cut
/// and f_ij the force on i, sums over V:
///
///   contact      C    = sum f_ij [S(y_i) - S(c)]   = -d/dy of the species' stress, exactly
///   interaction  beta = sum f_ij S(c)              over contacts with the other species
///   base              = sum f_ij S(c)              over contacts with the boundary, c where they
///                                                  touch, under any rule
///   C + beta + base   = N = sum f_ij S(y_i)
///
/// N is the contact force on the species' grains, each booked at its own centre; in a steady flow minus
/// their weight plus the divergence d/dy K of their kinetic stress. The rule is not in
/// it: a rule is a gauge, which moves stress into interaction and back. Under `drop` both grains are
/// cut at their own centres, so that mixed contacts are interaction alone.
template <int D>
class PartitionedBalance {
 public:
  PartitionedBalance(const Layers& layers, const Kernel& kernel, std::vector<PartitionRule> rules,
                     std::size_t species = 2);

  /// Frames with contacts, in any order. Without rules nothing is summed.
  void add(const Grains& grains, const Frame<D>& frame);
  void merge(const PartitionedBalance& others);

  std::size_t layers() const { return sums_.size(); }
  std::size_t species() const { return species_; }
  const std::vector<PartitionRule>& rules() const { return rules_; }

  /// Under the rule number `rule`.
  PartitionedForces<D> mean(std::size_t layer, Species species, std::size_t rule) const;
  /// N, summed over grains and not from its parts.
  Vector<D> contact_force(std::size_t layer, Species species) const;
  /// Stress of the contacts of the species with its own kind and with the base: no rule touches it.
  Tensor<D> unmixed_stress(std::size_t layer, Species species) const;
  /// Stress of all mixed contacts, their whole branches.
  Tensor<D> mixed_stress(std::size_t layer) const;

 private:
  struct LayerSums {                            // times V
    std::vector<PartitionedForces<D>> unmixed;  // by species
    std::vector<Vector<D>> at_centre;           // by species
    std::vector<PartitionedForces<D>> mixed;    // by rule and species
    Tensor<D> whole = Tensor<D>::Zero();        // of mixed contacts
    static constexpr auto members = std::tuple(&LayerSums::unmixed, &LayerSums::at_centre,
                                               &LayerSums::mixed, &LayerSums::whole);
  };
  /// A contact between two species, seen from its larger grain.
  struct Mixed {
    MixedContact radii;
    Vector<D> force;           // N, on the larger grain
    Tensor<D> stress;          // N m, force (x) branch
    std::size_t large, small;  // species
    double y_large, y_small;   // m, of the centres
    double rise;               // m, of the branch from the smaller grain's centre to the larger's
  };

  void grow_to(std::size_t layers);
  void add_mixed(const Mixed& contact);
  double per_frame_and_volume(std::size_t layer) const;

  Layers layers_;
  Kernel kernel_;
  std::vector<PartitionRule> rules_;
  std::size_t species_;
  std::size_t frames_ = 0;
  std::size_t count_ = 0;  // layers of the frame that is being added
  std::vector<LayerSums> sums_;
};

}  // namespace grseg
