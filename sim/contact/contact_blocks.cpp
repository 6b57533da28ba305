// SPDX-License-Identifier: GPL-3.0-or-later
#include "sim/contact/contact_blocks.hpp"

#include <bit>

namespace grseg {
namespace {

constexpr std::size_t doubles_per_body = sizeof(Motion) / sizeof(double);

ContactBlock neutral_block(std::size_t idle)
{
  ContactBlock block{};
  block.i.fill(static_cast<std::uint32_t>(idle * doubles_per_body));
  block.j = block.i;
  return block;
}

}  // namespace

void ContactBlocks::pack(std::span<const Contact> contacts, std::span<const Motion> motion,
                         std::size_t idle)
{
  colour(contacts, motion);
  lay_out(idle);
  slot_.resize(contacts.size());
  for (std::size_t k = 0; k < contacts.size(); ++k) {
    auto& next = next_[colour_[k]];
    const std::uint32_t slot = next;
    next += colour_[k] == colours ? block_lanes : 1;
    slot_[k] = slot;
    const auto& c = contacts[k];
    auto& block = blocks_[slot / block_lanes];
    const std::size_t lane = slot % block_lanes;
    block.nx[lane] = c.nx;
    block.ny[lane] = c.ny;
    block.kappa[lane] = c.kappa;
    block.mass_n[lane] = c.mass_n;
    block.mass_t[lane] = c.mass_t;
    block.rebound[lane] = c.rebound;
    block.impulse_n[lane] = c.impulse_n;
    block.impulse_t[lane] = c.impulse_t;
    block.i[lane] = static_cast<std::uint32_t>(static_cast<std::size_t>(c.i) * doubles_per_body);
    block.j[lane] = static_cast<std::uint32_t>(static_cast<std::size_t>(c.j) * doubles_per_body);
  }
}

void ContactBlocks::unpack(std::span<Contact> contacts) const
{
  for (std::size_t k = 0; k < contacts.size(); ++k) {
    const auto& block = blocks_[slot_[k] / block_lanes];
    contacts[k].impulse_n = block.impulse_n[slot_[k] % block_lanes];
    contacts[k].impulse_t = block.impulse_t[slot_[k] % block_lanes];
  }
}

void ContactBlocks::colour(std::span<const Contact> contacts, std::span<const Motion> motion)
{
  taken_.assign(motion.size(), 0);
  colour_.resize(contacts.size());
  sizes_.fill(0);
  for (std::size_t k = 0; k < contacts.size(); ++k) {
    const auto i = static_cast<std::size_t>(contacts[k].i);
    const auto j = static_cast<std::size_t>(contacts[k].j);
    const std::uint64_t taken = taken_[i] | taken_[j];
    const auto first_free = static_cast<std::size_t>(std::countr_one(taken));
    colour_[k] = static_cast<std::uint8_t>(first_free);
    ++sizes_[first_free];
    const std::uint64_t bit = first_free < colours ? std::uint64_t{1} << first_free : 0;
    taken_[i] |= motion[i].inverse_mass > 0 ? bit : 0;
    taken_[j] |= motion[j].inverse_mass > 0 ? bit : 0;
  }
}

void ContactBlocks::lay_out(std::size_t idle)
{
  std::uint32_t count = 0;
  ends_.clear();
  for (std::size_t c = 0; c < colours; ++c) {
    next_[c] = count * block_lanes;
    count += (sizes_[c] + block_lanes - 1) / block_lanes;
    if (sizes_[c] > 0) ends_.push_back(count);
  }
  next_[colours] = count * block_lanes;
  for (std::uint32_t k = 0; k < sizes_[colours]; ++k) ends_.push_back(++count);
  blocks_.resize(count);
  const auto neutral = neutral_block(idle);
  for (std::size_t c = 0; c < colours; ++c)
    if (sizes_[c] % block_lanes != 0) blocks_[(next_[c] + sizes_[c]) / block_lanes] = neutral;
  for (auto b = next_[colours] / block_lanes; b < count; ++b) blocks_[b] = neutral;
}

}  // namespace grseg
