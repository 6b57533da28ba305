// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/balance/driving_forces.hpp"
#include "analysis/balance/momentum_balance.hpp"
#include "analysis/frames/sums.hpp"
#include "formats/cli/table.hpp"
#include "formats/core/species.hpp"

#include <nlohmann/json_fwd.hpp>

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace grseg {

/// The columns of grseg-balance after the key columns (formats/cli/columns.tsv), with the numbers of
/// a layer; without a layer only the names matter.
template <int D>
std::vector<Cell> balance_cells(const MomentumBalance<D>& balance, const SpeciesList& species,
                                std::optional<std::size_t> layer);

/// The columns that --partition adds after balance_cells(): columns of each rule, then N and p_zero.
template <int D>
std::vector<Cell> partition_cells(const MomentumBalance<D>& balance,
                                  const PartitionedBalance<D>& contacts, const SpeciesList& species,
                                  std::optional<std::size_t> layer);

/// A mean over windows, and its standard error if windows are independent. NaN: the mean of no
/// windows; the error of one window, or if no grain moves (values that agree to a millionth).
struct MeanOfWindows {
  double mean, error;
};
MeanOfWindows mean_of_windows(const std::vector<double>& values);
/// Description of the errors of MeanOfWindows: "standard errors over 8 windows".
std::string errors_over(const std::vector<double>& values);

/// Numbers of the layers of a window inside the bed: at least two large diameters from the base and
/// from the surface. The surface is at twice the mean height of the mass.
template <int D>
std::vector<std::size_t> layers_inside(const MomentumBalance<D>& window, const Layers& layers,
                                       double large_diameter);

/// Summary of the balances of a run in words: the forces on large grains by mechanism, with mixed
/// contacts cut at the contact point and under each partition rule, and the residual of the
/// balances. Forces are along y, positive upward, in units of the large grains' weight. Both are
/// summed over the layers inside the bed (layers_inside) before division. Errors are standard
/// errors over independent windows. Unless there are two species, it has only the residual.
template <int D>
class BalanceSummary {
 public:
  /// `large_diameter` in m.
  BalanceSummary(const Layers& layers, double large_diameter,
                 std::vector<PartitionRule> rules = {});

  /// Adds a window; `contacts` is required if there are rules.
  void add(const MomentumBalance<D>& window, const PartitionedBalance<D>* contacts = nullptr);

  /// The summary as a sentence without a full stop. It includes the forces only if at least two
  /// windows have both species inside the bed.
  std::string sentence() const;
  /// A line of forces for each rule, between lines that apply to all rules.
  std::string text() const;
  /// The table as JSON, with the numbers of text() as its "summary".
  std::string to_json(const Table& table) const;

 private:
  /// Forces in one window over the weight of large grains.
  struct Forces {
    struct OfRule {
      double contact = 0, interaction = 0, push = 0, drag = 0;  // contact: C = -d/dy of stress
      static constexpr auto members =
          std::tuple(&OfRule::contact, &OfRule::interaction, &OfRule::push, &OfRule::drag);
    };
    double push = 0, push_kinetic = 0, drag = 0;
    double contact = 0;  // contact force N (momentum_balance.hpp)
    PushOverShare over_share = {};
    std::vector<OfRule> of_rules = {};
    static constexpr auto members =
        std::tuple(&Forces::push, &Forces::push_kinetic, &Forces::drag, &Forces::contact,
                   &Forces::over_share, &Forces::of_rules);
  };
  using OfRule = typename Forces::OfRule;

  void add_residuals(const MomentumBalance<D>& window);
  void add_differences(const MomentumBalance<D>& window, const PartitionedBalance<D>& contacts);
  /// One number per window: of(window), or the member `place` of a rule.
  template <class Of>
  std::vector<double> series(const Of& of) const;
  std::vector<double> series(std::size_t rule, double OfRule::*place) const;
  /// The share p* at which the push is 0, (sum of none)/(sum of none - all) over windows
  /// (PushOverShare), with its error.
  MeanOfWindows zero() const;

  Layers layers_;
  double large_diameter_;
  std::vector<PartitionRule> rules_;
  // Largest values over species and layers, each relative to the largest term of its balance.
  double residual_ = 0;     // residual of the balance
  double difference_ = 0;   // |C + beta + base - N| over the rules; must be round-off
  double from_forces_ = 0;  // difference of N from the grains' stored forces less their weight
  std::vector<Forces> windows_;
};

}  // namespace grseg
