// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/balance/balance_table.hpp"

#include "analysis/balance/driving_forces.hpp"
#include "analysis/frames/sums.hpp"
#include "analysis/stress/contact_sums.hpp"

#include <fmt/format.h>
#include <gsl/gsl_statistics.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <utility>

namespace grseg {
namespace {

struct Units {
  const char *density, *momentum, *stress, *force;
};
template <int D>
constexpr Units units = D == 2 ? Units{"[kg/m^2]", "[kg/(m s)]", "[N/m]", "[N/m^2]"}
                               : Units{"[kg/m^3]", "[kg/(m^2 s)]", "[Pa]", "[N/m^3]"};
constexpr std::array<char, 3> axes{'x', 'y', 'z'};

/// Kinetic stress of a species about the velocity `mean` (m/s), N/m or Pa.
template <int D>
Tensor<D> kinetic_stress(const SpeciesMomentum<D>& of, const Vector<D>& mean)
{
  const Tensor<D> carried = of.momentum * mean.transpose();
  return of.momentum_flux - carried - carried.transpose() + of.density * mean * mean.transpose();
}

/// Adds the components of a vector, such as "contact_L_y@half[N/m^2]"; `rule` is "@half" or "".
template <int D>
void add_vector(std::vector<Cell>& cells, const std::string& name, const std::string& rule,
                const Vector<D>& value)
{
  for (std::size_t a = 0; a < D; ++a)
    cells.push_back({fmt::format("{}_{}{}{}", name, axes[a], rule, units<D>.force),
                     value[static_cast<Eigen::Index>(a)]});
}

/// Adds the cells of one species in one layer; `kinetic_stress` is in N/m or Pa.
template <int D>
void add_species(std::vector<Cell>& cells, const std::string& name, const SpeciesMomentum<D>& of,
                 const Vector<D>& change, const Tensor<D>& kinetic_stress)
{
  constexpr Units unit = units<D>;
  cells.push_back({fmt::format("rho_{}{}", name, unit.density), of.density});
  for (std::size_t a = 0; a < D; ++a)
    cells.push_back({fmt::format("j{}_{}{}", axes[a], name, unit.momentum),
                     of.momentum[static_cast<Eigen::Index>(a)]});
  const auto components = tensor_components(D);
  for (const auto& [suffix, a, b] : components)
    cells.push_back({fmt::format("Sc_{}{}{}", name, suffix, unit.stress), of.contact_stress(a, b)});
  for (const auto& [suffix, a, b] : components)
    if (a <= b)
      cells.push_back({fmt::format("Sk_{}{}{}", name, suffix, unit.stress), kinetic_stress(a, b)});
  add_vector<D>(cells, "rate_" + name, "", of.rate);
  add_vector<D>(cells, "gravity_" + name, "", of.gravity);
  add_vector<D>(cells, "contact_" + name, "", of.contact);
  add_vector<D>(cells, "kinetic_" + name, "", of.kinetic);
  add_vector<D>(cells, "interaction_" + name, "", of.interaction);
  add_vector<D>(cells, "base_" + name, "", of.base);
  add_vector<D>(cells, "force_" + name, "", of.force);
  add_vector<D>(cells, "residual_" + name, "", of.residual());
  add_vector<D>(cells, "change_" + name, "", change);
}

template <int D>
void add_forces(std::vector<Cell>& cells, const DrivingForces& forces)
{
  const std::string unit = units<D>.force;
  cells.insert(cells.end(), {{"phi_L", forces.phi},
                             {"psi_L", forces.psi},
                             {"psik_L", forces.psi_kinetic},
                             {"B", forces.b},
                             {"B_kappa", forces.b_kinetic},
                             {"push" + unit, forces.push},
                             {"push_kinetic" + unit, forces.push_kinetic},
                             {"spread" + unit, forces.spread},
                             {"spread_kinetic" + unit, forces.spread_kinetic},
                             {"drag" + unit, forces.drag},
                             {"scatter" + unit, forces.scatter},
                             {std::string("drift") + units<D>.momentum, forces.drift},
                             {"drag_rate[1/s]", forces.drag_rate()}});
}

}  // namespace

template <int D>
std::vector<Cell> balance_cells(const MomentumBalance<D>& balance, const SpeciesList& species,
                                std::optional<std::size_t> layer)
{
  std::vector<SpeciesMomentum<D>> parts(species.size());
  Vector<D> momentum = Vector<D>::Zero();
  double density = 0;
  for (std::size_t k = 0; layer && k < parts.size(); ++k) {
    parts[k] = balance.mean(*layer, static_cast<Species>(k));
    momentum += parts[k].momentum;
    density += parts[k].density;
  }
  const Vector<D> mean = momentum / density;
  const auto words = column_words(species);
  std::vector<Cell> cells;
  for (std::size_t k = 0; k < parts.size(); ++k)
    add_species<D>(cells, words[k], parts[k],
                   layer ? balance.change(*layer, static_cast<Species>(k)) : mean,
                   kinetic_stress<D>(parts[k], mean));
  if (parts.size() == 2)
    add_forces<D>(cells, layer ? driving_forces(balance, *layer) : DrivingForces{});
  return cells;
}

template <int D>
std::vector<Cell> partition_cells(const MomentumBalance<D>& balance,
                                  const PartitionedBalance<D>& contacts, const SpeciesList& species,
                                  std::optional<std::size_t> layer)
{
  const auto words = column_words(species);
  const bool two = words.size() == 2;
  const auto forces = two && layer ? driving_forces(balance, *layer) : DrivingForces{};
  std::vector<Cell> cells;
  for (std::size_t k = 0; k < contacts.rules().size(); ++k) {
    const auto rule = fmt::format("@{}", contacts.rules()[k].name());
    for (std::size_t s = 0; s < words.size(); ++s) {
      const auto own =
          layer ? contacts.mean(*layer, static_cast<Species>(s), k) : PartitionedForces<D>{};
      add_vector<D>(cells, "contact_" + words[s], rule, own.contact);
      add_vector<D>(cells, "interaction_" + words[s], rule, own.interaction);
    }
    if (!two) continue;
    const auto of_rule = layer ? rule_forces(forces, contacts, *layer, k) : RuleForces{};
    const char* unit = units<D>.force;
    cells.insert(cells.end(), {{"psi_L" + rule, of_rule.psi},
                               {"B" + rule, of_rule.b},
                               {"push" + rule + unit, of_rule.push},
                               {"spread" + rule + unit, of_rule.spread},
                               {"drag" + rule + unit, of_rule.drag}});
  }
  for (std::size_t s = 0; s < words.size(); ++s)
    add_vector<D>(cells, "N_" + words[s], "",
                  layer ? contacts.contact_force(*layer, static_cast<Species>(s))
                        : Vector<D>(Vector<D>::Zero()));
  if (two)
    cells.push_back({"p_zero", layer ? push_over_share(forces, contacts, *layer).zero() : 0});
  return cells;
}

template std::vector<Cell> balance_cells(const MomentumBalance<2>&, const SpeciesList&,
                                         std::optional<std::size_t>);
template std::vector<Cell> balance_cells(const MomentumBalance<3>&, const SpeciesList&,
                                         std::optional<std::size_t>);
template std::vector<Cell> partition_cells(const MomentumBalance<2>&, const PartitionedBalance<2>&,
                                           const SpeciesList&, std::optional<std::size_t>);
template std::vector<Cell> partition_cells(const MomentumBalance<3>&, const PartitionedBalance<3>&,
                                           const SpeciesList&, std::optional<std::size_t>);

MeanOfWindows mean_of_windows(const std::vector<double>& values)
{
  const std::size_t n = values.size();
  if (n == 0) return {no_number, no_number};
  const double mean = gsl_stats_mean(values.data(), 1, n);
  const auto [least, most] = std::ranges::minmax_element(values);
  if (*most - *least <= 1e-6 * std::max(std::abs(*most), std::abs(*least)))
    return {mean, no_number};
  return {mean, gsl_stats_sd_m(values.data(), 1, n, mean) / std::sqrt(static_cast<double>(n))};
}

std::string errors_over(const std::vector<double>& values)
{
  if (values.size() == 1) return "of one window";
  return std::isnan(mean_of_windows(values).error)
             ? fmt::format("of {} identical windows: no error can be given", values.size())
             : fmt::format("standard errors over {} windows", values.size());
}

namespace {

/// "up by 0.012 +- 0.003", "up by 0.012" without an error, or "neither way" below two errors.
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

/// Height of the surface, m: twice the mean height of the mass.
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

namespace {

/// "21.9 +- 1.9", or "21.9" if there is no error.
std::string with_error(const MeanOfWindows& value, double unit, int digits)
{
  auto text = fmt::format("{:.{}f}", value.mean / unit, digits);
  if (std::isfinite(value.error)) text += fmt::format(" +- {:.{}f}", value.error / unit, digits);
  return text;
}

/// Mean and error in units of 1/1000.
std::string thousandths(const std::vector<double>& values)
{
  return with_error(mean_of_windows(values), 1e-3, 1);
}

nlohmann::ordered_json json_of(const MeanOfWindows& value)
{
  return {{"mean", value.mean}, {"standard_error", value.error}};
}

/// Derivative of the push with respect to the share p, in one window.
constexpr auto slope_of = [](const auto& window) {
  return window.over_share.all - window.over_share.none;
};

}  // namespace

template <int D>
BalanceSummary<D>::BalanceSummary(const Layers& layers, double large_diameter,
                                  std::vector<PartitionRule> rules)
    : layers_(layers), large_diameter_(large_diameter), rules_(std::move(rules))
{
}

template <int D>
void BalanceSummary<D>::add_residuals(const MomentumBalance<D>& window)
{
  for (std::size_t n = 0; n < window.layers(); ++n)
    for (std::size_t k = 0; k < window.species(); ++k) {
      const auto own = window.mean(n, static_cast<Species>(k));
      double largest = 0;
      for (const auto& term :
           {own.rate, own.gravity, own.contact, own.kinetic, own.interaction, own.base})
        largest = std::max(largest, term.cwiseAbs().maxCoeff());
      if (largest > 0)
        residual_ = std::max(residual_, own.residual().cwiseAbs().maxCoeff() / largest);
    }
}

template <int D>
void BalanceSummary<D>::add_differences(const MomentumBalance<D>& window,
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
void BalanceSummary<D>::add(const MomentumBalance<D>& window, const PartitionedBalance<D>* contacts)
{
  add_residuals(window);
  if (contacts != nullptr) add_differences(window, *contacts);
  if (window.species() != 2) return;
  Forces sum;
  sum.of_rules.resize(rules_.size());
  double weight = 0;
  for (const auto n : layers_inside(window, layers_, large_diameter_)) {
    const auto forces = driving_forces(window, n);
    if (std::isnan(forces.drag)) continue;
    weight += std::abs(window.mean(n, Species::large).gravity.y());
    sum.push += forces.push;
    sum.push_kinetic += forces.push_kinetic;
    sum.drag += forces.drag;
    if (contacts == nullptr) continue;
    sum.contact += contacts->contact_force(n, Species::large).y();
    sum.over_share += push_over_share(forces, *contacts, n);
    for (std::size_t rule = 0; rule < rules_.size(); ++rule) {
      const auto own = contacts->mean(n, Species::large, rule);
      const auto of_rule = rule_forces(forces, *contacts, n, rule);
      sum.of_rules[rule] +=
          OfRule{own.contact.y(), own.interaction.y(), of_rule.push, of_rule.drag};
    }
  }
  if (weight > 0) windows_.push_back(sum / weight);
}

template <int D>
template <class Of>
std::vector<double> BalanceSummary<D>::series(const Of& of) const
{
  return listed(windows_, of);
}

template <int D>
std::vector<double> BalanceSummary<D>::series(std::size_t rule, double OfRule::*place) const
{
  return series([&](const Forces& window) { return window.of_rules[rule].*place; });
}

template <int D>
MeanOfWindows BalanceSummary<D>::zero() const
{
  PushOverShare sum;
  for (const auto& window : windows_) sum += window.over_share;
  const double zero = sum.zero(),
               per_window = (sum.none - sum.all) / static_cast<double>(windows_.size());
  // One estimate of p* per window, linear in its forces. Their mean is p*; their scatter gives
  // the interval.
  const auto left = series([&](const Forces& window) {
    const auto& [none, all] = window.over_share;
    return zero + (none - zero * (none - all)) / per_window;
  });
  return {zero, mean_of_windows(left).error};
}

template <int D>
std::string BalanceSummary<D>::sentence() const
{
  auto closed = fmt::format("the balances close to {:.1e} of the largest term of each", residual_);
  if (windows_.size() < 2) return closed;
  return fmt::format(
      "in units of their weight, with mixed contacts cut at the contact point, large grains are "
      "pushed {} by contact stress, {} by kinetic "
      "stress and {} by drag (layers at least two large diameters from base and surface, {}); {}",
      direction(series(&Forces::push)), direction(series(&Forces::push_kinetic)),
      direction(series(&Forces::drag)), errors_over(series(&Forces::drag)), closed);
}

template <int D>
std::string BalanceSummary<D>::text() const
{
  auto agreement = fmt::format(
      "N is the same under all rules to {:.1e} of its largest term, and equals the stored forces "
      "less the weight to {:.1e}",
      difference_, from_forces_);
  if (windows_.empty()) return agreement;
  constexpr const char* line = "  {:<14} {:>18} {:>18} {:>18} {:>18}\n";
  auto text =
      fmt::format(
          "forces on the large grains in 1/1000 of their weight, positive upward (layers at least "
          "two large diameters from base and surface, {}); drag is the rest of the balance\n",
          errors_over(series(&Forces::contact))) +
      fmt::format(line, "rule", "-div sigma", "beta", "contact push", "drag");
  for (std::size_t rule = 0; rule < rules_.size(); ++rule) {
    const auto number = [&](double OfRule::*place) { return thousandths(series(rule, place)); };
    text += fmt::format(line, rules_[rule].name(), number(&OfRule::contact),
                        number(&OfRule::interaction), number(&OfRule::push), number(&OfRule::drag));
  }
  return text +
         fmt::format(
             "under every rule: N = -div sigma + beta + base = {} (in a steady flow 1000, the "
             "weight, plus the divergence of the kinetic stress), kinetic push {}; if large grains "
             "get the share p of mixed contacts, the contact push is ({}) (p - p*), p* = {}; {}",
             thousandths(series(&Forces::contact)), thousandths(series(&Forces::push_kinetic)),
             thousandths(series(slope_of)), with_error(zero(), 1, 3), agreement);
}

template <int D>
std::string BalanceSummary<D>::to_json(const Table& table) const
{
  auto all = nlohmann::ordered_json::parse(table.to_json());
  auto& summary = all["summary"] = {{"unit", "weight of the large grains"},
                                    {"windows", windows_.size()},
                                    {"difference_of_N_between_rules", difference_},
                                    {"difference_of_N_from_stored_forces", from_forces_}};
  const auto mean = [](const std::vector<double>& values) {
    return json_of(mean_of_windows(values));
  };
  if (!windows_.empty()) {
    summary["N"] = mean(series(&Forces::contact));
    summary["push_kinetic"] = mean(series(&Forces::push_kinetic));
    summary["dpush_dp"] = mean(series(slope_of));
    summary["p_zero"] = json_of(zero());
    summary["rules"] = nlohmann::ordered_json::array();
    for (std::size_t rule = 0; rule < rules_.size(); ++rule)
      summary["rules"].push_back({{"rule", rules_[rule].name()},
                                  {"contact", mean(series(rule, &OfRule::contact))},
                                  {"interaction", mean(series(rule, &OfRule::interaction))},
                                  {"push", mean(series(rule, &OfRule::push))},
                                  {"drag", mean(series(rule, &OfRule::drag))}});
  }
  return all.dump(2) + '\n';
}

template std::vector<std::size_t> layers_inside(const MomentumBalance<2>&, const Layers&, double);
template std::vector<std::size_t> layers_inside(const MomentumBalance<3>&, const Layers&, double);
template class BalanceSummary<2>;
template class BalanceSummary<3>;

}  // namespace grseg
