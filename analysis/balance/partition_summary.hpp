// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/balance/driving_forces.hpp"
#include "analysis/balance/momentum_balance.hpp"
#include "analysis/balance/partitioned_balance.hpp"

#include <string>
#include <vector>

namespace grseg {

/// What each partition rule says of the forces on large grains, beside what it cannot change. Forces
/// along y in units of the large grains' weight, upward positive, from the layers inside the bed
/// (layers_inside); summed over layers before they are divided. Of other than two species only how
/// far rules agree on N.
template <int D>
class PartitionSummary {
 public:
  /// Diameter in m.
  PartitionSummary(const Layers& layers, double large_diameter, std::vector<PartitionRule> rules);

  void add(const MomentumBalance<D>& window, const PartitionedBalance<D>& contacts);

  /// A line for each rule, with what they have in common above and below.
  std::string text() const;
  /// The same numbers as a JSON object.
  std::string to_json() const;

 private:
  /// By window. Of the rule: its divergence of stress C, interaction beta, push and drag.
  struct OfRule {
    std::vector<double> contact, interaction, push, drag;
  };
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
