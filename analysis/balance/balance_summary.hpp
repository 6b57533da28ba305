// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/balance/driving_forces.hpp"
#include "analysis/balance/momentum_balance.hpp"
#include "analysis/balance/partitioned_balance.hpp"
#include "formats/cli/table.hpp"

#include <nlohmann/json_fwd.hpp>

#include <string>
#include <vector>

namespace grseg {

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

/// The balances of a run in one sentence: which way each mechanism pushes the large grains, in
/// units of their weight, and how well the balances close; mixed contacts are cut at the contact
/// point. The mechanisms are taken inside the bed only (layers_inside). Errors are standard errors
/// over windows, taken as independent. With other than two species only how well they close.
template <int D>
class BalanceSummary {
 public:
  /// Diameter in m.
  BalanceSummary(const Layers& layers, double large_diameter);

  void add(const MomentumBalance<D>& window);

  /// Without a full stop. Mechanisms are left out unless two windows or more hold both species
  /// inside.
  std::string sentence() const;

 private:
  void add_residual(const SpeciesMomentum<D>& own);

  Layers layers_;
  double large_diameter_;
  double residual_ = 0;  // largest of a species in a layer, over the largest term of its balance
  std::vector<double> push_, push_kinetic_, drag_;  // by window, over the weight
};

/// The forces on large grains by each partition rule, beside what no rule changes. Forces are
/// along y in units of the large grains' weight, upward positive, from the layers inside the bed
/// (layers_inside); they are summed over layers before they are divided. Where species are not two,
/// only the difference between rules in N is given.
template <int D>
class PartitionSummary {
 public:
  /// Diameter in m.
  PartitionSummary(const Layers& layers, double large_diameter, std::vector<PartitionRule> rules);

  void add(const MomentumBalance<D>& window, const PartitionedBalance<D>& contacts);

  /// A line for each rule, with what they have in common above and below.
  std::string text() const;
  /// The table as JSON, with the same numbers as its "summary".
  std::string to_json(const Table& table) const;

 private:
  /// By window. Of the rule: its divergence of stress C, interaction beta, push and drag.
  struct OfRule {
    std::vector<double> contact, interaction, push, drag;
  };
  nlohmann::ordered_json json() const;
  void add_difference(const MomentumBalance<D>& window, const PartitionedBalance<D>& contacts);

  Layers layers_;
  double large_diameter_;
  std::vector<PartitionRule> rules_;
  double difference_ = 0;   // largest of C + beta + base between rules, over their largest term
  double from_forces_ = 0;  // likewise of N from what the grains' stored forces less weight say
  std::vector<OfRule> of_rules_;
  std::vector<double> push_kinetic_, contact_force_;
  std::vector<PushOverShare> over_share_;
};

}  // namespace grseg
