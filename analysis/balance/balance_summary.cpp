// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/balance/balance_summary.hpp"

#include "analysis/frames/sums.hpp"

#include <fmt/format.h>
#include <gsl/gsl_statistics.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace grseg {

MeanOfWindows mean_of_windows(const std::vector<double>& values)
{
  const std::size_t n = values.size();
  if (n == 0) return {no_number, no_number};
  const double mean = gsl_stats_mean(values.data(), 1, n);
  const auto [least, most] = std::minmax_element(values.begin(), values.end());
  if (*most - *least <= 1e-6 * std::max(std::abs(*most), std::abs(*least)))
    return {mean, no_number};
  return {mean, gsl_stats_sd_m(values.data(), 1, n, mean) / std::sqrt(static_cast<double>(n))};
}

std::string errors_over(const std::vector<double>& values)
{
  if (values.size() == 1) return "of one window";
  return std::isnan(mean_of_windows(values).error)
             ? fmt::format("of {} windows between which nothing moves, so that there are no errors",
                           values.size())
             : fmt::format("standard errors over {} windows", values.size());
}

namespace {

/// "up by 0.012 +- 0.003", or "neither way" where zero lies within two standard errors; without an error
/// where the windows have none.
std::string direction(const std::vector<double>& push)
{
  const auto [mean, error] = mean_of_windows(push);
  if (std::isnan(error))
    return mean == 0 ? "neither way"
                     : fmt::format("{} by {:.2g}", mean > 0 ? "up" : "down", std::abs(mean));
  if (std::abs(mean) <= 2 * error)
    return fmt::format("neither way ({:.2g} +- {:.1g})", mean, error);
  return fmt::format("{} by {:.2g} +- {:.1g}", mean > 0 ? "up" : "down", std::abs(mean), error);
}

/// m.
template <int D>
double surface(const MomentumBalance<D>& window, const Layers& layers)
{
  double mass = 0, moment = 0;
  for (std::size_t n = 0; n < window.layers(); ++n) {
    double here = 0;
    for (std::size_t k = 0; k < window.species(); ++k)
      here += window.mean(n, static_cast<Species>(k)).density;
    mass += here;
    moment += here * (layers.bottom(n) + layers.top(n)) / 2;
  }
  return 2 * moment / mass;
}

}  // namespace

template <int D>
std::vector<std::size_t> layers_inside(const MomentumBalance<D>& window, const Layers& layers,
                                       double large_diameter)
{
  const double margin = 2 * large_diameter, rounding = 1e-9 * margin;
  const double highest = surface(window, layers) - margin;
  std::vector<std::size_t> inside;
  for (std::size_t n = 0; n < window.layers(); ++n)
    if (layers.bottom(n) >= margin - rounding && layers.top(n) <= highest + rounding)
      inside.push_back(n);
  return inside;
}

template <int D>
BalanceSummary<D>::BalanceSummary(const Layers& layers, double large_diameter)
    : layers_(layers), large_diameter_(large_diameter)
{
}

template <int D>
void BalanceSummary<D>::add_residual(const SpeciesMomentum<D>& own)
{
  double largest = 0;
  for (const auto& term :
       {own.rate, own.gravity, own.contact, own.kinetic, own.interaction, own.base})
    largest = std::max(largest, term.cwiseAbs().maxCoeff());
  if (largest > 0) residual_ = std::max(residual_, own.residual().cwiseAbs().maxCoeff() / largest);
}

template <int D>
void BalanceSummary<D>::add(const MomentumBalance<D>& window)
{
  for (std::size_t n = 0; n < window.layers(); ++n)
    for (std::size_t k = 0; k < window.species(); ++k)
      add_residual(window.mean(n, static_cast<Species>(k)));
  if (window.species() != 2) return;
  double push = 0, push_kinetic = 0, drag = 0, weight = 0;
  for (const auto n : layers_inside(window, layers_, large_diameter_)) {
    const auto forces = driving_forces(window, n);
    if (std::isnan(forces.drag)) continue;
    push += forces.push;
    push_kinetic += forces.push_kinetic;
    drag += forces.drag;
    weight += std::abs(window.mean(n, Species::large).gravity.y());
  }
  if (!(weight > 0)) return;
  push_.push_back(push / weight);
  push_kinetic_.push_back(push_kinetic / weight);
  drag_.push_back(drag / weight);
}

template <int D>
std::string BalanceSummary<D>::sentence() const
{
  auto closed = fmt::format("the balances close to {:.1e} of the largest term of each", residual_);
  if (push_.size() < 2) return closed;
  return fmt::format(
      "in units of their weight, with mixed contacts cut at the contact point, large grains are "
      "pushed {} by contact stress, {} by kinetic "
      "stress and {} by drag (at least two large diameters from base and surface, {}); {}",
      direction(push_), direction(push_kinetic_), direction(drag_), errors_over(drag_), closed);
}

