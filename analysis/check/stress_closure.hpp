// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/check/worst_case.hpp"
#include "formats/core/frame.hpp"

namespace grseg {

/// Whether partial stresses add up: sigma^S + sigma^L = sigma in the whole bed, where
///   sigma^L = (1/V) sum over contact ends on large grains of (force on the grain) (x) (x - c),
/// c the contact point, from the positions of the grains, sigma^S likewise, and sigma is that of
/// PartialContactStress, from the branches of the contacts. The two species are compared with its
/// partial stresses (rule contact-point) too, and so is the total by size.
class StressClosure {
 public:
  explicit StressClosure(const Box& box) : box_(box) {}

  void add(const Grains& grains, const Frame& frame);
  /// Adds what another has seen later.
  void merge(const StressClosure& later) { defect_.merge(later.defect_); }

  /// Largest component of the differences over the largest of sigma, by frame.
  const WorstCase& defect() const { return defect_; }

 private:
  Box box_;
  WorstCase defect_;
};

}  // namespace grseg
