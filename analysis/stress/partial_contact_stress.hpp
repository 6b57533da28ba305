// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/frames/coarse_graining.hpp"
#include "analysis/frames/composition.hpp"
#include "analysis/frames/frame_loop.hpp"
#include "analysis/frames/layers.hpp"
#include "analysis/stress/contact_sums.hpp"
#include "analysis/stress/partition_rule.hpp"
#include "formats/cli/tool.hpp"
#include "formats/core/frame.hpp"
#include "formats/core/length.hpp"

#include <optional>
#include <string>
#include <vector>

namespace grseg {

/// Layer to which the stress of a contact is added.
enum class Assignment {
  contact_point,  ///< the layer of the contact point
  branch,         ///< all layers along the branch, in proportion to its length in each
  kernel,         ///< spread along the branch by a coarse-graining kernel (coarse_graining.hpp)
  grain,          ///< each grain's part of the stress in the layer of its own centre
};

/// Contact stress by layer: sigma = (1/V) sum force (x) branch (Rothenburg & Selvadurai 1981;
/// Staron & Phillips 2015, eq. 1). Sums are separate by species and pair of species, so that every
/// partition rule is algebra on them (partial_stress.hpp). They are in N m, positive in
/// compression, not divided by V, and averaged over frames.
///
/// Contacts without a force are ignored, also in the numbers n_*. In annuli, components are along
/// and across the layer at the contact point. `branch` and `kernel` apply neither to annuli nor to
/// maps.
///
/// `branch` and `kernel` spread the part of one grain along its own stretch of the branch. The
/// larger grain's part of a mixed contact reaches from its centre to r_L/(r_L + r_S) of the branch
/// (by_size) or to the contact point (up_to_contact). `base` reaches from the grain's centre to the
/// contact point (the boundary rule of Weinhart et al. 2012). by_power is spread along the whole
/// branch. With a kernel, a row is the integral of the field over the layer, and sum/V its mean.
///
/// `grain` adds each grain's part to the layer of that grain. Contacts of equal grains are cut at
/// the contact point, mixed contacts by size, so that `whole` - `by_size` is the part of smaller
/// grains. up_to_contact and by_power are added to the layer of the larger grain. halves, at_larger
/// and at_smaller are for rules with one share for all contacts.
template <int D>
class PartialContactStress {
 public:
  /// Sums of one layer.
  struct Mean {
    std::vector<double> contacts;  // numbers by contact_index(), in the layer of the contact point
    ContactSums<D> sums;           // without volume and content; at_centres, halves, at_larger and
                                   // at_smaller only with Assignment::grain
  };

  /// `power` is the Q of by_power, which is summed only with it. `kernel` is required for
  /// Assignment::kernel.
  PartialContactStress(const Layers& layers, Assignment assignment,
                       std::optional<double> power = std::nullopt,
                       std::optional<Kernel> kernel = std::nullopt, std::size_t species = 2);

  void add(const Grains& grains, const Frame<D>& frame);
  void merge(const PartialContactStress& others);
  std::size_t layers() const { return sums_.size() / sums_of_layer(); }
  Mean mean(std::size_t layer) const;

  /// The columns of grseg-stress after the contents, and the numbers of a layer in them.
  std::vector<std::string> columns(const SpeciesList& species) const;
  std::vector<double> row(std::size_t layer) const;

 private:
  /// A rule whose share differs by contact, and the number in its name, such as Q of power:Q.
  struct SummedRule {
    const RuleDefinition* definition;
    double number;
  };
  /// A stretch of the branch from height `from` to height `to`, m, which begins at the centre of
  /// its grain. Its stress is `weight` times the contact's force (x) branch.
  struct Stretch {
    double from, to, weight;
    std::size_t layer;  // layer of its grain; only for Assignment::grain
  };
  /// One grain of a contact.
  struct End {
    double y;           // height of its centre, m
    std::size_t layer;  // layer of its centre; only for Assignment::grain
  };
  /// Properties common to all stretches of a contact.
  struct Contact {
    Tensor<D> stress;   // force (x) branch, N m
    std::size_t layer;  // layer of the contact point
  };

  static std::vector<SummedRule> summed_rules(std::optional<double> power);
  // Places of the sums of a layer: first by species, then by pair.
  std::size_t sums_of_layer() const
  {
    return species_ * own_sums + number_of_pairs(species_) * pair_sums;
  }
  std::size_t contacts_of_layer() const { return base_contact_index(species_, species_); }
  std::size_t place(OwnSum sum, std::size_t species) const
  {
    return species * own_sums + static_cast<std::size_t>(sum);
  }
  std::size_t place(PairSum sum, std::size_t pair) const
  {
    return species_ * own_sums + pair * pair_sums + static_cast<std::size_t>(sum);
  }
  void grow_to(std::size_t layers);
  TableKind table_kind() const;
  template <class Sum>
  void add_stretch(Sum sum, std::size_t index, const Contact& contact, const Stretch& stretch);
  End end(const Vector<D>& position) const;
  void add_equal(std::size_t species, const Contact& contact, const End& i, const End& j,
                 double share_i);
  void add_mixed(std::size_t pair, const Contact& contact, const MixedContact& radii,
                 const End& large, const End& small);

  Layers layers_;
  Assignment assignment_;
  std::optional<double> power_;
  std::vector<SummedRule> rules_;
  std::optional<Kernel> kernel_;
  std::size_t species_;
  std::size_t frames_ = 0;
  std::size_t count_ = 0;         // number of layers of the frame that is being added
  std::vector<Tensor<D>> sums_;   // by layer, then by place()
  std::vector<double> contacts_;  // numbers of contacts by layer, then by contact_index()
};

/// How the stress of contacts and the area of grains are divided among layers.
struct ContactAssignment {
  Assignment assignment;
  GrainArea area;
};

/// The options from which a ContactAssignment follows.
struct ContactAssignmentOptions {
  std::string assign = "contact-point", width = "1dS", composition;

  /// Adds --assign --kernel-width --composition.
  void add_to(po::options_description& options);
  /// If --composition was not given, sets `composition` to "kernel" for a kernel, else to
  /// `otherwise`. Throws UsageError for an unknown word, or a width without a kernel.
  ContactAssignment contact_assignment(const po::variables_map& values,
                                       const std::string& otherwise = "clipped");
  /// Throws UsageError if the assignment does not apply to annuli or to the cells of a map.
  void require_bins(const ContactAssignment& chosen, const FrameOptions& frames) const;
  /// The kernel of `chosen`, if it has one. Throws UsageError if --kernel-width is not a length.
  std::optional<Kernel> kernel(const ContactAssignment& chosen, const LengthUnits& units) const;
};

}  // namespace grseg