template std::vector<std::size_t> layers_inside(const MomentumBalance<2>&, const Layers&, double);
template std::vector<std::size_t> layers_inside(const MomentumBalance<3>&, const Layers&, double);
template class BalanceSummary<2>;
template class BalanceSummary<3>;

namespace {

/// Of p* = sum of none/sum of (none - all) over windows.
MeanOfWindows zero_of(const std::vector<PushOverShare>& windows)
{
  PushOverShare sum;
  for (const auto& window : windows) {
    sum.none += window.none;
    sum.all += window.all;
  }
  std::vector<double> left;  // p* of each window as far as their mean is p*
  left.reserve(windows.size());
  const double zero = sum.zero(),
               per_window = (sum.none - sum.all) / static_cast<double>(windows.size());
  for (const auto& [none, all] : windows)
    left.push_back(zero + (none - zero * (none - all)) / per_window);
  return {zero, mean_of_windows(left).error};
}

/// d(push)/dp (PushOverShare).
std::vector<double> slopes_of(const std::vector<PushOverShare>& windows)
{
  std::vector<double> slopes;
  slopes.reserve(windows.size());
  for (const auto& [none, all] : windows) slopes.push_back(all - none);
  return slopes;
}

/// "21.9 +- 1.9", or "21.9" where there is no error.
std::string with_error(const MeanOfWindows& value, double unit, int digits)
{
  auto text = fmt::format("{:.{}f}", value.mean / unit, digits);
  if (std::isfinite(value.error)) text += fmt::format(" +- {:.{}f}", value.error / unit, digits);
  return text;
}

/// In 1/1000.
std::string thousandths(const std::vector<double>& values)
{
  return with_error(mean_of_windows(values), 1e-3, 1);
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
      "N is the same under all rules to {:.1e} of its largest term, and equals the stored forces "
      "less the weight to {:.1e}",
      difference_, from_forces_);
  if (push_kinetic_.empty()) return agreement;
  auto text = fmt::format(
      "forces on the large grains in 1/1000 of their weight, upward positive (at least two large "
      "diameters from base and surface, {}); drag is what closes the "
      "balance\n  {:<14} {:>18} {:>18} {:>18} {:>18}\n",
      errors_over(contact_force_), "rule", "-div sigma", "beta", "contact push", "drag");
  for (std::size_t rule = 0; rule < rules_.size(); ++rule) {
    const auto& own = of_rules_[rule];
    text += fmt::format("  {:<14} {:>18} {:>18} {:>18} {:>18}\n", rules_[rule].name(),
                        thousandths(own.contact), thousandths(own.interaction),
                        thousandths(own.push), thousandths(own.drag));
  }
  return text +
         fmt::format(
             "under every rule: N = -div sigma + beta + base = {} (in a steady flow 1000, against the "
             "weight, plus the divergence of the kinetic stress), kinetic push {}; where large grains "
             "get the share p of every mixed contact, the contact push is ({}) (p - p*), p* = {}; {}",
             thousandths(contact_force_), thousandths(push_kinetic_),
             thousandths(slopes_of(over_share_)), with_error(zero_of(over_share_), 1, 3),
             agreement);
}

template <int D>
nlohmann::ordered_json PartitionSummary<D>::json() const
{
  using Json = nlohmann::ordered_json;
  Json all{{"unit", "weight of the large grains"},
           {"windows", push_kinetic_.size()},
           {"difference_of_N_between_rules", difference_},
           {"difference_of_N_from_stored_forces", from_forces_}};
  if (push_kinetic_.empty()) return all;
  all["N"] = json_of(mean_of_windows(contact_force_));
  all["push_kinetic"] = json_of(mean_of_windows(push_kinetic_));
  all["dpush_dp"] = json_of(mean_of_windows(slopes_of(over_share_)));
  all["p_zero"] = json_of(zero_of(over_share_));
  all["rules"] = Json::array();
  for (std::size_t rule = 0; rule < rules_.size(); ++rule) {
    const auto& own = of_rules_[rule];
    all["rules"].push_back({{"rule", rules_[rule].name()},
                            {"contact", json_of(mean_of_windows(own.contact))},
                            {"interaction", json_of(mean_of_windows(own.interaction))},
                            {"push", json_of(mean_of_windows(own.push))},
                            {"drag", json_of(mean_of_windows(own.drag))}});
  }
  return all;
}

template <int D>
std::string PartitionSummary<D>::to_json(const Table& table) const
{
  auto all = nlohmann::ordered_json::parse(table.to_json());
  all["summary"] = json();
  return all.dump(2) + '\n';
}

template class PartitionSummary<2>;
template class PartitionSummary<3>;

}  // namespace grseg
