// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/core/frame.hpp"
#include "formats/import/verify/check_series.hpp"

#include <optional>
#include <vector>

namespace grseg {

/// The previous frame, and sums of its forces.
struct FrameBefore : Frame<3> {
  std::vector<Vec3> sums;  // sum of the contact forces on each grain
};

/// Sum of the contact forces on each grain; `forces` has an entry for each contact.
std::vector<Vec3> contact_sums(std::size_t grains, const ContactList<3>& contacts,
                               const std::vector<Vec3>& forces);

/// Relative change of the contact forces from one frame to the next: median change of a grain's sum
/// over the median of its summed magnitudes, for grains with contacts. 0 without contacts.
double change_of_sums(const Grains& grains, const Frame<3>& frame, const std::vector<Vec3>& before,
                      const std::vector<Vec3>& now);

/// Computes the members of CheckNumbers about weights, inertia and displacements: from
/// `acceleration` to the end. In any consistent units.
class FrameStatistics {
 public:
  FrameStatistics(const Grains& grains, const Box& box);

  /// Fills in these numbers. `sums` are the contact forces on each grain. `before` is the previous
  /// frame, empty for the first one. `close`: both frames are close together (judge.hpp).
  /// `has_images`: the archive states images.
  void add_to(CheckNumbers& numbers, const Frame<3>& frame, const std::vector<Vec3>& sums,
              const std::optional<FrameBefore>& before, bool close, bool has_images) const;

  /// Excludes grains (flags by row) from weights, because their balance was used to infer a wall's
  /// force. Stores a reference; at each call of add_to the vector is empty or has all grains.
  void leave_out(const std::vector<std::uint8_t>& grains) { left_out_ = &grains; }

 private:
  using Vectors = std::vector<Vec3>;
  enum class Group { all, smaller, larger };
  bool is_in(Group group, std::size_t grain) const;

  Vectors weights(const Frame<3>& frame, const Vectors& sums,
                  const std::optional<FrameBefore>& before) const;
  GravityEstimate by_median(Group group, const Vectors& weights) const;
  GravityEstimate by_mean(Group group, const Vectors& weights) const;
  double acceleration(const Frame<3>& frame) const;
  void add_motion(SlopeSums& sums, const Frame<3>& frame, const FrameBefore& before,
                  const std::vector<bool>& is_free, bool has_images) const;
  void add_inertia(SlopeSums& sums, const Frame<3>& frame, const FrameBefore& before,
                   const std::vector<bool>& is_free) const;

  const std::vector<std::uint8_t>* left_out_ = nullptr;
  const Grains& grains_;
  Box box_;
  double split_ = 0, diameter_ = 0;  // split_of_sizes(); mean diameter of mobile grains
};

}  // namespace grseg
