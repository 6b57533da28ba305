// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/balance/momentum_balance.hpp"

#include "analysis/frames/contacts.hpp"
#include "formats/core/species.hpp"

#include <algorithm>
#include <cassert>
#include <utility>

namespace grseg {
namespace {

std::size_t index(Species species)
{
  return static_cast<std::size_t>(species);
}

}  // namespace

template <int D>
Vector<D> MomentumBalance<D>::Instant::at(std::size_t layer, Species species) const
{
  return layer < momentum.size() ? momentum[layer][index(species)] : Vector<D>(Vector<D>::Zero());
}

template <int D>
MomentumBalance<D>::MomentumBalance(const Layers& layers, const Kernel& kernel,
                                    const Gravity<D>& gravity, double step, std::size_t species)
    : layers_(layers), kernel_(kernel), gravity_(gravity), step_(step), species_(species)
{
}

template <int D>
void MomentumBalance<D>::add(const Grains& grains, const Frame<D>& frame)
{
  assert(frame.force.size() == grains.size());
  ++frames_;
  if (!one_density_) one_density_ = have_one_density<D>(grains);
  // Number of layers of this frame only, so that its sums do not depend on earlier frames.
  const std::size_t count = layers_.count(grains, frame);
  sums_.resize(std::max(sums_.size(), count), std::vector<SpeciesMomentum<D>>(species_));
  pull_.assign(grains.size(), Vector<D>::Zero());
  for (std::size_t k = 0; k < frame.contacts.size(); ++k) add_contact(grains, frame, k, count);
  const Vector<D> gravity = gravity_.at(frame.time);
  const std::vector<Vector<D>> nothing(species_, Vector<D>::Zero());
  Instant before{frame.time, which_are_absent(frame), {count, nothing}};
  for (std::size_t g = 0; g < grains.size(); ++g)
    if (is_mobile(grains, frame, g)) add_grain(grains, frame, g, gravity, before);
  if (!first_) first_ = before;
  same_grains_ = same_grains_ && first_->grains == before.grains;
  last_ = std::move(before);
}

template <int D>
void MomentumBalance<D>::add_contact(const Grains& grains, const Frame<D>& frame,
                                     std::size_t contact, std::size_t count)
{
  const auto& list = frame.contacts;
  if (!bears_force(list, contact)) return;
  const Vector<D>& force = list.force[contact];
  const auto [i, j] = partners(grains, frame, contact);
  const Species species = grains.species[i];
  const double y_i = frame.position[i].y(), share_i = share_of_first(grains, list, contact);
  const double y_contact = y_i - share_i * list.branch[contact].y();
  const Tensor<D> stress = force * list.branch[contact].transpose();
  // At the contact point, a force from outside the species is `base` or `interaction`, not stress.
  const auto at_contact = [&](const auto& book) {
    share_kernel(layers_, kernel_, y_contact, y_contact, count, book);
  };

  pull_[i] += force;
  if (!j) {
    at_contact([&](std::size_t n, double share) {
      auto& sums = sums_[n][index(species)];
      sums.contact -= share * force;
      sums.base += share * force;
    });
    return add_stress(species, share_i * stress, y_i, y_contact, count);
  }
  const Species other = grains.species[*j];
  const double y_j = frame.position[*j].y();
  pull_[*j] -= force;
  if (other == species) return add_stress(species, stress, y_i, y_j, count);
  at_contact([&](std::size_t n, double share) {
    auto &own = sums_[n][index(species)], &others = sums_[n][index(other)];
    own.contact -= share * force;
    own.interaction += share * force;
    others.contact += share * force;
    others.interaction -= share * force;
  });
  add_stress(species, share_i * stress, y_i, y_contact, count);
  add_stress(other, (1 - share_i) * stress, y_contact, y_j, count);
}

template <int D>
void MomentumBalance<D>::add_stress(Species species, const Tensor<D>& force_by_arm, double from,
                                    double to, std::size_t count)
{
  share_kernel(layers_, kernel_, from, to, count, [&](std::size_t n, double share) {
    sums_[n][index(species)].contact_stress += share * force_by_arm;
  });
}

template <int D>
void MomentumBalance<D>::add_grain(const Grains& grains, const Frame<D>& frame, std::size_t grain,
                                   const Vector<D>& gravity, Instant& before)
{
  const std::size_t species = index(grains.species[grain]), count = before.momentum.size();
  const double mass = grains.mass[grain], y = frame.position[grain].y();
  const double h = step_of_force(frame, step_);
  const double content = *one_density_ ? mass : grain_volume<D>(grains.radius[grain]);
  const Vector<D>&velocity = frame.velocity[grain], &force = frame.force[grain];
  const Vector<D> momentum = mass * velocity, momentum_before = momentum - h * force;
  share_kernel(layers_, kernel_, y, y, count, [&](std::size_t n, double share) {
    auto& sums = sums_[n][species];
    sums.density += share * mass;
    sums.content += share * content;
    sums.momentum += share * momentum;
    sums.momentum_flux += share * momentum * velocity.transpose();
    sums.gravity += share * mass * gravity;
    sums.contact += share * pull_[grain];
    sums.force += share * force;
    sums.rate -= share / h * momentum_before;
    sums.kinetic -= share / h * momentum;
    before.momentum[n][species] += share * momentum_before;
  });
  const double y_next = y + h * velocity.y();
  share_kernel(layers_, kernel_, y_next, y_next, count, [&](std::size_t n, double share) {
    sums_[n][species].rate += share / h * momentum;
    sums_[n][species].kinetic += share / h * momentum;
  });
}

template <int D>
void MomentumBalance<D>::merge(const MomentumBalance& later)
{
  frames_ += later.frames_;
  accumulate(sums_, later.sums_);
  if (!first_) first_ = later.first_;
  same_grains_ = same_grains_ && later.same_grains_ &&
                 (!later.first_ || first_->grains == later.first_->grains);
  if (later.last_) last_ = later.last_;
}

template <int D>
SpeciesMomentum<D> MomentumBalance<D>::mean(std::size_t layer, Species species) const
{
  const double factor = 1 / (static_cast<double>(frames_) * layers_.volume(layer));
  return sums_[layer][index(species)] * factor;
}

template <int D>
Vector<D> MomentumBalance<D>::change(std::size_t layer, Species species) const
{
  if (!same_grains_) return Vector<D>::Constant(no_number);
  const Vector<D> gained = last_->at(layer, species) - first_->at(layer, species);
  return gained / ((last_->time - first_->time) * layers_.volume(layer));
}

template class MomentumBalance<2>;
template class MomentumBalance<3>;

namespace {

std::size_t number(Species species)
{
  return static_cast<std::size_t>(species);
}

}  // namespace

template <int D>
PartitionedBalance<D>::PartitionedBalance(const Layers& layers, const Kernel& kernel,
                                          std::vector<PartitionRule> rules, std::size_t species)
    : layers_(layers), kernel_(kernel), rules_(std::move(rules)), species_(species)
{
}

template <int D>
void PartitionedBalance<D>::grow_to(std::size_t layers)
{
  if (layers <= sums_.size()) return;
  LayerSums empty;
  empty.unmixed.resize(species_);
  empty.at_centre.resize(species_, Vector<D>::Zero());
  empty.mixed.resize(rules_.size() * species_);
  sums_.resize(layers, empty);
}

template <int D>
void PartitionedBalance<D>::add(const Grains& grains, const Frame<D>& frame)
{
  if (rules_.empty()) return;
  ++frames_;
  count_ = layers_.count(grains, frame);
  grow_to(count_);
  const auto& list = frame.contacts;
  const auto at_height = [&](double y, const auto& book) {
    share_kernel(layers_, kernel_, y, y, count_, book);
  };
  for (std::size_t k = 0; k < list.size(); ++k) {
    if (!bears_force(list, k)) continue;
    const Vector<D>& f = list.force[k];
    const auto pair = partners(grains, frame, k);
    const auto i = pair.i;
    const auto j = pair.j;
    const std::size_t own = number(grains.species[i]);
    const double y_i = frame.position[i].y(), share_i = share_of_first(grains, list, k);
    const double rise = list.branch[k].y(), y_contact = y_i - share_i * rise;
    const Tensor<D> stress = f * list.branch[k].transpose();
    const bool equal = j && number(grains.species[*j]) == own;
    const auto add_unmixed = [&](double to, const Tensor<D>& part) {
      share_kernel(layers_, kernel_, y_i, to, count_, [&](std::size_t n, double share) {
        sums_[n].unmixed[own].stress += share * part;
      });
    };

    at_height(y_i, [&](std::size_t n, double share) {
      sums_[n].at_centre[own] += share * f;
      if (!j || equal) sums_[n].unmixed[own].contact += share * f;
    });
    if (!j) {
      add_unmixed(y_contact, share_i * stress);
      at_height(y_contact, [&](std::size_t n, double share) {
        sums_[n].unmixed[own].contact -= share * f;
        sums_[n].unmixed[own].base += share * f;
      });
      continue;
    }
    const std::size_t other = number(grains.species[*j]);
    const double y_j = frame.position[*j].y();
    at_height(y_j, [&](std::size_t n, double share) {
      sums_[n].at_centre[other] -= share * f;
      if (equal) sums_[n].unmixed[own].contact -= share * f;
    });
    if (equal) {
      add_unmixed(y_j, stress);
    } else {
      const auto radii = mixed_contact(grains, i, *j, share_i);
      if (own > other)
        add_mixed({radii, f, stress, own, other, y_i, y_j, rise});
      else
        add_mixed({radii, -f, stress, other, own, y_j, y_i, -rise});
    }
  }
}

template <int D>
void PartitionedBalance<D>::add_mixed(const Mixed& contact)
{
  const auto& [radii, on_large, whole, large, small, y_large, y_small, rise] = contact;
  // Copies, because clang 14 does not let lambdas capture structured bindings.
  const Vector<D> force = on_large;
  const Tensor<D> stress = whole;
  const auto at_centre = [&, this](double y, std::size_t species, const Vector<D>& on) {
    share_kernel(layers_, kernel_, y, y, count_, [&](std::size_t n, double share) {
      for (std::size_t rule = 0; rule < rules_.size(); ++rule) {
        auto& sums = sums_[n].mixed[rule * species_ + species];
        (rules_[rule].adds_up() ? sums.contact : sums.interaction) += share * on;
      }
    });
  };
  at_centre(y_large, large, force);
  at_centre(y_small, small, -force);
  const auto stretch = [&, this](double y, double cut, std::size_t place, double part) {
    share_kernel(layers_, kernel_, y, cut, count_, [&](std::size_t n, double share) {
      sums_[n].mixed[place].stress += share * part * stress;
    });
  };
  share_kernel(layers_, kernel_, y_large, y_small, count_,
               [&](std::size_t n, double share) { sums_[n].whole += share * stress; });
  for (std::size_t rule = 0; rule < rules_.size(); ++rule) {
    if (!rules_[rule].adds_up()) continue;
    const double p = rules_[rule].definition().share(radii, rules_[rule].value);
    const double cut = y_large - p * rise;
    const std::size_t of_large = rule * species_ + large, of_small = rule * species_ + small;
    stretch(y_large, cut, of_large, p);
    stretch(y_small, cut, of_small, 1 - p);
    share_kernel(layers_, kernel_, cut, cut, count_, [&](std::size_t n, double share) {
      auto &to_large = sums_[n].mixed[of_large], &to_small = sums_[n].mixed[of_small];
      to_large.contact -= share * force;
      to_large.interaction += share * force;
      to_small.contact += share * force;
      to_small.interaction -= share * force;
    });
  }
}

template <int D>
void PartitionedBalance<D>::merge(const PartitionedBalance& others)
{
  frames_ += others.frames_;
  grow_to(others.layers());
  accumulate(sums_, others.sums_);
}

template <int D>
double PartitionedBalance<D>::per_frame_and_volume(std::size_t layer) const
{
  return 1 / (static_cast<double>(frames_) * layers_.volume(layer));
}

template <int D>
PartitionedForces<D> PartitionedBalance<D>::mean(std::size_t layer, Species species,
                                                 std::size_t rule) const
{
  const auto& sums = sums_[layer];
  auto mean = sums.unmixed[number(species)];
  mean += sums.mixed[rule * species_ + number(species)];
  return mean * per_frame_and_volume(layer);
}

template <int D>
Vector<D> PartitionedBalance<D>::contact_force(std::size_t layer, Species species) const
{
  return per_frame_and_volume(layer) * sums_[layer].at_centre[number(species)];
}

template <int D>
Tensor<D> PartitionedBalance<D>::unmixed_stress(std::size_t layer, Species species) const
{
  return per_frame_and_volume(layer) * sums_[layer].unmixed[number(species)].stress;
}

template <int D>
Tensor<D> PartitionedBalance<D>::mixed_stress(std::size_t layer) const
{
  return per_frame_and_volume(layer) * sums_[layer].whole;
}

template class PartitionedBalance<2>;
template class PartitionedBalance<3>;

}  // namespace grseg
