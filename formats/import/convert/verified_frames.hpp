// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/import/convert/frame_builder.hpp"
#include "formats/import/convert/inferred_walls.hpp"
#include "formats/import/convert/scan.hpp"
#include "formats/import/verify/verification.hpp"

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>

namespace grseg {

/// What the first moment of an archive has.
struct OwnFacts {
  bool masses = false;  // of every grain
  std::string times;    // "steps", "times" or "both": what its moments are known by
};

/// The moments of an archive as frames, each verified, in the archive's units. D is the dimension
/// of its facts.
template <int D>
class VerifiedFrames {
 public:
  VerifiedFrames(OpenedArchive opened, const ImportSettings& settings);

  /// Before the first `next`: leaves out that many moments, of which only grains are read.
  void skip(std::size_t moments);
  /// False at the end. `complaint` then says what is wrong with the frame, if anything.
  bool next(Frame<D>& frame);
  const std::optional<Complaint>& complaint() const { return complaint_; }
  const std::optional<Residual>& residual() const { return verification_.residual(); }
  /// Of the last frame, in the archive's units.
  const CheckMoment& moment() const { return verification_.moment(); }
  const std::string& place() const { return opened_.moment.place; }

  const Archive& archive() const { return opened_.archive(); }
  const std::shared_ptr<const Roster>& roster() const { return opened_.roster(); }
  /// Sentences on the parts of the archive that are left out so far.
  std::vector<std::string> remarks() const
  {
    auto remarks = archive().remarks();
    for (auto& of_moments : opened_.remarks()) remarks.push_back(std::move(of_moments));
    return remarks;
  }
  const RunFacts& facts() const { return opened_.facts; }
  const FrameBuilder& builder() const { return *builder_; }
  /// Those of --wall; null where there are none.
  const InferredWalls<D>* walls() const { return walls_.get(); }
  double tolerance() const { return waivers_.limit("balance", archive().facts().tolerance); }
  const Waivers& waivers() const { return waivers_; }
  const OwnFacts& own() const { return own_; }
  bool has_force() const { return has_force_; }
  bool has_angular_velocity() const { return has_angular_velocity_; }

 private:
  OpenedArchive opened_;
  Waivers waivers_;
  OwnFacts own_;
  std::unique_ptr<FrameBuilder> builder_;    // where the verification refers to it
  std::unique_ptr<InferredWalls<D>> walls_;  // where the verification refers to it
  Verification<D> verification_;
  std::optional<Complaint> complaint_;
  std::optional<std::pair<std::int64_t, double>> last_;  // step and time of the frame before
  bool first_ = true, has_force_ = false, has_angular_velocity_ = false;
};

}  // namespace grseg
