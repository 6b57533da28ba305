// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/frames/coarse_graining.hpp"
#include "analysis/frames/layers.hpp"
#include "analysis/stress/partition.hpp"
#include "formats/core/frame.hpp"
#include "formats/core/pair_type.hpp"

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace grseg {

/// In which layer a contact, or a grain's part of it, is booked.
enum class Assignment {
  contact_point,  ///< all of it where the two grains touch
  branch,         ///< spread evenly over the branch: every layer gets the length that lies in it
  kernel,         ///< spread along the branch by a coarse-graining kernel (coarse_graining.hpp)
  grain,          ///< each grain's part at the height of its own centre
};

/// Contact stress by layer: sigma = (1/V) sum force (x) branch (Rothenburg & Selvadurai 1981;
/// Staron & Phillips 2015, eq. 1), kept apart by pair type, so that every rule of partition is
/// algebra on these sums (partition.hpp). N m, compression positive, not divided by V, means per
/// frame.
///
/// Only contacts that carry a force count, in n_* too. In annuli components are those along and
/// across the layer where the grains touch, and `branch` and `kernel` do not apply.
///
/// `branch` and `kernel` share out what belongs to one grain along its own stretch of the branch:
/// the large grain's part of a mixed contact (mixed_size, mixed_contact) along that from its centre
/// to r_L/(r_L + r_S) of the branch or to the contact point, base_* along that from the grain's
/// centre to the contact point (the boundary rule of Weinhart et al. 2012). mixed_power is a weight
/// times the whole branch's share of the layer. Under a kernel a row is the integral of the field
/// over the layer: sum/V is the field's mean there.
///
/// `grain` books either grain's part of equal grains (cut at the contact point) and of mixed ones
/// (cut by size, so that `mixed` less `mixed_size` is the small grain's part, at its centre) where
/// that grain is; mixed_contact, mixed_power where the large grain is; at_centres is for rules
/// whose share is the same for all contacts.
class PartialContactStress {
 public:
  /// Of one layer.
  struct Mean {
    std::array<double, pair_types> contacts{};  // by PairType, booked at the contact point
    ContactSums sums;  // without volume and areas; at_centres only with Assignment::grain
  };

  /// With `power` Q, mixed_power takes the share r_L^Q/(r_L^Q + r_S^Q). `kernel` belongs to
  /// Assignment::kernel.
  PartialContactStress(const Layers& layers, Assignment assignment,
                       std::optional<double> power = std::nullopt,
                       std::optional<Kernel> kernel = std::nullopt);

  void add(const Grains& grains, const Frame& frame);
  void merge(const PartialContactStress& others);
  std::size_t layers() const { return sums_.size(); }
  Mean mean(std::size_t layer) const;

  /// The columns of grseg-stress from n_SS on, and a layer's numbers under them.
  std::vector<std::string> columns() const;
  std::vector<double> row(std::size_t layer) const;

 private:
  enum Part { A_SS, A_LL, M, Msize, Mcp, Mpower, HSS, HLL, ML, MS, A_Sb, A_Lb, F_Sb, F_Lb };
  static constexpr std::size_t parts = 14;
  struct Sums {
    std::array<double, pair_types> contacts{};
    std::array<Tensor2, parts> tensor;
    Sums() { tensor.fill(Tensor2::Zero()); }
    Sums& operator+=(const Sums& others);
  };
  /// A stretch of the branch: `weight` of the contact's force (x) branch, beginning at the grain it
  /// belongs to. Heights, m.
  struct Stretch {
    double from, to, weight;
  };
  /// What all stretches of a contact share.
  struct Contact {
    Tensor2 stress;     // N m, force (x) branch
    std::size_t layer;  // of the contact point
  };

  void book(Part part, const Contact& contact, const Stretch& stretch);
  void add_equal(Species species, const Contact& contact, double y_i, double y_j, double share_i);
  void add_mixed(const Contact& contact, double y_large, double y_small, double by_size,
                 double by_contact);

  Layers layers_;
  Assignment assignment_;
  std::optional<double> power_;
  std::optional<Kernel> kernel_;
  std::size_t frames_ = 0;
  std::size_t count_ = 0;  // layers of the frame that is being added
  std::vector<Sums> sums_;
};

}  // namespace grseg
