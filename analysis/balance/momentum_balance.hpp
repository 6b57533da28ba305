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

/// Coarse-grained fields of one species in one layer, averaged over the layer and over frames.
template <int D>
struct SpeciesMomentum {
  double density = 0;  // mass density, kg/m^2 or kg/m^3
  double content = 0;  // solid fraction, or `density` if all grains have one density
  Vector<D> momentum = Vector<D>::Zero();        // momentum density, kg/(m s) or kg/(m^2 s)
  Tensor<D> contact_stress = Tensor<D>::Zero();  // N/m or Pa, positive in compression
  Tensor<D> momentum_flux = Tensor<D>::Zero();   // density of m v (x) v, N/m or Pa

  // Force densities, N/m^2 or N/m^3; `force` has no part in the balance.
  Vector<D> rate = Vector<D>::Zero();         // change of the momentum density in one step, over h
  Vector<D> gravity = Vector<D>::Zero();      // weight
  Vector<D> contact = Vector<D>::Zero();      // -d/dy of the contact stress
  Vector<D> kinetic = Vector<D>::Zero();      // -d/dy of the flux of momentum by moving grains
  Vector<D> interaction = Vector<D>::Zero();  // force of the other species
  Vector<D> base = Vector<D>::Zero();         // force of the base
  Vector<D> force = Vector<D>::Zero();        // the grains' stored forces, equal to rate - kinetic

  /// The rate minus all terms of the balance: round-off.
  Vector<D> residual() const { return rate - (gravity + contact + kinetic + interaction + base); }

  static constexpr auto members = std::tuple(
      &SpeciesMomentum::density, &SpeciesMomentum::content, &SpeciesMomentum::momentum,
      &SpeciesMomentum::contact_stress, &SpeciesMomentum::momentum_flux, &SpeciesMomentum::rate,
      &SpeciesMomentum::gravity, &SpeciesMomentum::contact, &SpeciesMomentum::kinetic,
      &SpeciesMomentum::interaction, &SpeciesMomentum::base, &SpeciesMomentum::force);
};

/// Momentum balance of each species by coarse graining over height (Goldhirsch 2010; Weinhart et
/// al. 2012; for species Tunuguntla, Thornton & Weinhart 2016). S(y') is the integral over the
/// layer of the kernel about height y' (share_kernel). A grain has the stored height y_i
/// (mid-step), the velocities v_before and v before and after the solve, and the stored force F = m
/// (v - v_before)/h. A contact has the force f_ij and the height c of its contact point. The terms,
/// each divided by V, are
///
///   rate         sum (m/h) [v S(y_i + h v_y) - v_before S(y_i)]
///   gravity      sum m g S(y_i)
///   contact      sum f_ij [S(y_i) - S(c)]              over all contacts
///   kinetic      sum (m/h) v [S(y_i + h v_y) - S(y_i)]
///   interaction  sum f_ij S(c)                         over contacts with the other species
///   base         sum f_ij S(c)                         over contacts with the base
///
/// The base is what does not belong to the bed: boundary grains, walls, and grains that have left
/// the bed (grains_below.hpp).
///
///   rate = gravity + contact + kinetic + interaction + base
///
/// to round-off in every frame, because F = m g + sum f_ij for every grain, and the forces between
/// two grains of one species cancel at c. The step reaches from just before the impulses of this
/// mid-step to just before the impulses of the next one, h later. Grains fly straight in between,
/// so nothing is neglected. `contact` is exactly the flux in at the bottom of the layer minus the
/// flux out at its top, for the contact stress f_ij (x) (r_i - c_ij) on the line from r_i to c_ij.
/// `kinetic` is this difference for the mean of sum m v v_y psi over the flight, which differs by
/// O(h) from `momentum_flux` at the beginning of the flight.
///
/// Over frames of consecutive steps the rates add up to the change of momentum. For frames further
/// apart they are a sample, whose expectation is change().
template <int D>
class MomentumBalance {
 public:
  /// `gravity` in m/s^2, `step` h in s.
  MomentumBalance(const Layers& layers, const Kernel& kernel, const Gravity<D>& gravity,
                  double step, std::size_t species = 2);

  /// Adds a frame with velocities, forces and contacts. Frames must be added in order of time.
  void add(const Grains& grains, const Frame<D>& frame);
  /// Adds the frames of `later`, which must be later than all frames here.
  void merge(const MomentumBalance& later);

  std::size_t layers() const { return sums_.size(); }
  std::size_t species() const { return species_; }
  SpeciesMomentum<D> mean(std::size_t layer, Species species) const;
  /// Change of the momentum density from the first to the last frame, divided by the time between
  /// them, N/m^2 or N/m^3. NaN for a single frame, or if grains entered or left the run in between,
  /// because they change the momentum.
  Vector<D> change(std::size_t layer, Species species) const;

