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

/// Choice to compare content with its digests while it is read.
enum class Verify { yes, no };

/// Reader of trajectory files (formats/README.md). Sizes, types and filters are checked before
/// anything is read. Each frame is checked when it is read: indices must be in range, and all
/// numbers of present grains finite. Everything read is compared with the digests that the writer
/// stored. Throws UsageError if the file is missing, and FormatError, which names file, path in the
/// file and frame, if its content is wrong. Only committed frames (writer.hpp) are visible, so a
/// file can be read while the run is still being written.
class TrajectoryReader {
 public:
  /// Optional arrays that `read` fills; if false, they stay empty.
  struct Fields {
    bool velocity = true;  // arrays velocity and angular_velocity
    bool contacts = true;
    bool force = false;  // arrays force and image
  };

  /// Result of `load`: compressed rows that `unpack` then unpacks into the arrays of the frame.
  struct Packed {
    std::size_t index = 0;
    Fields fields;
    std::vector<PackedRows> rows;
  };

  explicit TrajectoryReader(const std::string& path, Verify verify = Verify::yes);
  ~TrajectoryReader();
  TrajectoryReader(TrajectoryReader&&) noexcept;

  const std::string& path() const { return run_->path; }
  std::size_t size() const { return run_->size(); }             ///< number of committed frames
  std::size_t contacts() const { return run_->offset.back(); }  ///< number in all committed frames
  const Grains& grains() const { return run_->description.grains; }
  const Box& box() const { return run_->description.box; }
  /// Number of dimensions, 2 or 3; the D of all frames.
  int dimension() const { return box().dimension; }
  /// The mobile species, at least one.
  const SpeciesList& species() const { return run_->description.species; }
  const Parameters& parameters() const { return run_->description.parameters; }
  /// True if frames have forces on grains. False for some imports, whose Frame::force is empty.
  bool has_force() const { return run_->description.has_force; }
  /// True if images of frames count how often grains have crossed a period. False for imports of
  /// archives that do not tell; their images mean nothing.
  bool has_images() const;
  /// True if grains may be absent in some frames (is_present() of core/frame.hpp).
  bool grains_come_and_go() const { return run_->description.grains_come_and_go; }
  /// True if the writer finished and closed the file.
  bool closed() const { return run_->closed(); }

  /// Extent of verification, for the header of tables: "all" or "no (--trust)".
  std::string verified() const { return verify_ == Verify::yes ? "all" : "no (--trust)"; }

  /// Steps and times (s) of the committed frames.
  const std::vector<std::int64_t>& steps() const { return run_->steps; }
  const std::vector<double>& times() const { return run_->times; }

  /// Parameters of the run: smallest and largest nominal diameter (m), time step (s), gravity.
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
  /// The two halves of `read`. `load` uses HDF5, which is not thread-safe. `unpack` decompresses
  /// and verifies the loaded frame without HDF5, so several threads can call it at once.
  template <int D>
  Packed load(std::size_t index, Frame<D>& frame, Fields fields) const;
  template <int D>
  void unpack(const Packed& packed, Frame<D>& frame) const;

  /// The observables of the file, in alphabetical order.
  const std::vector<Observable>& observables() const { return run_->description.observables; }
  /// Values of the observable `name`, one number per committed frame.
  std::vector<double> observable(const std::string& name) const;
  bool has_observable(const std::string& name) const;

  /// Content digest of the run: frame_digest() of the last committed frame, which is chained with
  /// all frames before; 0 without frames.
  std::uint64_t digest() const { return size() == 0 ? 0 : digests().back(); }
  /// frame_digest() of each committed frame (formats/trajectory/digest.hpp).
  const std::vector<std::uint64_t>& digests() const { return run_->chain; }
  /// True if real numbers of grains and contacts are stored in single precision.
  bool stores_float32() const;

  /// One sentence about damage outside frames, "" if there is none; for readers with Verify::no.
  std::string damage_outside_frames() const;
  /// True if `frame`, read with all fields, agrees with its digests.
  template <int D>
  bool is_intact(std::size_t index, const Frame<D>& frame) const;

 private:
  struct Datasets;

  std::unique_ptr<StoredRun> run_;
  std::unique_ptr<Datasets> datasets_;
  Verify verify_;
  mutable bool observables_verified_ = false;
  mutable std::vector<double> parts_;  // s, observable frame_step; read with the first forces
};

}  // namespace grseg
