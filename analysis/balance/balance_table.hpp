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

/// The columns of grseg-balance after the key columns, X = S, L (other than two species by their
/// names), a = x, y (z in three dimensions):
///   rho_X jx_X jy_X           density and momentum density
///   Sc_X_xx, _xy, _yx, _yy    contact stress
///   Sk_X_xx, _xy, _yy         kinetic stress about the mean velocity of all species in the layer
///                             and window; xx contains the mean shear within the layer
///   rate_X_a ... residual_X_a terms of the balance (momentum_balance.hpp) and what they leave
///   change_X_a                what the rates sample
///   phi_L ... drag_rate       driving_forces.hpp, of two species
/// Without a layer the names alone count.
template <int D>
std::vector<Cell> balance_cells(const MomentumBalance<D>& balance, const SpeciesList& species,
                                std::optional<std::size_t> layer);

/// The columns that --partition adds behind them. For each RULE, as it is typed, and X, a as above
///   contact_X_a@RULE, interaction_X_a@RULE            C and beta (momentum_balance.hpp)
///   psi_L@RULE, B@RULE, push@RULE, spread@RULE, drag@RULE   of two species (driving_forces.hpp)
/// and once
///   N_X_a        the contact force on the grains of X, which is C + beta + base under every rule
///   p_zero       of two species: p*, the share at which the contact push changes its sign
template <int D>
std::vector<Cell> partition_cells(const MomentumBalance<D>& balance,
                                  const PartitionedBalance<D>& contacts, const SpeciesList& species,
                                  std::optional<std::size_t> layer);

/// A mean over windows with its standard error, windows taken as independent; NaN where there are
/// too few, or nothing moves: windows that agree to a millionth are one observation.
struct MeanOfWindows {
  double mean, error;
};
MeanOfWindows mean_of_windows(const std::vector<double>& values);
/// The kind of the errors of such means, in words: "standard errors over 8 windows".
std::string errors_over(const std::vector<double>& values);

/// Which layers of a window lie inside the bed: at least two large diameters away from the base and
/// from the surface, which lies at twice the mean height of the mass.
template <int D>
std::vector<std::size_t> layers_inside(const MomentumBalance<D>& window, const Layers& layers,
                                       double large_diameter);

/// The balances of a run in words: which way each mechanism pushes the large grains, under each
/// partition rule and with mixed contacts cut at the contact point, and how well the balances
/// close. Forces are along y in units of the large grains' weight, upward positive, from the layers
/// inside the bed (layers_inside); they are summed over layers before they are divided. Errors are
/// standard errors over windows, taken as independent. Where species are not two, only how well
/// they close is given.
template <int D>
class BalanceSummary {
 public:
  /// Diameter in m.
  BalanceSummary(const Layers& layers, double large_diameter,
                 std::vector<PartitionRule> rules = {});

  /// `contacts`: where there are rules.
  void add(const MomentumBalance<D>& window, const PartitionedBalance<D>* contacts = nullptr);

  /// Without a full stop. Mechanisms are left out unless two windows or more hold both species
  /// inside.
  std::string sentence() const;
  /// A line for each rule, with what they have in common above and below.
  std::string text() const;
  /// The table as JSON, with the same numbers as its "summary".
  std::string to_json(const Table& table) const;

 private:
  /// The forces in one window.
  struct Forces {
    struct OfRule {
      double contact = 0, interaction = 0, push = 0, drag = 0;  // contact: divergence of stress C
      static constexpr auto members =
          std::tuple(&OfRule::contact, &OfRule::interaction, &OfRule::push, &OfRule::drag);
    };
    double push = 0, push_kinetic = 0, drag = 0;
    double contact = 0;  // N
    PushOverShare over_share = {};
    std::vector<OfRule> of_rules = {};
    static constexpr auto members =
        std::tuple(&Forces::push, &Forces::push_kinetic, &Forces::drag, &Forces::contact,
                   &Forces::over_share, &Forces::of_rules);
  };
  using OfRule = typename Forces::OfRule;

  void add_residuals(const MomentumBalance<D>& window);
  void add_differences(const MomentumBalance<D>& window, const PartitionedBalance<D>& contacts);
  /// A number of each window, and of a rule.
  template <class Of>
  std::vector<double> series(const Of& of) const;
  std::vector<double> series(std::size_t rule, double OfRule::*place) const;
  /// The share p* at which the push is 0, (sum of none)/(sum of none - all) over windows, with its
  /// error.
  MeanOfWindows zero() const;

  Layers layers_;
  double large_diameter_;
  std::vector<PartitionRule> rules_;
  double residual_ = 0;     // largest of a species in a layer, over the largest term of its balance
  double difference_ = 0;   // largest of C + beta + base between rules, over their largest term
  double from_forces_ = 0;  // likewise of N from what the grains' stored forces less weight say
  std::vector<Forces> windows_;
};

}  // namespace grseg
