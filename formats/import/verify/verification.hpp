// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/core/frame.hpp"
#include "formats/import/verify/check_context.hpp"
#include "formats/import/verify/check_series.hpp"
#include "formats/import/verify/frame_statistics.hpp"
#include "formats/import/verify/imbalance.hpp"
#include "formats/import/verify/unlisted_pairs.hpp"

#include <array>
#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace grseg {

/// Residuals of Newton's law for the mobile grains of a frame. The defect of a grain is the sum of
/// its contact forces + m g - force; its residual is |defect| over the largest of the frame's
/// contact forces and weights.
struct Residual {
  double largest = 0, median = 0;
  std::size_t grain = 0;   // row of the grain with the largest residual
  double unexplained = 0;  // residual to judge: the largest, after subtraction of `late`;
                           // of the median grain between frames close together
  double worst = 0;        // residual of the worst grain, also if `unexplained` is a median
  std::optional<LateDamping> late;  // late damping (imbalance.hpp), if forces are late
};

/// An error in a frame that a check has found.
struct Complaint {
  std::string check;  // name of the check: check_context.hpp
  std::string sentence;
  bool of_columns = false;      // true: another value of --columns might help
  bool spoils_gravity = false;  // true: the error falsifies estimates of gravity and masses
};

/// Accuracy of the correct output of a program.
struct OutputAccuracy {
  double tolerance = 0;      // largest residual that late damping does not explain
  bool late_forces = false;  // true: forces are half a step late (imbalance.hpp)
  double step = 0;           // length of an integration step; 0: unknown
  double inertia = 0.5;      // I/(m r^2) of the grains, needed for late forces
  bool lists_all = true;     // true: every overlapping pair has a row, also without a force
};

/// Checks each frame of an import for errors in reading the archive: contacts must join grains that
/// touch, each be listed once, none be missing, push rather than pull, and add up to the force on
/// each grain. If the archive has no forces on grains, the force is m times the change of velocity
/// since the previous frame, and is compared with the mean contact forces of the two frames: for
/// every grain if they are consecutive steps, for the median grain if they are close together
/// (judge.hpp), otherwise not at all. numbers() returns the numbers for checks over many frames.
class Verification {
 public:
  /// All arguments in any consistent units. `axes` are used in messages only.
  Verification(const Grains& grains, const Box& box, const Vec3& gravity,
               const OutputAccuracy& accuracy, const Waivers& waivers = {},
               const std::array<AxisInArchive, 3>& axes = {});

  /// See FrameStatistics::leave_out().
  void leave_out(const std::vector<std::uint8_t>& grains) { statistics_.leave_out(grains); }
  /// Checks a frame; to be called for all frames in order. Returns the first error that is not
  /// waived, if any. `has_images`: the archive states images.
  std::optional<Complaint> check(const Frame<3>& frame, bool has_images = true);

  /// Residuals of the last frame; empty if no force or acceleration of the grains is known.
  const std::optional<Residual>& residual() const { return residual_; }
  /// Numbers of the last frame for checks over many frames, in the units of the grains.
  const CheckNumbers& numbers() const { return numbers_; }

 private:
  using Forces = std::vector<Vec3>;

  std::optional<Complaint> geometry(const Frame<3>& frame);
  std::optional<Complaint> touching(const Frame<3>& frame, std::size_t contact);
  std::optional<Complaint> completeness(const Frame<3>& frame, const ListedPairs& listed);
  std::string missing_rows_of(const UnlistedPairs& found) const;
  std::optional<Complaint> pull(const Frame<3>& frame);

  /// A possible meaning of the rows: the contact force from the numbers of a row and the unit
  /// vector along its branch.
  using Reading = std::function<Vec3(const Vec3& force, const Vec3& n)>;
  /// Sums of the contact forces on each grain for a Reading, in this frame and the previous one (if
  /// any), and the largest force of a contact.
  struct Sums {
    Forces now, before;
    double largest = 0;
  };
  Sums sums_as(const Frame<3>& frame, const Reading& reading) const;

  /// Distance in time from the previous frame: no previous frame; not comparable; close together
  /// (judge.hpp); one step.
  enum class Distance { none, far, close, step };
  double longest_path(const Frame<3>& frame) const;
  double too_far(const Frame<3>& frame) const;
  std::optional<Complaint> distance_moved(const Frame<3>& frame) const;
  Distance from_before(const Frame<3>& frame, const Sums& sums) const;
  /// The defect of each mobile grain, and the largest force.
  std::pair<Forces, double> defect_of(const Frame<3>& frame, const Sums& sums) const;
  std::optional<Residual> residual_with(const Frame<3>& frame, const Sums& sums) const;
  void judge_by_velocities(const Frame<3>& frame, const Sums& sums, const Forces& defect,
                           double scale, Residual& residual) const;
  std::string other_readings(const Frame<3>& frame) const;
  std::string late_damping(const Frame<3>& frame, Forces defect, double scale) const;
  std::optional<Complaint> balance(const Frame<3>& frame, const Sums& sums);
  std::string pair_of(std::int32_t i, std::int32_t j) const;
  double tolerance() const { return waivers_.limit("balance", accuracy_.tolerance); }

  const Grains& grains_;
  Box box_;
  Vec3 gravity_;
  OutputAccuracy accuracy_;
  Waivers waivers_;
  std::array<AxisInArchive, 3> axes_;
  FrameStatistics statistics_;
  std::optional<Residual> residual_;
  CheckNumbers numbers_;
  std::optional<FrameBefore> before_;
};

}  // namespace grseg
