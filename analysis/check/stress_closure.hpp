// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/check/worst_case.hpp"
#include "formats/core/frame.hpp"

namespace grseg {

/// Whether partial stresses add up: sigma^S + sigma^L = sigma in the whole bed (Staron & Phillips
/// 2015, eq. 1), where
///   sigma^L = (1/V) sum over contact ends on large grains of (force on the grain) (x) (x - c),
/// c the contact point, from the positions x of the grains, sigma^S likewise, and sigma is that of
/// PartialContactStress, from the branches of the contacts. The stress of either species is also
/// compared with that of PartialContactStress (rule contact-point), and the sum of both by size
/// with the total.
class StressClosure {
 public:
  explicit StressClosure(const Box& box) : box_(box) {}

  void add(const Grains& grains, const Frame<2>& frame);

  /// Largest component of the differences over the largest of sigma, by frame.
  const WorstCase& defect() const { return defect_; }

 private:
  Box box_;
  WorstCase defect_;
};

}  // namespace grseg
