// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/balance/momentum_balance.hpp"

#include "analysis/frames/contact_force.hpp"
#include "formats/core/pair_type.hpp"

#include <algorithm>
#include <cassert>

namespace grseg {
namespace {

constexpr std::array tensors{&SpeciesMomentum::contact_stress, &SpeciesMomentum::momentum_flux};
constexpr std::array vectors{&SpeciesMomentum::momentum, &SpeciesMomentum::rate,
                             &SpeciesMomentum::gravity,  &SpeciesMomentum::contact,
                             &SpeciesMomentum::kinetic,  &SpeciesMomentum::interaction,
                             &SpeciesMomentum::base,     &SpeciesMomentum::force};

std::size_t index(Species species)
{
  return static_cast<std::size_t>(species);
}

}  // namespace

SpeciesMomentum& SpeciesMomentum::operator+=(const SpeciesMomentum& other)
{
  density += other.density;
  for (const auto member : tensors) this->*member += other.*member;
  for (const auto member : vectors) this->*member += other.*member;
  return *this;
}

SpeciesMomentum& SpeciesMomentum::operator*=(double factor)
{
  density *= factor;
  for (const auto member : tensors) this->*member *= factor;
  for (const auto member : vectors) this->*member *= factor;
  return *this;
}

Vec2 MomentumBalance::Instant::at(std::size_t layer, Species species) const
{
  return layer < momentum.size() ? momentum[layer][index(species)] : Vec2(0, 0);
}

MomentumBalance::MomentumBalance(const Layers& layers, const Kernel& kernel,
                                 const Gravity<2>& gravity, double step)
    : layers_(layers), kernel_(kernel), gravity_(gravity), step_(step)
{
}

void MomentumBalance::add(const Grains& grains, const Frame<2>& frame)
{
  assert(frame.force.size() == grains.size());
  ++frames_;
  // The layers of this frame alone, so that its sums do not depend on the frames before it.
  const std::size_t count = layers_.count(grains, frame);
  sums_.resize(std::max(sums_.size(), count));
  pull_.assign(grains.size(), Vec2::Zero());
  for (std::size_t k = 0; k < frame.contacts.size(); ++k) add_contact(grains, frame, k, count);
  const Vec2 gravity = gravity_.at(frame.time);
  Instant before{frame.time, {count, {Vec2::Zero(), Vec2::Zero()}}};
  for (std::size_t g = 0; g < grains.size(); ++g)
    if (is_mobile(grains, g)) add_grain(grains, frame, g, gravity, before);
  if (!first_) first_ = before;
  last_ = std::move(before);
}

void MomentumBalance::add_contact(const Grains& grains, const Frame<2>& frame, std::size_t contact,
                                  std::size_t count)
{
  const auto& list = frame.contacts;
  if (!bears_force(list, contact)) return;
  const Vec2& force = list.force[contact];
  const auto type = pair_type(grains, frame, contact);
  const bool at_base = type == PairType::Sb || type == PairType::Lb;
  const auto i = static_cast<std::size_t>(list.i[contact]);
  const double y_i = frame.position[i].y(), share_i = share_of_first(grains, list, contact);
  const double y_contact = y_i - share_i * list.branch[contact].y();
  const Tensor2 stress = force * list.branch[contact].transpose();
  // At the contact point a force from outside the species counts as that term, not as stress.
  const auto add_external = [&](Species species, const Vec2& on, Vec2 SpeciesMomentum::*term) {
    share_kernel(layers_, kernel_, y_contact, y_contact, count, [&](std::size_t n, double share) {
      auto& sums = sums_[n][index(species)];
      sums.contact -= share * on;
      sums.*term += share * on;
    });
  };

  pull_[i] += force;
  if (at_base) {
    add_external(grains.species[i], force, &SpeciesMomentum::base);
    return add_stress(grains.species[i], share_i * stress, y_i, y_contact, count);
  }
  const auto j = static_cast<std::size_t>(list.j[contact]);
  const double y_j = frame.position[j].y();
  pull_[j] -= force;
  if (type != PairType::LS) return add_stress(grains.species[i], stress, y_i, y_j, count);
  add_external(grains.species[i], force, &SpeciesMomentum::interaction);
  add_external(grains.species[j], -force, &SpeciesMomentum::interaction);
  add_stress(grains.species[i], share_i * stress, y_i, y_contact, count);
  add_stress(grains.species[j], (1 - share_i) * stress, y_contact, y_j, count);
}

void MomentumBalance::add_stress(Species species, const Tensor2& force_by_arm, double from,
                                 double to, std::size_t count)
{
  share_kernel(layers_, kernel_, from, to, count, [&](std::size_t n, double share) {
    sums_[n][index(species)].contact_stress += share * force_by_arm;
  });
}

void MomentumBalance::add_grain(const Grains& grains, const Frame<2>& frame, std::size_t grain,
                                const Vec2& gravity, Instant& before)
{
  const std::size_t species = index(grains.species[grain]), count = before.momentum.size();
  const double mass = grains.mass[grain], y = frame.position[grain].y();
  const Vec2 &velocity = frame.velocity[grain], &force = frame.force[grain];
  const Vec2 momentum = mass * velocity, momentum_before = momentum - step_ * force;
  share_kernel(layers_, kernel_, y, y, count, [&](std::size_t n, double share) {
    auto& sums = sums_[n][species];
    sums.density += share * mass;
    sums.momentum += share * momentum;
    sums.momentum_flux += share * momentum * velocity.transpose();
    sums.gravity += share * mass * gravity;
    sums.contact += share * pull_[grain];
    sums.force += share * force;
    sums.rate -= share / step_ * momentum_before;
    sums.kinetic -= share / step_ * momentum;
    before.momentum[n][species] += share * momentum_before;
  });
  const double y_next = y + step_ * velocity.y();
  share_kernel(layers_, kernel_, y_next, y_next, count, [&](std::size_t n, double share) {
    sums_[n][species].rate += share / step_ * momentum;
    sums_[n][species].kinetic += share / step_ * momentum;
  });
}

void MomentumBalance::merge(const MomentumBalance& later)
{
  frames_ += later.frames_;
  sums_.resize(std::max(sums_.size(), later.sums_.size()));
  for (std::size_t n = 0; n < later.sums_.size(); ++n)
    for (std::size_t species = 0; species < 2; ++species)
      sums_[n][species] += later.sums_[n][species];
  if (!first_) first_ = later.first_;
  if (later.last_) last_ = later.last_;
}

SpeciesMomentum MomentumBalance::mean(std::size_t layer, Species species) const
{
  auto mean = sums_[layer][index(species)];
  mean *= 1 / (static_cast<double>(frames_) * layers_.volume(layer));
  return mean;
}

Vec2 MomentumBalance::change(std::size_t layer, Species species) const
{
  const Vec2 gained = last_->at(layer, species) - first_->at(layer, species);
  return gained / ((last_->time - first_->time) * layers_.volume(layer));
}

}  // namespace grseg
