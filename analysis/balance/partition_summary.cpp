// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/balance/partition_summary.hpp"

#include "analysis/balance/summary.hpp"

#include <fmt/format.h>
#include <gsl/gsl_statistics.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace grseg {
namespace {

constexpr double nan_number = std::numeric_limits<double>::quiet_NaN();

MeanOfWindows mean_of(const std::vector<double>& values)
{
  const std::size_t n = values.size();
  if (n == 0) return {nan_number, nan_number};
  const double mean = gsl_stats_mean(values.data(), 1, n);
  if (n == 1) return {mean, nan_number};
  return {mean, gsl_stats_sd_m(values.data(), 1, n, mean) / std::sqrt(static_cast<double>(n))};
}

/// Of p* = sum of none/sum of (none - all) over windows.
MeanOfWindows zero_of(const std::vector<PushOverShare>& windows)
{
  PushOverShare sum;
  for (const auto& window : windows) {
    sum.none += window.none;
    sum.all += window.all;
  }
  std::vector<double> left;  // of each window, in the mean of which p* is taken
  left.reserve(windows.size());
  const double zero = sum.zero(),
               per_window = (sum.none - sum.all) / static_cast<double>(windows.size());
  for (const auto& [none, all] : windows) left.push_back((none - zero * (none - all)) / per_window);
  return {zero, mean_of(left).error};
}

/// d(push)/dp (PushOverShare).
std::vector<double> slopes_of(const std::vector<PushOverShare>& windows)
{
  std::vector<double> slopes;
  slopes.reserve(windows.size());
  for (const auto& [none, all] : windows) slopes.push_back(all - none);
  return slopes;
}

/// In 1/1000, "21.9 +- 1.9".
std::string thousandths(const std::vector<double>& values)
{
  const auto [mean, error] = mean_of(values);
  return fmt::format("{:.1f} +- {:.1f}", 1000 * mean, 1000 * error);
}

nlohmann::ordered_json json_of(const MeanOfWindows& value)
{
  return {{"mean", value.mean}, {"standard_error", value.error}};
}

}  // namespace

template <int D>
PartitionSummary<D>::PartitionSummary(const Layers& layers, double large_diameter,
                                      std::vector<PartitionRule> rules)
    : layers_(layers),
      large_diameter_(large_diameter),
      rules_(std::move(rules)),
      of_rules_(rules_.size())
{
}

template <int D>
void PartitionSummary<D>::add_difference(const MomentumBalance<D>& window,
                                         const PartitionedBalance<D>& contacts)
{
  for (std::size_t n = 0; n < contacts.layers(); ++n)
    for (std::size_t k = 0; k < contacts.species(); ++k) {
      const auto species = static_cast<Species>(k);
      const Vector<D> force = contacts.contact_force(n, species);
      const auto own = window.mean(n, species);
      double largest = own.gravity.cwiseAbs().maxCoeff(), between = 0;
      for (std::size_t rule = 0; rule < rules_.size(); ++rule) {
        const auto forces = contacts.mean(n, species, rule);
        for (const auto& term : {forces.contact, forces.interaction, forces.base})
          largest = std::max(largest, term.cwiseAbs().maxCoeff());
        between = std::max(between, (forces.sum() - force).cwiseAbs().maxCoeff());
      }
      if (!(largest > 0)) continue;
      difference_ = std::max(difference_, between / largest);
      const Vector<D> stored = own.force - own.gravity;
      from_forces_ = std::max(from_forces_, (stored - force).cwiseAbs().maxCoeff() / largest);
    }
}

