// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/core/frame.hpp"
#include "formats/import/verify/check_context.hpp"
#include "formats/import/verify/check_series.hpp"
#include "formats/import/verify/imbalance.hpp"
#include "formats/import/verify/moment_statistics.hpp"
#include "formats/import/verify/unlisted_pairs.hpp"

#include <array>
#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace grseg {

/// How well the mobile grains of a frame obey sum of contact forces + m g - force = 0: |defect|
/// over the largest of the frame's contact forces and of the mobile grains' weights.
struct Residual {
  double largest = 0, median = 0;
  std::size_t grain = 0;            // row of the largest
  double unexplained = 0;           // the largest after late damping is subtracted
  double worst = 0;                 // the largest, where `unexplained` belongs to the median grain
  std::optional<LateDamping> late;  // where that was looked for
};

/// An error of a frame, as a sentence about the reading of its archive.
struct Complaint {
  std::string check;  // check_context.hpp
  std::string sentence;
  bool of_columns = false;      // another --columns might help
  bool spoils_gravity = false;  // what the grains tell of gravity and masses is wrong by it
};

/// Largest imbalance that the correct output of a program may have.
struct OutputAccuracy {
  double tolerance = 0;      // largest residual not explained by late damping
  bool late_forces = false;  // imbalance.hpp
  double step = 0;           // of the integration; then needed
  double inertia = 0.5;      // I/(m r^2) of the grains, likewise
  bool lists_all = true;     // every pair that overlaps has a row, also one that bears no force
};

/// Checks in each frame of an import what must be true if the archive has been read as it was
/// meant: contacts join grains that touch, each is listed once, none is missing, they push rather
/// than pull, and add up to the force on each grain. Where the archive has no forces on grains, m times the difference
/// of velocities from the frame before is used, with the mean contact forces of the two frames: of
/// every grain where the two follow step by step, of the median grain where they are close together
/// (judge.hpp), and not at all otherwise. What can only be told from many frames goes into `moment`.
class Verification {
 public:
  /// In any consistent units. `axes` are for sentences.
  Verification(const Grains& grains, const Box& box, const Vec3& gravity,
               const OutputAccuracy& accuracy, const Waivers& waivers = {},
               const std::array<AxisInArchive, 3>& axes = {});

  /// See MomentStatistics.
  void leave_out(const std::vector<std::uint8_t>& grains) { statistics_.leave_out(grains); }
  /// To be called for the frames in order; what is wrong with this one, if anything that is not
  /// waived. `has_images`: images of positions are the archive's.
  std::optional<Complaint> check(const Frame<3>& frame, bool has_images = true);

  /// Balance of the last frame; empty where there is nothing to compare with.
  const std::optional<Residual>& residual() const { return residual_; }
  /// The checks' memory of the last frame, in the units of the grains.
  const CheckMoment& moment() const { return moment_; }

 private:
  using Forces = std::vector<Vec3>;

  std::optional<Complaint> geometry(const Frame<3>& frame);
  std::optional<Complaint> touching(const Frame<3>& frame, std::size_t contact);
  std::optional<Complaint> completeness(const Frame<3>& frame, const ListedPairs& listed);
  std::string missing_rows_of(const UnlistedPairs& found) const;
  std::optional<Complaint> pull(const Frame<3>& frame);

  /// The force that a row means, given the unit vector along its branch.
  using Reading = std::function<Vec3(const Vec3& force, const Vec3& n)>;
  /// The contact forces on each grain by a reading, in this frame and, where there is one, in that
  /// before; and the largest force of a contact.
  struct Sums {
    Forces now, before;
    double largest = 0;
  };
  Sums sums_as(const Frame<3>& frame, const Reading& reading) const;

  /// How the frame and the one before can be compared.
  enum class Distance { none, far, close, step };
  double longest_path(const Frame<3>& frame) const;
  double too_far(const Frame<3>& frame) const;
  std::optional<Complaint> distance_moved(const Frame<3>& frame) const;
  Distance from_before(const Frame<3>& frame, const Sums& sums) const;
  /// The force that is missing on each mobile grain, and the largest force.
  std::pair<Forces, double> defect_of(const Frame<3>& frame, const Sums& sums) const;
  std::optional<Residual> residual_with(const Frame<3>& frame, const Sums& sums) const;
  void judge_by_velocities(const Frame<3>& frame, const Sums& sums, const Forces& defect,
                           double scale, Residual& residual) const;
  std::string other_readings(const Frame<3>& frame) const;
  std::optional<Complaint> balance(const Frame<3>& frame, const Sums& sums);
  std::string pair_of(std::int32_t i, std::int32_t j) const;
  double tolerance() const { return waivers_.limit("balance", accuracy_.tolerance); }

  const Grains& grains_;
  Box box_;
  Vec3 gravity_;
  OutputAccuracy accuracy_;
  Waivers waivers_;
  std::array<AxisInArchive, 3> axes_;
  MomentStatistics statistics_;
  std::optional<Residual> residual_;
  CheckMoment moment_;
  std::optional<MomentBefore> before_;
};

}  // namespace grseg
