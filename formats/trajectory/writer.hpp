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
  int compression = 0;   ///< deflate level; must be 0 for `live` files
  bool float32 = false;  ///< true: half the file size, but force balances close only to 1e-6
  /// True: each appended frame is in the file at once, survives a kill at any time, and can be
  /// read while the run goes on (HDF5's SWMR mode). False: the file can be read after its closing.
  bool live = false;
  std::size_t contact_chunk = 8192;  ///< rows per chunk of contact datasets
  std::size_t scalar_chunk = 1024;   ///< frames per chunk of datasets with one number per frame
};

/// Writer of trajectory files (formats/README.md), frame by frame. A frame is committed by adding
/// the end of its contacts to /grseg/contacts/offset, after everything else has been flushed to the
/// file. Readers see only committed frames. Throws RunError if the file cannot be written.
///
/// A live file gets its final name as soon as it can be read. Its description must contain the
/// parameters that are known only at the end (is_known_at_end()), with the right number of values;
/// the values are placeholders.
class TrajectoryWriter {
 public:
  TrajectoryWriter(const std::string& path, const RunDescription& run,
                   const StorageSettings& storage = {});
  ~TrajectoryWriter();
  TrajectoryWriter(TrajectoryWriter&&) noexcept;

  /// Appends a frame. `observables` has one value per entry of RunDescription::observables.
  template <int D>
  void append(const Frame<D>& frame, std::span<const double> observables);

  /// Passes all frames so far to the system, so that a kill cannot lose them.
  void flush();

  std::size_t frames() const;    ///< number of frames appended so far
  std::uint64_t digest() const;  ///< frame_digest() of the last of these frames

  /// Adds or replaces parameters that are known only at the end, such as the summary of the run.
  void add_parameters(const Parameters& parameters);

  /// Seals, flushes and closes the file; throws the errors that a destructor would have to ignore.
  void close();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Returns a writer to the new file `to` that has already copied the first `frames` frames of
/// `run`. The file has these `parameters` and these `observables` of `run`, in the given order.
TrajectoryWriter copy_frames(const TrajectoryReader& run, std::size_t frames, const std::string& to,
                             const Parameters& parameters,
                             const std::vector<Observable>& observables,
                             const StorageSettings& storage);

/// Copies the run in the file `from` to `to` with another `storage`, e.g. to compress a finished
/// run. Numbers and content digest stay the same unless `storage` changes the precision.
void repack(const std::string& from, const std::string& to, const StorageSettings& storage);

}  // namespace grseg
