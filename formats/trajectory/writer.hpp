// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/core/frame.hpp"
#include "formats/core/parameters.hpp"

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace grseg {

/// What a trajectory file holds once.
struct RunDescription {
  Grains grains;
  Box box;
  Parameters parameters;
  std::vector<Observable> observables;
  bool has_force = true;  // false: no frame has forces on grains, as in some imports
};

struct StorageSettings {
  /// Deflate level. With 0 (no compression) a kill at any moment leaves the committed frames
  /// readable; a compressed file is complete only when it has been closed, so runs are compressed
  /// when they have ended (repack.hpp).
  int compression = 0;
  bool float32 = false;  ///< halves the file; contact balances then close to 1e-6 only
};

/// Writes a trajectory file (formats/README.md) frame by frame. A frame counts once its end is
/// entered in /grseg/contacts/offset, which is done last, after everything else has been flushed to
/// the file; until then readers do not see it. Throws RunError when the file cannot be written.
class TrajectoryWriter {
 public:
  TrajectoryWriter(const std::string& path, const RunDescription& run,
                   const StorageSettings& storage = {});
  ~TrajectoryWriter();
  TrajectoryWriter(TrajectoryWriter&&) noexcept;

  /// `observables` holds one value per entry of RunDescription::observables.
  void append(const Frame& frame, std::span<const double> observables);

  /// Hands all frames so far to the system, so that a kill cannot lose them.
  void flush();

  std::size_t frames() const;    ///< appended so far
  std::uint64_t digest() const;  ///< xxh3 chain up to the last of them, as in TrajectoryReader

  /// Adds to /parameters what is known only at the end, such as the summary of the run.
  void add_parameters(const Parameters& parameters);

  /// Flushes and closes the file; throws the errors that a destructor would have to ignore.
  void close();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace grseg