template <int D>
void PartitionSummary<D>::add(const MomentumBalance<D>& window,
                              const PartitionedBalance<D>& contacts)
{
  add_difference(window, contacts);
  if (window.species() != 2) return;
  struct Sums {
    double contact = 0, interaction = 0, push = 0, drag = 0;
  };
  std::vector<Sums> sums(rules_.size());
  double push_kinetic = 0, contact_force = 0, weight = 0;
  PushOverShare over_share;
  for (const auto n : layers_inside(window, layers_, large_diameter_)) {
    const auto forces = driving_forces(window, n);
    if (std::isnan(forces.drag)) continue;
    weight += std::abs(window.mean(n, Species::large).gravity.y());
    push_kinetic += forces.push_kinetic;
    contact_force += contacts.contact_force(n, Species::large).y();
    const auto here = push_over_share(forces, contacts, n);
    over_share.none += here.none;
    over_share.all += here.all;
    for (std::size_t rule = 0; rule < rules_.size(); ++rule) {
      const auto own = contacts.mean(n, Species::large, rule);
      const auto of_rule = rule_forces(forces, contacts, n, rule);
      sums[rule].contact += own.contact.y();
      sums[rule].interaction += own.interaction.y();
      sums[rule].push += of_rule.push;
      sums[rule].drag += of_rule.drag;
    }
  }
  if (!(weight > 0)) return;
  push_kinetic_.push_back(push_kinetic / weight);
  contact_force_.push_back(contact_force / weight);
  over_share_.push_back({over_share.none / weight, over_share.all / weight});
  for (std::size_t rule = 0; rule < rules_.size(); ++rule) {
    of_rules_[rule].contact.push_back(sums[rule].contact / weight);
    of_rules_[rule].interaction.push_back(sums[rule].interaction / weight);
    of_rules_[rule].push.push_back(sums[rule].push / weight);
    of_rules_[rule].drag.push_back(sums[rule].drag / weight);
  }
}

template <int D>
std::string PartitionSummary<D>::text() const
{
  auto agreement = fmt::format(
      "N is the same under all rules to {:.1e} of its largest term, and that of the stored forces "
      "to {:.1e}",
      difference_, from_forces_);
  if (push_kinetic_.empty()) return agreement;
  auto text = fmt::format(
      "forces on the large grains in 1/1000 of their weight, upward positive (at least two large "
      "diameters from base and surface, standard errors over {} windows); drag is what closes the "
      "balance\n  {:<14} {:>18} {:>18} {:>18} {:>18}\n",
      push_kinetic_.size(), "rule", "-div sigma", "beta", "contact push", "drag");
  for (std::size_t rule = 0; rule < rules_.size(); ++rule) {
    const auto& own = of_rules_[rule];
    text += fmt::format("  {:<14} {:>18} {:>18} {:>18} {:>18}\n", rules_[rule].name(),
                        thousandths(own.contact), thousandths(own.interaction),
                        thousandths(own.push), thousandths(own.drag));
  }
  const auto p = zero_of(over_share_);
  return text +
         fmt::format(
             "under every rule: N = -div sigma + beta + base = {} (1000, minus the weight, where the "
             "flow is steady), kinetic push {}; where large grains get the share p of every "
             "mixed contact, the contact push is ({}) (p - p*), p* = {:.3f} +- {:.3f}; {}",
             thousandths(contact_force_), thousandths(push_kinetic_),
             thousandths(slopes_of(over_share_)), p.mean, p.error, agreement);
}

template <int D>
std::string PartitionSummary<D>::to_json() const
{
  using Json = nlohmann::ordered_json;
  Json all{{"unit", "weight of the large grains"},
           {"windows", push_kinetic_.size()},
           {"difference_of_N_between_rules", difference_},
           {"difference_of_N_from_stored_forces", from_forces_}};
  if (push_kinetic_.empty()) return all.dump();
  all["N"] = json_of(mean_of(contact_force_));
  all["push_kinetic"] = json_of(mean_of(push_kinetic_));
  all["dpush_dp"] = json_of(mean_of(slopes_of(over_share_)));
  all["p_zero"] = json_of(zero_of(over_share_));
  all["rules"] = Json::array();
  for (std::size_t rule = 0; rule < rules_.size(); ++rule) {
    const auto& own = of_rules_[rule];
    all["rules"].push_back({{"rule", rules_[rule].name()},
                            {"contact", json_of(mean_of(own.contact))},
                            {"interaction", json_of(mean_of(own.interaction))},
                            {"push", json_of(mean_of(own.push))},
                            {"drag", json_of(mean_of(own.drag))}});
  }
  return all.dump();
}

template class PartitionSummary<2>;
template class PartitionSummary<3>;

}  // namespace grseg
