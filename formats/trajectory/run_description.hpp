// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/core/frame.hpp"
#include "formats/core/parameters.hpp"
#include "formats/core/species.hpp"
#include "formats/trajectory/digest.hpp"

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace grseg {

/// Description of a run: the content of a trajectory file that does not belong to frames.
struct RunDescription {
  Grains grains;
  Box box;
  Parameters parameters;
  std::vector<Observable> observables;
  bool has_force = true;            // false: no frame has forces on grains (some imports)
  SpeciesList species = {};         // mobile species; empty: small and large
  bool grains_come_and_go = false;  // true: a grain may be absent in a frame (core/frame.hpp)
};

/// Mobile species of a run, at least one. If the description lists none: small and large with the
/// diameters in /parameters (0 if missing).
inline SpeciesList species_of(const RunDescription& run)
{
  if (!run.species.empty()) return run.species;
  return two_sizes(run.parameters.find_number("small_diameter").value_or(0),
                   run.parameters.find_number("large_diameter").value_or(0));
}

/// True for parameters that are known only when a run has ended: `complete` and summary_*. The seal
/// covers these parameters, the static digest all others.
bool is_known_at_end(const std::string& parameter);

/// Digest of box, grains, species, names and units of observables, and parameters.
std::uint64_t static_digest(const RunDescription& run);

/// Seal of a file, written when the file is closed; all zeros before. It covers the numbers of
/// frames and contacts and all parameters that are known only at the end.
struct Seal {
  std::uint64_t frames = 0, contacts = 0;
  std::uint64_t chain = 0;   // frame_digest() of the last frame
  std::uint64_t digest = 0;  // of frames, contacts, chain, static_digest, end parameters

  using Numbers = std::array<std::uint64_t, 4>;
  Numbers numbers() const { return {frames, contacts, chain, digest}; }
};

Seal make_seal(std::uint64_t frames, std::uint64_t contacts, std::uint64_t chain,
               std::uint64_t static_digest, const Parameters& parameters);

/// Content of a trajectory file apart from the data of its frames.
struct StoredRun {
  std::string path;
  RunDescription description;
  std::vector<std::int64_t> steps;
  std::vector<double> times;
  std::vector<std::uint64_t> offset;  // contacts of frame k: rows offset[k] to offset[k + 1] - 1
  std::vector<std::uint64_t> chain;   // frame_digest() of each frame
  std::vector<FieldDigests> field_digests;
  std::uint64_t static_digest = 0;
  Seal::Numbers seal{};

  /// Number of committed frames.
  std::size_t size() const { return offset.size() - 1; }
  bool closed() const { return seal != Seal{}.numbers(); }
  /// Throws FormatError with the name of the file before `why`.
  [[noreturn]] void fail(const std::string& why) const;
};

}  // namespace grseg
