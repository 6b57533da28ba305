// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/frames/layers.hpp"
#include "analysis/frames/sums.hpp"
#include "formats/cli/words.hpp"
#include "formats/core/frame.hpp"
#include "formats/core/species.hpp"

#include <array>
#include <string>
#include <tuple>
#include <vector>

namespace grseg {

/// Mean normal force of the contacts with their contact point in a layer, by pair type and over all
/// contacts between mobile grains. Contacts without a force are ignored.
template <int D>
class MeanNormalForce {
 public:
  explicit MeanNormalForce(const Layers& layers) : layers_(layers) {}

  void add(const Grains& grains, const Frame<D>& frame);
  void merge(const MeanNormalForce& others);
  /// Mean normal force, N; NaN without contacts.
  double of(std::size_t layer, PairType type) const;
  /// Mean over the contacts between mobile grains; without them, over the contacts with the base.
  double of_layer(std::size_t layer) const;

 private:
  struct Sum {
    double contacts = 0, force = 0;
    static constexpr auto members = std::tuple(&Sum::contacts, &Sum::force);
  };
  Layers layers_;
  std::vector<std::array<Sum, pair_types>> sums_;
};

/// Mean force <f_n> by which the normal force of a contact is divided.
enum class ForceUnit {
  layer,  ///< MeanNormalForce::of_layer()
  type,   ///< mean over the contacts of the same pair type in the layer
};
inline constexpr Choice<ForceUnit> force_units[] = {{"layer", ForceUnit::layer},
                                                    {"type", ForceUnit::type}};

/// Histogram of x = f_n/<f_n> by pair type: numbers of contacts per frame in bins of x; the last
/// bin has no upper edge, and has also the pushing contacts where the mean is not positive. The frames of a window are read twice, first for the mean, then for the
/// histogram. If 1 is a multiple of the bins' width, a bin begins exactly at 1, so that strong
/// contacts (x > 1, Radjai et al. 1998) have bins of their own.
template <int D>
class ForceDistribution {
 public:
  static constexpr std::size_t bins = 101;

  /// `width` of the bins in units of x, i.e. of the mean force.
  ForceDistribution(const Layers& layers, const MeanNormalForce<D>& mean, ForceUnit unit,
                    double width)
      : layers_(layers), mean_(mean), unit_(unit), width_(width)
  {
  }

  void add(const Grains& grains, const Frame<D>& frame);
  void merge(const ForceDistribution& others);
  std::size_t layers() const { return counts_.size(); }

  /// Columns of a bin (formats/cli/columns.tsv). The sum of P (x1 - x0) is the share of contacts
  /// below the last bin; P is 0 in the last bin. P and tail are NaN without contacts.
  static std::vector<std::string> columns();
  /// One row per bin, for a layer or for the whole bed. In the whole bed, f_n is still divided by
  /// the mean of its own layer.
  std::vector<std::vector<double>> rows(std::size_t layer) const { return rows(counts_[layer]); }
  std::vector<std::vector<double>> bed_rows() const;

 private:
  using Counts = std::array<std::array<double, pair_types>, bins>;
  std::size_t bin_of(double x) const;
  double edge(std::size_t bin) const;
  std::vector<std::vector<double>> rows(const Counts& counts) const;

  Layers layers_;
  MeanNormalForce<D> mean_;
  ForceUnit unit_;
  double width_;
  std::size_t frames_ = 0;
  std::vector<Counts> counts_;
};

}  // namespace grseg
