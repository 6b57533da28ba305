// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/check/checks.hpp"
#include "analysis/check/laws_of_motion.hpp"
#include "analysis/check/weight_balance.hpp"
#include "analysis/frames/windows.hpp"
#include "formats/trajectory/reader.hpp"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <initializer_list>
#include <optional>
#include <string>
#include <vector>

namespace grseg {

/// A value and its standard error.
struct Drift {
  double value, error;
};

/// Slope of the least-squares line through `values`, times the time it is taken over.
Drift change_over(const std::vector<double>& times, const std::vector<double>& values);
/// Mean of independent values.
Drift mean_of(const std::vector<double>& values);

/// Sums over the frames before the first one of a window.
struct RunningSums {
  double time = 0;                     // s
  double stray = 0, stray_across = 0;  // m, MotionBalance::stray along x and z
  double overlap = 0, overlaps = 0;    // m, and the number of pairs
  double energy_defect = 0, frames = 0;
};

/// Means of the windows, from the sums at the beginning of each; the last window only ends the one
/// before it.
struct WindowMeans {
  std::vector<double> time;     // s, middle
  std::vector<double> overlap;  // m
  std::vector<double> energy_defect;
  std::vector<double> stray_rate, stray_rate_across;  // m/s

  explicit WindowMeans(const std::vector<RunningSums>& windows);
};

struct PhysicsSettings {
  std::string layer = "4dS";
  WindowSettings windows;
  CheckTolerances tolerances;
};

/// Holds a run against the laws that it should obey, the table of checks.hpp. Frames are added one
/// by one and forgotten; checks that need data missing from the file are skipped, with the reason.
template <int D>
class PhysicsCheck {
 public:
  PhysicsCheck(const TrajectoryReader& run, const PhysicsSettings& settings);

  /// Frames in order, whole (all of TrajectoryReader::Fields); those before --begin (t = 0) and
  /// from --end on are not used.
  void add(std::size_t index, const Frame<D>& frame);
  std::vector<CheckLine> lines() const;

 private:
  bool in_window(std::size_t index) const;
  bool is_periodic() const;
  static bool applies(const Check& check) { return D == 3 || !check.of_spheres_only; }
  void begin_window(const Frame<D>& frame);
  void end_window();
  std::string why_no_layers() const;
  void add_balances(std::vector<CheckLine>& lines) const;
  void add_contacts(std::vector<CheckLine>& lines) const;
  void add_layers(std::vector<CheckLine>& lines) const;
  void add_drifts(std::vector<CheckLine>& lines) const;
  static void skip(std::initializer_list<Check> checks, const std::string& why,
                   std::vector<CheckLine>& lines);

  const TrajectoryReader& run_;
  CheckTolerances tolerances_;
  Judge judge_;
  Gravity<D> gravity_;
  double small_diameter_;
  ContactRules rules_;
  bool rotation_, has_force_ = true;
  Layers layers_;
  std::int64_t begin_, end_;  // steps
  std::vector<Window> windows_;

  ForceBalance<D> forces_;
  MotionBalance<D> motion_;
  StressClosure<D> partials_;
  ContactViolations contacts_;
  WorstCase energy_;
  std::vector<Vector<D>> base_force_;  // N, by frame; empty where the file does not have it
  std::vector<double> energy_defect_;  // by frame; empty where the file does not have it

  std::size_t window_ = 0;                // to which frames are being added
  std::optional<WeightSums<D>> weights_;  // of this window
  std::vector<WeightWindow<D>> weight_windows_;
  std::vector<RunningSums> window_starts_;
};

/// Checks to make besides the file's digests.
struct ChecksAsked {
  bool deep = false;                       // the specification
  std::optional<PhysicsSettings> physics;  // none: not checked
};

/// Reads all frames once and gives the lines of the checks; `shown` hears how many frames are done.
/// Errors as TrajectoryReader, SpecificationCheck and PhysicsCheck.
template <int D>
std::vector<CheckLine> check_run(const TrajectoryReader& run, const ChecksAsked& asked,
                                 const std::function<void(std::size_t)>& shown = {});

}  // namespace grseg
