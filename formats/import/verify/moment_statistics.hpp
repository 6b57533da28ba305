// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/core/frame.hpp"
#include "formats/import/verify/check_series.hpp"

#include <optional>
#include <vector>

namespace grseg {

/// A moment as the next one remembers it.
template <int D>
struct MomentBefore {
  std::int64_t step = 0;
  double time = 0;
  std::vector<Vector<D>> position, velocity, force;
  std::vector<std::array<std::int32_t, D>> image;
  std::vector<Vector<D>> sums;  // contact forces on each grain
  ContactList<D> contacts;
};

/// Sum of the contact forces on each grain if `forces` are those of the contacts.
template <int D>
std::vector<Vector<D>> contact_sums(std::size_t grains, const ContactList<D>& contacts,
                                    const std::vector<Vector<D>>& forces);

/// How much the sums of contact forces have changed from one moment to the next, over the sizes of
/// the contact forces; medians over grains with contacts. 0 where there are no contacts.
template <int D>
double change_of_sums(const Grains& grains, const Frame<D>& frame,
                      const std::vector<Vector<D>>& before, const std::vector<Vector<D>>& now);

/// Computes what of a moment is about weights, inertia and displacements: everything from
/// `acceleration` on. In any consistent units.
template <int D>
class MomentStatistics {
 public:
  MomentStatistics(const Grains& grains, const Box& box);

  /// `before` is empty for the first moment, and `close` says whether it is close to this one.
  /// `has_images`: images of positions are the archive's.
  void add_to(CheckMoment& moment, const Frame<D>& frame, const std::vector<Vector<D>>& sums,
              const std::optional<MomentBefore<D>>& before, bool close, bool has_images) const;

  /// Grains, by row, that tell nothing of weights: their balance is not independent of gravity.
  /// Referred to, and empty or as many as there are grains at each call of add_to.
  void leave_out(const std::vector<std::uint8_t>& grains) { left_out_ = &grains; }

 private:
  using Vectors = std::vector<Vector<D>>;
  enum class Group { all, smaller, larger };
  bool is_in(Group group, std::size_t grain) const;

  Vectors weights(const Frame<D>& frame, const Vectors& sums,
                  const std::optional<MomentBefore<D>>& before) const;
  GravityEstimate median(Group group, const Vectors& weights) const;
  GravityEstimate mean(Group group, const Vectors& weights) const;
  double acceleration(const Frame<D>& frame) const;
  void add_motion(SlopeSums& sums, const Frame<D>& frame, const MomentBefore<D>& before,
                  const std::vector<bool>& is_free, bool has_images) const;
  void add_inertia(SlopeSums& sums, const Frame<D>& frame, const MomentBefore<D>& before,
                   const std::vector<bool>& is_free) const;

  const std::vector<std::uint8_t>* left_out_ = nullptr;
  const Grains& grains_;
  Box box_;
  double split_ = 0, diameter_ = 0;  // of sizes; mean of mobile grains
};

}  // namespace grseg
