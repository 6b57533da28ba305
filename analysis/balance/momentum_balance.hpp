// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/frames/coarse_graining.hpp"
#include "analysis/frames/layers.hpp"
#include "analysis/frames/sums.hpp"
#include "analysis/stress/partition_rule.hpp"
#include "formats/core/frame.hpp"

#include <optional>
#include <tuple>
#include <vector>

namespace grseg {

/// Coarse-grained fields of one species in one layer: means over the layer and over frames. The
/// force densities, N/m^2 or N/m^3, change its momentum density.
template <int D>
struct SpeciesMomentum {
  double density = 0;  // kg/m^2 or kg/m^3
  double content = 0;  // solid fraction, times a density where all grains have it
  Vector<D> momentum = Vector<D>::Zero();        // kg/(m s) or kg/(m^2 s)
  Tensor<D> contact_stress = Tensor<D>::Zero();  // N/m or Pa, compression positive
  Tensor<D> momentum_flux = Tensor<D>::Zero();   // N/m or Pa, m v (x) v

  Vector<D> rate = Vector<D>::Zero();         // change of the momentum density in one step, over h
  Vector<D> gravity = Vector<D>::Zero();      // its weight
  Vector<D> contact = Vector<D>::Zero();      // -d/dy of its contact stress
  Vector<D> kinetic = Vector<D>::Zero();      // -d/dy of the momentum that its moving grains carry
  Vector<D> interaction = Vector<D>::Zero();  // from the other species
  Vector<D> base = Vector<D>::Zero();         // from boundary grains and walls
  Vector<D> force = Vector<D>::Zero();        // the stored forces of its grains; rate - kinetic

  /// The rate less all terms: round-off.
  Vector<D> residual() const { return rate - (gravity + contact + kinetic + interaction + base); }

  static constexpr auto members = std::tuple(
      &SpeciesMomentum::density, &SpeciesMomentum::content, &SpeciesMomentum::momentum,
      &SpeciesMomentum::contact_stress, &SpeciesMomentum::momentum_flux, &SpeciesMomentum::rate,
      &SpeciesMomentum::gravity, &SpeciesMomentum::contact, &SpeciesMomentum::kinetic,
      &SpeciesMomentum::interaction, &SpeciesMomentum::base, &SpeciesMomentum::force);
};

/// Momentum balance of each species by coarse graining over height (Goldhirsch 2010; Weinhart et
/// al. 2012; for species Tunuguntla, Thornton & Weinhart 2016). S(y') is the part of the kernel of
/// a point at height y' that lies in the layer (share_kernel). With y_i the stored height of a
/// grain (mid-step), v its velocity after the solve, v_before its velocity before the solve, F = m
/// (v - v_before)/h its stored force, f_ij a contact force and c the height of its contact point,
/// all sums over V:
///
///   rate         sum (m/h) [v S(y_i + h v_y) - v_before S(y_i)]
///   gravity      sum m g S(y_i)
///   contact      sum f_ij [S(y_i) - S(c)]              over all contacts
///   kinetic      sum (m/h) v [S(y_i + h v_y) - S(y_i)]
///   interaction  sum f_ij S(c)                         over contacts with the other species
///   base         sum f_ij S(c)                         over contacts with the boundary
///
///   rate = gravity + contact + kinetic + interaction + base
///
/// to round-off in every frame: F = m g + sum f_ij for every grain, and at c the forces between two
/// grains of one species cancel. The step reaches from just before the impulses of this mid-step to
/// just before the impulses of the next, h later; in between grains fly straight, so that nothing
/// is neglected. `contact` is exactly the flow in at the bottom of the layer less the flow out at
/// its top, of the contact stress f_ij (x) (r_i - c_ij) on the line from r_i to c_ij, and `kinetic`
/// the same of the mean of sum m v v_y psi over that flight, which differs by O(h) from
/// `momentum_flux` at its beginning.
///
/// Over frames of consecutive steps the rates add up to the change of momentum; over frames further
/// apart they are a sample of it, whose expectation is `change`.
template <int D>
class MomentumBalance {
 public:
  /// Gravity in m/s^2, step h in s.
  MomentumBalance(const Layers& layers, const Kernel& kernel, const Gravity<D>& gravity,
                  double step, std::size_t species = 2);

  /// Frames come in order of time, with velocities, forces and contacts.
  void add(const Grains& grains, const Frame<D>& frame);
  /// Adds the frames of `later`, which come after those here.
  void merge(const MomentumBalance& later);

  std::size_t layers() const { return sums_.size(); }
  std::size_t species() const { return species_; }
  SpeciesMomentum<D> mean(std::size_t layer, Species species) const;
  /// Change of the momentum density from the first frame to the last over the time between them,
  /// N/m^2 or N/m^3; NaN of a single frame, and where grains came or went in between, since they
  /// bring momentum or take it.
  Vector<D> change(std::size_t layer, Species species) const;

 private:
  /// Momentum just before the impulses of one frame, kg m/s, by layer and species.
  struct Instant {
    double time;           // s
    std::uint64_t grains;  // which_are_absent()
    std::vector<std::vector<Vector<D>>> momentum;
    Vector<D> at(std::size_t layer, Species species) const;
  };

  void add_contact(const Grains& grains, const Frame<D>& frame, std::size_t contact,
                   std::size_t count);
  void add_stress(Species species, const Tensor<D>& force_by_arm, double from, double to,
                  std::size_t count);
  void add_grain(const Grains& grains, const Frame<D>& frame, std::size_t grain,
                 const Vector<D>& gravity, Instant& before);

  Layers layers_;
  Kernel kernel_;
  Gravity<D> gravity_;
  double step_;
  std::size_t species_;
  std::size_t frames_ = 0;
  std::optional<bool> one_density_;                    // of all grains, once some are added
  std::vector<std::vector<SpeciesMomentum<D>>> sums_;  // by layer and species, times V
  std::optional<Instant> first_, last_;
  bool same_grains_ = true;      // in all frames
  std::vector<Vector<D>> pull_;  // N, sum of all contact forces on each grain of this frame
};

/// Forces and stress of the contacts of one species in one layer under a partition rule; means over
/// the layer and over frames. Force densities N/m^2 or N/m^3, stress N/m or Pa, compression
/// positive.
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
/// act on each other. With S(y') as in MomentumBalance, y_i the height of a grain, c the height of
/// the cut and f_ij the force on i, sums over V:
///
///   contact      C    = sum f_ij [S(y_i) - S(c)]   = -d/dy of the species' stress, exactly
///   interaction  beta = sum f_ij S(c)              over contacts with the other species
///   base              = sum f_ij S(c)              over contacts with the boundary, c where they
///                                                  touch, under any rule
///   C + beta + base   = N = sum f_ij S(y_i)
///
/// N is the contact force on the species' grains, each booked at its own centre; in a steady flow
/// minus their weight plus the divergence d/dy K of their kinetic stress. The rule is not in it: a
/// rule is a gauge, which moves stress into interaction and back. Under `drop` both grains are cut
/// at their own centres, so that mixed contacts are interaction alone.
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
