// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/import/convert/imported_bed.hpp"
#include "formats/import/convert/inferred_walls.hpp"
#include "formats/import/convert/scan.hpp"
#include "formats/import/verify/verification.hpp"

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>

namespace grseg {

/// The moments of an archive as frames, each verified, in the archive's units.
class VerifiedFrames {
 public:
  VerifiedFrames(ScannedArchive scanned, const ImportSettings& settings);
  VerifiedFrames(const VerifiedFrames&) = delete;
  VerifiedFrames& operator=(const VerifiedFrames&) = delete;

  /// Before the first `next`: leaves out that many moments, of which only grains are read but of the
  /// last, with which velocities of the next one are compared.
  void skip(std::size_t moments);
  /// False at the end. `complaint` then says what is wrong with the frame, if anything.
  bool next(Frame<3>& frame);
  const std::optional<Complaint>& complaint() const { return complaint_; }
  const std::optional<Residual>& residual() const { return verification_.residual(); }
  /// The checks' memory of the last frame, in the archive's units.
  const CheckMoment& moment() const { return verification_.moment(); }
  const std::string& place() const { return scanned_.moment.place; }

  const ScannedArchive& scanned() const { return scanned_; }
  const Archive& archive() const { return scanned_.archive(); }
  const RunFacts& facts() const { return scanned_.facts; }
  const ImportedBed& bed() const { return bed_; }
  const Waivers& waivers() const { return waivers_; }
  /// The walls of --wall; null where there are none.
  const InferredWalls* walls() const { return walls_.get(); }

 private:
  ScannedArchive scanned_;
  Waivers waivers_;
  ImportedBed bed_;
  std::unique_ptr<InferredWalls> walls_;
  Verification verification_;
  std::optional<Complaint> complaint_;
  std::optional<std::pair<std::int64_t, double>> last_;  // step and time of the frame before
  bool first_ = true;
};

}  // namespace grseg
