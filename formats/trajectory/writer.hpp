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

/// What a trajectory file says once.
struct RunDescription {
  Grains grains;
  Box box;
  Parameters parameters;
  std::vector<Observable> observables;
  bool has_force = true;  // false: no frame has forces on grains, as of some imports
};

struct StorageSettings {
  /// Deflate level; 0 stores plainly, and then a kill at any moment leaves the committed frames
  /// readable. A compressed file is whole only once it is closed: runs are compressed when they
  /// have ended (repack.hpp).
  int compression = 0;
  bool float32 = false;  ///< halves the file; contact balances then close to 1e-6 only
};

/// Writes a trajectory file (formats/README.md) frame by frame. A frame counts once its end is
/// entered in /grseg/contacts/offset, which is done last and after all else is on its way to the
/// file; until then readers do not see it. Throws RunError when the file cannot be written.
class TrajectoryWriter {
 public:
  TrajectoryWriter(const std::string& path, const RunDescription& run,
                   const StorageSettings& storage = {});
  ~TrajectoryWriter();
  TrajectoryWriter(TrajectoryWriter&&) noexcept;

  /// `observables` holds one value per entry of RunDescription::observables.
  void append(const Frame& frame, std::span<const double> observables);

  /// Hands all frames appended so far to the system, where a kill cannot lose them.
  void flush();

  std::size_t frames() const;    ///< appended so far
  std::uint64_t digest() const;  ///< xxh3 chain up to the last of them, as in TrajectoryReader

  /// Adds to /parameters what is known only at the end (summary of the run).
  void add_parameters(const Parameters& parameters);

  /// Flushes to disk and closes; errors that a destructor must swallow are thrown here.
  void close();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace grseg
