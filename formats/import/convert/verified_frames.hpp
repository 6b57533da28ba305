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

/// Converts frames of an archive to frames of a trajectory, in the archive's units; verifies each.
class VerifiedFrames {
 public:
  VerifiedFrames(ScannedArchive scanned, const ImportSettings& settings);
  VerifiedFrames(const VerifiedFrames&) = delete;
  VerifiedFrames& operator=(const VerifiedFrames&) = delete;

  /// Reads the next frame; false at the end. complaint() then describes the frame's error, if any.
  bool next(Frame<3>& frame);
  const std::optional<Complaint>& complaint() const { return complaint_; }
  const std::optional<Residual>& residual() const { return verification_.residual(); }
  /// Quantities that the checks compute from the last frame, in the archive's units.
  const CheckNumbers& numbers() const { return verification_.numbers(); }
  const std::string& place() const { return scanned_.frame.place; }

  const ScannedArchive& scanned() const { return scanned_; }
  const Archive& archive() const { return scanned_.archive(); }
  const RunFacts& facts() const { return scanned_.facts; }
  const ImportedBed& bed() const { return bed_; }
  const Waivers& waivers() const { return waivers_; }
  /// The walls given by --wall; null if there are none.
  const InferredWalls* walls() const { return walls_.get(); }

 private:
  ScannedArchive scanned_;
  Waivers waivers_;
  ImportedBed bed_;
  std::unique_ptr<InferredWalls> walls_;
  Verification verification_;
  std::optional<Complaint> complaint_;
  std::optional<std::pair<std::int64_t, double>> last_;  // step and time of the previous frame
  bool first_ = true;
};

}  // namespace grseg
