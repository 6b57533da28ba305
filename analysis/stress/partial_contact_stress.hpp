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

/// To which layer a contact, or a grain's part of it, counts.
enum class Assignment {
  contact_point,  ///< all of it where the two grains touch
  branch,         ///< spread evenly over the branch: every layer gets the length that lies in it
  kernel,         ///< spread along the branch by a coarse-graining kernel (coarse_graining.hpp)
  grain,          ///< each grain's part at the height of its own centre
};

/// Contact stress by layer: sigma = (1/V) sum force (x) branch (Rothenburg & Selvadurai 1981;
/// Staron & Phillips 2015, eq. 1), kept apart by species and pair of species, so that every rule of
/// partition is algebra on these sums (partial_stress.hpp). N m, compression positive, not divided
/// by V, means per frame.
///
/// Only contacts that carry a force count, in n_* too. In annuli components are those along and
/// across the layer where the grains touch, and `branch` and `kernel` do not apply; nor do they to
/// maps.
///
/// `branch` and `kernel` spread what belongs to one grain along its own stretch of the branch: the
/// larger grain's part of a mixed contact (by_size, up_to_contact) from its centre to r_L/(r_L +
/// r_S) of the branch or to the contact point, base from the grain's centre to the contact point
/// (the boundary rule of Weinhart et al. 2012). by_power is a weight times the whole branch's share
/// of the layer. Under a kernel a row is the integral of the field over the layer: sum/V is the
/// field's mean there.
///
/// `grain` counts either grain's part of equal grains (cut at the contact point) and of mixed ones
/// (cut by size, so that `whole` less `by_size` is the smaller grain's part, at its centre) in the
/// layer of that grain; up_to_contact and by_power in the layer of the larger grain; halves,
/// at_larger and at_smaller are for rules whose share is the same for all contacts.
template <int D>
class PartialContactStress {
 public:
  /// Sums of one layer.
  struct Mean {
    std::vector<double> contacts;  // by contact_index, in the layer of the contact point
    ContactSums<D> sums;           // without volume and contents; at the centres only with
                                   // Assignment::grain
  };

  /// `power` is the Q of by_power, which is not summed without it. `kernel` belongs to
  /// Assignment::kernel.
  PartialContactStress(const Layers& layers, Assignment assignment,
                       std::optional<double> power = std::nullopt,
                       std::optional<Kernel> kernel = std::nullopt, std::size_t species = 2);

  void add(const Grains& grains, const Frame<D>& frame);
  void merge(const PartialContactStress& others);
  std::size_t layers() const { return sums_.size() / sums_of_layer(); }
  Mean mean(std::size_t layer) const;

  /// The columns of grseg-stress behind the contents, and a layer's numbers under them.
  std::vector<std::string> columns(const SpeciesList& species) const;
  std::vector<double> row(std::size_t layer) const;

 private:
  /// A rule whose share is summed contact by contact, and the number behind its name.
  struct SummedRule {
    const RuleDefinition* definition;
    double number;
  };
  /// A stretch of the branch: `weight` of the contact's force (x) branch, beginning at the grain it
  /// belongs to. Heights, m.
  struct Stretch {
    double from, to, weight;
    std::size_t layer;  // of its grain, with Assignment::grain
  };
  /// A grain of a contact.
  struct End {
    double y;           // m
    std::size_t layer;  // with Assignment::grain
  };
  /// Properties common to all stretches of a contact.
  struct Contact {
    Tensor<D> stress;   // N m, force (x) branch
    std::size_t layer;  // of the contact point
  };

  static std::vector<SummedRule> summed_rules(std::optional<double> power);
  // Where the numbers of a layer stand, one behind the other.
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
  std::size_t count_ = 0;         // layers of the frame that is being added
  std::vector<Tensor<D>> sums_;   // by layer and place
  std::vector<double> contacts_;  // by layer and contact_index
};

/// To which layer contacts and grains count, as given on the command line.
struct ContactAssignment {
  Assignment assignment;
  std::optional<KernelShape> shape;  // where the assignment is a kernel
  GrainArea area;
};

/// The options from which a ContactAssignment follows.
struct ContactAssignmentOptions {
  std::string assign = "contact-point", width = "1dS", composition;

  /// Adds --assign --kernel-width --composition.
  void add_to(po::options_description& options);
  /// UsageError for an unknown word, or a width without a kernel. Sets `composition` to what
  /// follows from `assign`, or to `otherwise`, where it was not given.
  ContactAssignment contact_assignment(const po::variables_map& values,
                                       const std::string& otherwise = "clipped");
  /// UsageError where it spreads over layers what annuli or the cells of a map do not share.
  void require_bins(const ContactAssignment& chosen, const FrameOptions& frames) const;
  /// The kernel of `contact_assignment`, if it has one; UsageError where --kernel-width is not a
  /// length.
  std::optional<Kernel> kernel(const ContactAssignment& chosen, const LengthUnits& units) const;
};

}  // namespace grseg
