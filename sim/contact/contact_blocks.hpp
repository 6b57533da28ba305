// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "sim/contact/contact_law.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace grseg {

/// As many contacts as the widest vector has doubles. The number is the same on every instruction
/// set, so that sums over lanes are too; narrower vectors take a block in parts.
constexpr std::uint32_t block_lanes = 8;

/// Eight contacts of one colour, lane by lane: no mobile body appears in two of them, so they may
/// be relaxed at the same time. Members as in Contact.
struct alignas(64) ContactBlock {
  using Lanes = std::array<double, block_lanes>;
  Lanes nx, ny, kappa, mass_n, mass_t, rebound, impulse_n, impulse_t;
  /// Where the bodies' entries begin, counted in doubles from the first Motion.
  std::array<std::uint32_t, block_lanes> i, j;
};

/// Blocks in the order in which they are relaxed. They come in runs, one behind the other; no two
/// blocks of a run share a mobile body, so what one of them reads does not wait for the others.
struct BlockRuns {
  std::span<ContactBlock> blocks;
  std::span<const std::uint32_t> ends;  // of the runs, in blocks
};

/// Contacts sorted by colour into blocks. First-fit colours in the order of the contacts: a contact
/// takes the first colour that neither of its mobile bodies has yet, so the same contacts always
/// get the same colours. Immobile bodies (inverse mass 0) take no colour, since what is written to
/// them is what was there. Lanes that a colour's last block has left over hold a neutral contact
/// (masses and impulses 0) of the idle body with itself.
class ContactBlocks {
 public:
  /// `idle` is the index of an immobile entry of `motion`.
  void pack(std::span<const Contact> contacts, std::span<const Motion> motion, std::size_t idle);
  /// Writes the impulses back to the contacts they came from.
  void unpack(std::span<Contact> contacts) const;

  std::span<ContactBlock> blocks() { return blocks_; }
  BlockRuns runs() { return {blocks_, ends_}; }
  /// Where each contact went: 8 * block + lane. Sweeps relax contacts in this order.
  std::span<const std::uint32_t> slots() const { return slot_; }
  /// Number of contacts of each colour; the last entry counts those left without a colour because
  /// a body has more contacts than there are colours. Each of these has a block to itself.
  static constexpr std::size_t colours = 64;
  std::span<const std::uint32_t> sizes() const { return sizes_; }

 private:
  void colour(std::span<const Contact> contacts, std::span<const Motion> motion);
  void lay_out(std::size_t idle);

  std::vector<ContactBlock> blocks_;
  std::vector<std::uint32_t> ends_;   // of a colour's blocks, and of each block left without
  std::vector<std::uint64_t> taken_;  // per body, a bit per colour
  std::vector<std::uint8_t> colour_;  // per contact
  std::vector<std::uint32_t> slot_;   // per contact
  std::array<std::uint32_t, colours + 1> sizes_{};
  std::array<std::uint32_t, colours + 1> next_{};  // free slot of each colour
};

}  // namespace grseg
