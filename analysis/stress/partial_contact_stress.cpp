// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/stress/partial_contact_stress.hpp"

#include "analysis/frames/accumulate.hpp"

#include <fmt/format.h>

#include <cassert>
#include <cmath>

namespace grseg {
PartialContactStress::PartialContactStress(const Layers& layers, Assignment assignment,
                                           std::optional<double> power,
                                           std::optional<Kernel> kernel)
    : layers_(layers),
      assignment_(assignment),
      power_(power),
      rules_(summed_rules(power)),
      kernel_(kernel)
{
  assert(kernel_ || assignment_ != Assignment::kernel);
}

std::vector<PartialContactStress::SummedRule> PartialContactStress::summed_rules(
    std::optional<double> power)
{
  std::vector<SummedRule> rules;
  for (const auto& rule : rule_definitions())
    if (rule.sum != nullptr && (*rule.number == '\0' || power))
      rules.push_back({&rule, power.value_or(0)});
  return rules;
}

void PartialContactStress::add_stretch(Sum sum, const Contact& contact, const Stretch& stretch)
{
  const Tensor2 stress = stretch.weight * contact.stress;
  const auto share = [&](std::size_t layer, double of_it) {
    sums_[layer].sums.*sum += of_it * stress;
  };
  switch (assignment_) {
    case Assignment::contact_point:
      return share(contact.layer, 1);
    case Assignment::branch:
      return layers_.share_segment(stretch.from, stretch.to, count_, share);
    case Assignment::kernel:
      return share_kernel(layers_, *kernel_, stretch.from, stretch.to, count_, share);
    case Assignment::grain:
      return share(std::min(layers_.at(stretch.from), count_ - 1), 1);
  }
}

void PartialContactStress::add_equal(Species species, const Contact& contact, double y_i,
                                     double y_j, double share_i)
{
  const bool small = species == Species::small;
  const Sum sum = small ? &ContactSums::ss : &ContactSums::ll;
  const Sum halves = small ? &ContactSums::halves_ss : &ContactSums::halves_ll;
  if (assignment_ != Assignment::grain) return add_stretch(sum, contact, {y_i, y_j, 1});
  add_stretch(sum, contact, {y_i, y_j, share_i});
  add_stretch(sum, contact, {y_j, y_i, 1 - share_i});
  add_stretch(halves, contact, {y_i, y_j, 0.5});
  add_stretch(halves, contact, {y_j, y_i, 0.5});
}

void PartialContactStress::add_mixed(const Contact& contact, const MixedContact& pair,
                                     double y_large, double y_small)
{
  for (const auto& [rule, number] : rules_) {
    const double share = rule->share(pair, number);
    const double end = rule->along_own_stretch ? y_large + share * (y_small - y_large) : y_small;
    add_stretch(rule->sum, contact, {y_large, end, share});
  }
  const Sum mixed = &ContactSums::mixed;
  if (assignment_ != Assignment::grain) return add_stretch(mixed, contact, {y_large, y_small, 1});
  const double by_size = pair.r_large / (pair.r_large + pair.r_small);
  add_stretch(mixed, contact, {y_large, y_small, by_size});
  add_stretch(mixed, contact, {y_small, y_large, 1 - by_size});
  add_stretch(&ContactSums::mixed_at_large, contact, {y_large, y_small, 1});
  add_stretch(&ContactSums::mixed_at_small, contact, {y_small, y_large, 1});
}

void PartialContactStress::add(const Grains& grains, const Frame<2>& frame)
{
  ++frames_;
  count_ = layers_.count(grains, frame);
  sums_.resize(std::max(sums_.size(), count_));
  const auto& list = frame.contacts;
  for (std::size_t k = 0; k < list.size(); ++k) {
    const Vec2& force = list.force[k];
    if (force.x() == 0 && force.y() == 0) continue;
    const auto type = pair_type(grains, frame, k);
    const auto i = static_cast<std::size_t>(list.i[k]);
    const double share_i = share_of_first(grains, list, k);
    const Vec2 &position = frame.position[i], &branch = list.branch[k];
    const Vec2 touch = position - share_i * branch;
    const double y_i = layers_.height(position), y_j = layers_.height(position - branch);
    const double y_contact = layers_.height(touch);
    const Contact contact{layers_.turned(force, touch) * layers_.turned(branch, touch).transpose(),
                          std::min(layers_.at(y_contact), count_ - 1)};
    sums_[contact.layer].contacts[static_cast<std::size_t>(type)] += 1;

    if (type == PairType::SS || type == PairType::LL) {
      add_equal(grains.species[i], contact, y_i, y_j, share_i);
    } else if (type == PairType::LS) {
      const bool i_large = grains.species[i] == Species::large;
      const double r_i = grains.radius[i], r_j = grains.radius[static_cast<std::size_t>(list.j[k])];
      const MixedContact pair{i_large ? r_i : r_j, i_large ? r_j : r_i,
                              i_large ? share_i : 1 - share_i};
      add_mixed(contact, pair, i_large ? y_i : y_j, i_large ? y_j : y_i);
    } else {
      const bool large = type == PairType::Lb;
      add_stretch(large ? &ContactSums::base_large : &ContactSums::base_small, contact,
                  {y_i, y_contact, share_i});
      add_stretch(large ? &ContactSums::whole_large : &ContactSums::whole_small, contact,
                  {y_i, y_j, 1});
    }
  }
}

PartialContactStress::Sums& PartialContactStress::Sums::operator+=(const Sums& others)
{
  accumulate(contacts, others.contacts);
  sums += others.sums;
  return *this;
}

void PartialContactStress::merge(const PartialContactStress& others)
{
  frames_ += others.frames_;
  accumulate(sums_, others.sums_);
}

PartialContactStress::Mean PartialContactStress::mean(std::size_t layer) const
{
  const auto frames = static_cast<double>(frames_);
  Mean mean{sums_[layer].contacts, sums_[layer].sums / frames};
  for (auto& number : mean.contacts) number /= frames;
  mean.sums.at_centres = assignment_ == Assignment::grain;
  return mean;
}

TableKind PartialContactStress::table_kind() const
{
  return {.at_centres = assignment_ == Assignment::grain, .power = power_.has_value()};
}

std::vector<std::string> PartialContactStress::columns() const
{
  std::vector<std::string> names;
  names.reserve(pair_types);
  for (const char* type : pair_type_names) names.push_back(fmt::format("n_{}", type));
  const auto sums = sum_column_names(table_kind());
  names.insert(names.end(), sums.begin(), sums.end());
  return names;
}

std::vector<double> PartialContactStress::row(std::size_t layer) const
{
  const auto mean_here = mean(layer);
  std::vector<double> row(mean_here.contacts.begin(), mean_here.contacts.end());
  const auto sums = sum_cells(mean_here.sums, table_kind());
  row.insert(row.end(), sums.begin(), sums.end());
  return row;
}

}  // namespace grseg
