// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/check/worst_case.hpp"
#include "formats/core/frame.hpp"

#include <cstddef>

namespace grseg {

/// Whether partial stresses add up: the sum of sigma^nu over the species nu is sigma in the whole
/// bed (Staron & Phillips 2015, eq. 1), where
///   sigma^nu = (1/V) sum over contact ends on grains of nu of (force on the grain) (x) (x - c),
/// c the contact point, from the positions x of the grains, and sigma is that of
/// PartialContactStress, from the branches of the contacts. The stress of each species is also
/// compared with that of PartialContactStress (rule contact-point), and the sum of all by size
/// with the total.
template <int D>
class StressClosure {
 public:
  /// `species`: of mobile grains.
  StressClosure(const Box& box, std::size_t species) : box_(box), species_(species) {}

  void add(const Grains& grains, const Frame<D>& frame);

  /// Largest component of the differences over the largest of sigma, by frame.
  const WorstCase& defect() const { return defect_; }

 private:
  Box box_;
  std::size_t species_;
  WorstCase defect_;
};

}  // namespace grseg
