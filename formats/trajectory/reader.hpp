// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/core/frame.hpp"
#include "formats/trajectory/chunk.hpp"
#include "formats/trajectory/run_description.hpp"

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace grseg {

/// Comparison of content with its digests while it is read.
enum class Verify { yes, no };

/// Reads a trajectory file (formats/README.md). Sizes, types and filters are checked before
/// anything is read. Frames are checked while they are read: indices are in range, and all numbers
/// of present grains are finite. Everything read is compared with the digests that the writer left.
/// Throws UsageError where the file is missing, and FormatError naming file, path in the file and
/// frame where its content is wrong. Only committed frames are visible; the run may still be going
/// on.
class TrajectoryReader {
 public:
  /// Arrays that `read` fills; the others stay empty.
  struct Fields {
    bool velocity = true;  // velocity, angular_velocity
    bool contacts = true;
    bool force = false;  // force and image
  };

  /// Compressed rows that `load` leaves to be unpacked into the arrays of its frame.
  struct Packed {
    std::size_t index = 0;
    Fields fields;
    std::vector<PackedRows> rows;
  };

  explicit TrajectoryReader(const std::string& path, Verify verify = Verify::yes);
  ~TrajectoryReader();
  TrajectoryReader(TrajectoryReader&&) noexcept;

  const std::string& path() const { return run_->path; }
  std::size_t size() const { return run_->size(); }             ///< committed frames
  std::size_t contacts() const { return run_->offset.back(); }  ///< of all committed frames
  const Grains& grains() const { return run_->description.grains; }
  const Box& box() const { return run_->description.box; }
  /// 2 or 3, the D of all its frames.
  int dimension() const { return box().dimension; }
  /// Its mobile species, at least one.
  const SpeciesList& species() const { return run_->description.species; }
  const Parameters& parameters() const { return run_->description.parameters; }
  /// False for some imports; `force` of their frames is empty.
  bool has_force() const { return run_->description.has_force; }
  /// True where a grain may be absent in a frame (is_present() of core/frame.hpp).
  bool grains_come_and_go() const { return run_->description.grains_come_and_go; }
  /// True where the writer came to the end and closed the file.
  bool closed() const { return run_->closed(); }

  /// Extent of verification, for tables: "all" or "no (--trust)".
  std::string verified() const { return verify_ == Verify::yes ? "all" : "no (--trust)"; }

  /// Steps and times (s) of the committed frames.
  const std::vector<std::int64_t>& steps() const { return run_->steps; }
  const std::vector<double>& times() const { return run_->times; }

  /// Shorthands for /parameters: the smallest and largest nominal diameter (m), step (s), gravity.
  double small_diameter() const { return parameters().number("small_diameter", path()); }
  double large_diameter() const { return parameters().number("large_diameter", path()); }
  double step() const { return parameters().number("step", path()); }
  template <int D>
  Gravity<D> gravity() const;

  template <int D>
  void read(std::size_t index, Frame<D>& frame, Fields fields) const
  {
    unpack(load(index, frame, fields), frame);
  }
  template <int D>
  void read(std::size_t index, Frame<D>& frame) const
  {
    read(index, frame, Fields{});
  }
  /// The two halves of `read`. `load` uses HDF5, which knows no threads. `unpack` decompresses and
  /// verifies the frame that was loaded, without HDF5, so that several threads can call it at once.
  template <int D>
  Packed load(std::size_t index, Frame<D>& frame, Fields fields) const;
  template <int D>
  void unpack(const Packed& packed, Frame<D>& frame) const;

  /// The observables of the file, in alphabetical order.
  const std::vector<Observable>& observables() const { return run_->description.observables; }
  /// One number per committed frame from /observables.
  std::vector<double> observable(const std::string& name) const;
  bool has_observable(const std::string& name) const;

  /// xxh3 chain up to and including the last committed frame: the content digest of the run.
  std::uint64_t digest() const { return size() == 0 ? 0 : digests().back(); }
  /// The chain itself, one entry per committed frame (formats/trajectory/digest.hpp).
  const std::vector<std::uint64_t>& digests() const { return run_->chain; }
  /// True where the numbers of grains and contacts are stored in single precision.
  bool stores_float32() const;

  /// Damage outside frames in one sentence, or "", for a reader that does not verify.
  std::string damage_outside_frames() const;
  /// True where `frame`, read whole, agrees with its digest.
  template <int D>
  bool is_intact(std::size_t index, const Frame<D>& frame) const;

 private:
  struct Datasets;

  std::unique_ptr<StoredRun> run_;
  std::unique_ptr<Datasets> datasets_;
  Verify verify_;
  mutable bool observables_verified_ = false;
  mutable std::vector<double> parts_;  // observable frame_step, once a frame with forces is read
};

}  // namespace grseg