 private:
  /// Momentum just before the impulses of one frame, kg m/s, by layer and species.
  struct Instant {
    double time;           // time of the frame, s
    std::uint64_t grains;  // value of which_are_absent(), to compare the grains of frames
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
  std::optional<bool> one_density_;  // true if all grains have one density; set by the first frame
  std::vector<std::vector<SpeciesMomentum<D>>> sums_;  // by layer, then species; times V
  std::optional<Instant> first_, last_;
  bool same_grains_ = true;      // true if all frames have the same grains
  std::vector<Vector<D>> pull_;  // sum of the contact forces on each grain of the frame, N
};

/// Forces and stress of the contacts of one species in one layer under a partition rule, averaged
/// over the layer and over frames. Force densities are in N/m^2 or N/m^3, stress in N/m or Pa,
/// positive in compression.
template <int D>
struct PartitionedForces {
  Tensor<D> stress = Tensor<D>::Zero();
  Vector<D> contact = Vector<D>::Zero();      // C = -d/dy of `stress`
  Vector<D> interaction = Vector<D>::Zero();  // force beta of the other species
  Vector<D> base = Vector<D>::Zero();         // force of the base; for any rule

  static constexpr auto members =
      std::tuple(&PartitionedForces::stress, &PartitionedForces::contact,
                 &PartitionedForces::interaction, &PartitionedForces::base);
  /// Contact force N, the same under every rule to round-off.
  Vector<D> sum() const { return contact + interaction + base; }
};

/// The contact forces on each species under several partition rules. A rule cuts the branch of a
/// mixed contact: if p is the share of the larger grain (of the species of larger diameter), the
/// cut is at p times the branch from that grain's centre. On this side of the cut the contact adds
/// to the stress of the larger grain's species, on the other side to the stress of the smaller
/// one's species. At the cut the two species act on each other. S(y') is defined in
/// MomentumBalance, y_i is the height of grain i, c the height of the cut, and f_ij the force on i.
/// Divided by V, the sums are
///
///   contact      C    = sum f_ij [S(y_i) - S(c)]   = -d/dy of the species' stress, exactly
///   interaction  beta = sum f_ij S(c)              over contacts with the other species
///   base              = sum f_ij S(c)              over contacts with the boundary; c: height of
///                                                  the contact point, under any rule
///   C + beta + base   = N = sum f_ij S(y_i)
///
/// N is the contact force on the species' grains, each added at the height of its own centre. In a
/// steady flow it is minus their weight plus the divergence d/dy K of their kinetic stress. N does
/// not depend on the rule: a rule is a gauge, which moves stress into interaction and back. Under
/// `drop` a mixed contact is cut at both centres, so that it is interaction only.
template <int D>
class PartitionedBalance {
 public:
  PartitionedBalance(const Layers& layers, const Kernel& kernel, std::vector<PartitionRule> rules,
                     std::size_t species = 2);

  /// Adds a frame with contacts, in any order. Without rules nothing is summed.
  void add(const Grains& grains, const Frame<D>& frame);
  void merge(const PartitionedBalance& others);

  std::size_t layers() const { return sums_.size(); }
  std::size_t species() const { return species_; }
  const std::vector<PartitionRule>& rules() const { return rules_; }

  /// Forces and stress under the rule rules()[rule].
  PartitionedForces<D> mean(std::size_t layer, Species species, std::size_t rule) const;
  /// Contact force N, summed directly over grains, N/m^2 or N/m^3.
  Vector<D> contact_force(std::size_t layer, Species species) const;
  /// Stress of contacts within the species and with the base, which does not depend on the rule.
  Tensor<D> unmixed_stress(std::size_t layer, Species species) const;
  /// Stress of the whole branches of all mixed contacts.
  Tensor<D> mixed_stress(std::size_t layer) const;

 private:
  /// Sums of one layer over frames, times V.
  struct LayerSums {
    std::vector<PartitionedForces<D>> unmixed;  // contacts within a species or with the base
    std::vector<Vector<D>> at_centre;           // contact forces N, by species
    std::vector<PartitionedForces<D>> mixed;    // mixed contacts, by rule, then species
    Tensor<D> whole = Tensor<D>::Zero();        // stress of mixed contacts
    static constexpr auto members = std::tuple(&LayerSums::unmixed, &LayerSums::at_centre,
                                               &LayerSums::mixed, &LayerSums::whole);
  };
  /// A contact between two species.
  struct Mixed {
    MixedContact radii;
    Vector<D> force;           // force on the larger grain, N
    Tensor<D> stress;          // force (x) branch, N m
    std::size_t large, small;  // species of the grains
    double y_large, y_small;   // heights of the centres, m
    double rise;               // height of the larger grain's centre above the smaller's, m
  };

  void grow_to(std::size_t layers);
  void add_mixed(const Mixed& contact);
  double per_frame_and_volume(std::size_t layer) const;

  Layers layers_;
  Kernel kernel_;
  std::vector<PartitionRule> rules_;
  std::size_t species_;
  std::size_t frames_ = 0;
  std::size_t count_ = 0;  // number of layers of the frame that is being added
  std::vector<LayerSums> sums_;
};

}  // namespace grseg
