// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "sim/contact/contact_blocks.hpp"
#include "sim/solver/solver.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

/// Contacts in a plain list, as tests write them: packed into blocks, solved, and checked.
namespace grseg {

/// Contacts sorted by colour into blocks. Colours are assigned by first fit in the order of the
/// contacts: a contact gets the first colour that neither of its mobile bodies has yet, so the same
/// contacts always get the same colours. Immobile bodies (inverse mass 0) do not use up colours,
/// because their values are written back unchanged. Unused lanes of a colour's last block contain a
/// neutral contact (masses and impulses 0) of the idle body with itself.
class ContactBlocks {
 public:
  /// `idle` is the index of an immobile entry of `motion`.
  void pack(std::span<const Contact<2>> contacts, std::span<const Motion<2>> motion,
            std::size_t idle);
  /// Writes the impulses back to the contacts they came from.
  void unpack(std::span<Contact<2>> contacts) const;

  std::span<ContactBlock<2>> blocks() { return blocks_; }
  BlockRuns<2> runs() { return {blocks_, ends_}; }
  /// Position of each contact: 8 * block + lane. Sweeps relax contacts in this order.
  std::span<const std::uint32_t> slots() const { return slot_; }
  /// Number of contacts of each colour. The last entry counts contacts without a colour, because a
  /// body has more contacts than there are colours. Each of these has its own block.
  static constexpr std::size_t colours = 64;
  std::span<const std::uint32_t> sizes() const { return sizes_; }

 private:
  void colour(std::span<const Contact<2>> contacts, std::span<const Motion<2>> motion);
  void lay_out(std::size_t idle);

  std::vector<ContactBlock<2>> blocks_;
  std::vector<std::uint32_t> ends_;   // ends of the blocks of a colour, and of each block without
  std::vector<std::uint64_t> taken_;  // by body, one bit per colour
  std::vector<std::uint8_t> colour_;  // colour by contact
  std::vector<std::uint32_t> slot_;   // slot by contact
  std::array<std::uint32_t, colours + 1> sizes_{};
  std::array<std::uint32_t, colours + 1> next_{};  // next free slot of each colour
};

inline ContactBlock<2> neutral_block(std::size_t idle)
{
  ContactBlock<2> block{};
  block.i.fill(static_cast<std::uint32_t>(idle * numbers_per_body<2>));
  block.j = block.i;
  return block;
}

inline void ContactBlocks::pack(std::span<const Contact<2>> contacts,
                                std::span<const Motion<2>> motion, std::size_t idle)
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
    block.n[0][lane] = c.n[0];
    block.n[1][lane] = c.n[1];
    block.kappa[lane] = c.kappa;
    block.mass_n[lane] = c.mass_n;
    block.mass_t[lane] = c.mass_t;
    block.rebound[lane] = c.rebound;
    block.impulse_n[lane] = c.impulse_n;
    block.impulse_t[0][lane] = c.impulse_t[0];
    block.i[lane] = static_cast<std::uint32_t>(static_cast<std::size_t>(c.i) * numbers_per_body<2>);
    block.j[lane] = static_cast<std::uint32_t>(static_cast<std::size_t>(c.j) * numbers_per_body<2>);
  }
}

inline void ContactBlocks::unpack(std::span<Contact<2>> contacts) const
{
  for (std::size_t k = 0; k < contacts.size(); ++k) {
    const auto& block = blocks_[slot_[k] / block_lanes];
    contacts[k].impulse_n = block.impulse_n[slot_[k] % block_lanes];
    contacts[k].impulse_t[0] = block.impulse_t[0][slot_[k] % block_lanes];
  }
}

inline void ContactBlocks::colour(std::span<const Contact<2>> contacts,
                                  std::span<const Motion<2>> motion)
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

inline void ContactBlocks::lay_out(std::size_t idle)
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

/// Calls solve_contacts() for contacts in any order.
inline SolverReport solve_contacts(std::vector<Contact<2>>& contacts,
                                   std::vector<Motion<2>>& motion, double friction, Effects effects,
                                   const SolverSettings& settings, const ReferenceRange& range)
{
  if (!effects.friction)
    for (auto& c : contacts) c.impulse_t[0] = 0;
  const std::size_t bodies = motion.size();
  motion.emplace_back();  // the idle body of unused lanes
  ContactBlocks packed;
  packed.pack(contacts, motion, bodies);
  const std::array strips{packed.runs()};
  SolverMemory<2> memory;
  const auto report = solve_contacts<2>(
      strips, motion, {contacts.size(), friction, effects, settings, range}, memory);
  motion.pop_back();
  packed.unpack(contacts);
  return report;
}

/// Largest violation (m/s) of Signorini's and Coulomb's conditions, for a state from any solver:
/// the change that relaxing a single contact would make.
inline double contact_residual(const std::vector<Contact<2>>& contacts,
                               const std::vector<Motion<2>>& motion, double friction,
                               Effects effects)
{
  const auto relax_alone = choose_relax<2>(effects);
  double largest = 0;
  for (auto alone : contacts) {
    auto a = motion[static_cast<std::size_t>(alone.i)],
         b = motion[static_cast<std::size_t>(alone.j)];
    if (!effects.restitution) alone.rebound = 0;
    const auto change = relax_alone(alone, a, b, friction);
    largest = std::max({largest, change.change_n, std::abs(change.change_t[0])});
  }
  return largest;
}

}  // namespace grseg
