// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/trajectory/run_description.hpp"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace grseg {

class TrajectoryReader;

struct StorageSettings {
  int compression = 0;   ///< deflate level; not while `live`
  bool float32 = false;  ///< halves the file; contact balances then close to 1e-6 only
  /// Each appended frame is in the file at once: it survives a kill at any moment and can be read
  /// meanwhile (HDF5's SWMR mode). Otherwise a file can be read once it has been closed.
  bool live = false;
  std::size_t contact_chunk = 8192;  ///< contacts that are stored together
  std::size_t scalar_chunk = 1024;   ///< frames whose single numbers are stored together
};

/// Writes a trajectory file (formats/README.md) frame by frame. A frame counts once its end is
/// entered in /grseg/contacts/offset, which is done last, after everything else has been flushed to
/// the file; until then readers do not see it. Throws RunError when the file cannot be written.
///
/// A live file gets its name once it can be read. Parameters that are known only at its end
/// (run_description.hpp) must be in the description, as numbers of which only the count matters.
class TrajectoryWriter {
 public:
  TrajectoryWriter(const std::string& path, const RunDescription& run,
                   const StorageSettings& storage = {});
  ~TrajectoryWriter();
  TrajectoryWriter(TrajectoryWriter&&) noexcept;

  /// `observables` holds one value per entry of RunDescription::observables.
  template <int D>
  void append(const Frame<D>& frame, std::span<const double> observables);

  /// Hands all frames so far to the system, so that a kill cannot lose them.
  void flush();

  std::size_t frames() const;    ///< appended so far
  std::uint64_t digest() const;  ///< xxh3 chain up to the last of them, as in TrajectoryReader

  /// Adds or replaces entries of /parameters that are known only at the end, such as the summary of
  /// the run.
  void add_parameters(const Parameters& parameters);

  /// Seals, flushes and closes the file; throws the errors that a destructor would have to ignore.
  void close();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// A writer of the file `to` that begins with the first `frames` frames of `run`, takes
/// `observables`, which `run` must have, in this order, and has the given `parameters`.
TrajectoryWriter copy_frames(const TrajectoryReader& run, std::size_t frames, const std::string& to,
                             const Parameters& parameters,
                             const std::vector<Observable>& observables,
                             const StorageSettings& storage);

/// Copies the run in the file `from` to `to` with another `storage`; this is how a finished run is
/// compressed. Numbers and content digest stay the same, if a file in single precision stays in
/// single precision.
void repack(const std::string& from, const std::string& to, const StorageSettings& storage);

}  // namespace grseg
