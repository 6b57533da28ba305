// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/core/frame.hpp"
#include "sim/solver/contact_place.hpp"

#include <span>
#include <vector>

namespace grseg {

/// Grains that friction can lock between two bodies which contacts do not move: the line through the
/// two contact points lies in both cones of friction (tan of its angle to the normals below mu).
///
/// No impulses of these contacts, however large, push such a grain out again. So it cannot rebound
/// from them: sweeps would seek rebounds in vain and let forces grow without bound. And a relaxation of
/// either contact stops little of its motion into the gap: with the few sweeps of a step it would
/// sink deeper, step after step. So its contacts with these bodies are relaxed in turn, after each
/// sweep, until they settle. Between bodies that close in on each other no impulses stop a locked grain;
/// what they have added up is forgotten when the bodies part.
class WedgedGrains {
 public:
  /// `on_base` are the contacts with bodies that contacts do not move. Sets rebounds that cannot be
  /// reached to 0, and the first guesses of a grain whose bodies part.
  WedgedGrains(std::span<const std::span<ContactBlock>> on_base, std::span<const Motion> motion,
               double friction);

  bool empty() const { return grains_.empty(); }
  /// Solves the contacts of each grain. Returns the largest change of a contact's relative velocity, m/s.
  double settle(std::span<Motion> motion, double friction, Effects effects);

 private:
  std::vector<std::vector<ContactPlace>> grains_;
};

/// Whether friction can lock a disc between a and b.
bool locks(const Contact& a, const Contact& b, double friction);

}  // namespace grseg
