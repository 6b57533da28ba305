// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/trajectory/run_description.hpp"

#include <array>
#include <cstdint>
#include <string>

/// What vouches for the part of a trajectory file that is not in frames (formats/README.md).
namespace grseg {

/// Whether a parameter is known only when a run has ended: `complete` and summary_*. The seal
/// vouches for these, the static digest for all others.
bool is_known_at_end(const std::string& parameter);

/// Of box, grains, species, names and units of observables, and parameters.
std::uint64_t static_digest(const RunDescription& run);

/// Written when the file is closed: it vouches for the number of frames and for what is known only
/// then. All zeros before.
struct Seal {
  std::uint64_t frames = 0, contacts = 0;
  std::uint64_t chain = 0;   // frame_digest of the last frame
  std::uint64_t digest = 0;  // of the three, the static digest and the parameters known at the end

  using Numbers = std::array<std::uint64_t, 4>;
  Numbers numbers() const { return {frames, contacts, chain, digest}; }
};

Seal make_seal(std::uint64_t frames, std::uint64_t contacts, std::uint64_t chain,
               std::uint64_t static_digest, const Parameters& parameters);

}  // namespace grseg
