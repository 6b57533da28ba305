// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/core/frame.hpp"
#include "formats/import/verify/check_series.hpp"

#include <optional>
#include <vector>

namespace grseg {

/// A moment as the next one remembers it.
struct MomentBefore : Frame<3> {
  std::vector<Vec3> sums;  // contact forces on each grain
};

/// Sum of the contact forces on each grain; `forces` has an entry for each contact.
std::vector<Vec3> contact_sums(std::size_t grains, const ContactList<3>& contacts,
                               const std::vector<Vec3>& forces);

/// How much the sums of contact forces have changed from one moment to the next, over the sizes of
/// the contact forces; medians over grains with contacts. 0 where there are no contacts.
double change_of_sums(const Grains& grains, const Frame<3>& frame, const std::vector<Vec3>& before,
                      const std::vector<Vec3>& now);

/// Computes what of a moment is about weights, inertia and displacements: everything from
/// `acceleration` on. In any consistent units.
class MomentStatistics {
 public:
  MomentStatistics(const Grains& grains, const Box& box);

  /// `before` is empty for the first moment, and `close` says whether it is close to this one.
  /// `has_images`: images of positions are the archive's.
  void add_to(CheckMoment& moment, const Frame<3>& frame, const std::vector<Vec3>& sums,
              const std::optional<MomentBefore>& before, bool close, bool has_images) const;

  /// Grains, by row, that tell nothing of weights: their balance is not independent of gravity.
  /// Referred to, and empty or as many as there are grains at each call of add_to.
  void leave_out(const std::vector<std::uint8_t>& grains) { left_out_ = &grains; }

 private:
  using Vectors = std::vector<Vec3>;
  enum class Group { all, smaller, larger };
  bool is_in(Group group, std::size_t grain) const;

  Vectors weights(const Frame<3>& frame, const Vectors& sums,
                  const std::optional<MomentBefore>& before) const;
  GravityEstimate by_median(Group group, const Vectors& weights) const;
  GravityEstimate by_mean(Group group, const Vectors& weights) const;
  double acceleration(const Frame<3>& frame) const;
  void add_motion(SlopeSums& sums, const Frame<3>& frame, const MomentBefore& before,
                  const std::vector<bool>& is_free, bool has_images) const;
  void add_inertia(SlopeSums& sums, const Frame<3>& frame, const MomentBefore& before,
                   const std::vector<bool>& is_free) const;

  const std::vector<std::uint8_t>* left_out_ = nullptr;
  const Grains& grains_;
  Box box_;
  double split_ = 0, diameter_ = 0;  // of sizes; mean of mobile grains
};

}  // namespace grseg
