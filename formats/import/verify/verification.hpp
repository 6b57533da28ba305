// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/core/frame.hpp"
#include "formats/import/verify/late_damping.hpp"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace grseg {

/// How well the mobile grains of a frame obey sum of contact forces + m g - force = 0: |defect|
/// over the largest of the frame's contact forces and of the mobile grains' weights.
struct Residual {
  double largest = 0, median = 0;
  std::size_t grain = 0;            // row of the largest
  double unexplained = 0;           // the largest after late damping is subtracted
  std::optional<LateDamping> late;  // where that was looked for
};

/// What is wrong with a frame, as a sentence about the reading of its archive.
struct Complaint {
  std::string sentence;
  bool of_columns = false;  // another --columns might help
};

/// By how much the correct output of a program may fail to balance.
struct OutputAccuracy {
  double tolerance = 0;      // largest residual not explained by late damping
  bool late_forces = false;  // late_damping.hpp
  double step = 0;           // of the integration, then needed
  double inertia = 0.5;      // I/(m r^2) of the grains, likewise
};

/// Checks in each frame of an import what must be true if the archive has been read as it was
/// meant: contacts join grains that touch, each is listed once, they push rather than pull, and add
/// up to the force on each grain. Where the archive has no forces on grains, m times the difference
/// of velocities from the frame before is used, with the mean contact forces of the two frames.
template <int D>
class Verification {
 public:
  /// In any consistent units.
  Verification(const Grains& grains, const Box& box, const Vector<D>& gravity,
               const OutputAccuracy& accuracy);

  /// To be called for the frames in order; what is wrong with this one, if anything.
  std::optional<Complaint> check(const Frame<D>& frame);

  /// Of the last frame; empty where there is nothing to compare with.
  const std::optional<Residual>& residual() const { return residual_; }

 private:
  std::optional<Complaint> geometry(const Frame<D>& frame) const;
  std::optional<Complaint> double_rows(const Frame<D>& frame) const;
  std::optional<Complaint> pull(const Frame<D>& frame) const;
  std::optional<Complaint> balance(const Frame<D>& frame) const;

  /// Contact forces on every grain if `forces` are those of the frame's contacts.
  std::vector<Vector<D>> sums(const ContactList<D>& contacts,
                              const std::vector<Vector<D>>& forces) const;
  std::optional<Residual> residual_with(const Frame<D>& frame,
                                        const std::vector<Vector<D>>& forces) const;
  std::string other_readings(const Frame<D>& frame) const;
  std::string pair_of(const ContactList<D>& contacts, std::size_t c) const;

  const Grains& grains_;
  Box box_;
  Vector<D> gravity_;
  OutputAccuracy accuracy_;
  std::optional<Residual> residual_;

  struct Before {
    double time = 0;
    std::vector<Vector<D>> velocity, sums;
  };
  std::optional<Before> before_;
};

}  // namespace grseg
