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

/// Change of `values` over the time span: slope of the least-squares line, times the span.
Drift change_over(const std::vector<double>& times, const std::vector<double>& values);
/// Mean of independent values.
Drift mean_of(const std::vector<double>& values);

/// Sums over all frames before the first frame of a window.
struct RunningSums {
  double time = 0;                       // time of the first frame of the window, s
  double stray = 0, stray_across = 0;    // MotionBalance::stray along x and z, m
  double overlap = 0, overlaps = 0;      // sum of overlaps, m; number of overlapping pairs
  double energy_defect = 0, frames = 0;  // sum of relative energy defects; number of frames
};

/// Means over each window, from the differences of RunningSums. The last window has no mean: it
/// only marks the end of the window before.
struct WindowMeans {
  std::vector<double> time;                           // middle of the window, s
  std::vector<double> overlap;                        // mean overlap, m
  std::vector<double> energy_defect;                  // mean relative energy defect
  std::vector<double> stray_rate, stray_rate_across;  // change of `stray` per time, m/s

  explicit WindowMeans(const std::vector<RunningSums>& windows);
};

struct PhysicsSettings {
  std::string layer = "4dS";  // thickness of the layers, as text
  WindowSettings windows;
  CheckTolerances tolerances;
};

/// Checks a run against the laws in the table of checks.hpp. Frames are added one by one and not
/// stored. Checks that need data missing from the file are skipped, with the reason.
template <int D>
class PhysicsCheck {
 public:
  PhysicsCheck(const TrajectoryReader& run, const PhysicsSettings& settings);

  /// Adds the next frame, in order of time, read with all TrajectoryReader::Fields. Ignores frames
  /// before --begin (default t = 0) and from --end on.
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
  void hold_to_import(CheckLine& line) const;
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
  bool frames_are_steps_;  // false: imported frames, which are instants
  Layers layers_;
  std::int64_t begin_, end_;  // first checked time step, and the step after the last
  std::vector<Window> windows_;

  ForceBalance<D> forces_;
  MotionBalance<D> motion_;
  StressClosure<D> partials_;
  ContactViolations contacts_;
  WorstCase energy_;
  std::vector<Vector<D>> base_force_;  // N, by frame; empty if the file does not have it
  std::vector<double> energy_defect_;  // relative, by frame; empty if the file does not have it

  std::size_t window_ = 0;                // index of the current window
  std::optional<WeightSums<D>> weights_;  // sums of the current window
  std::vector<WeightWindow<D>> weight_windows_;
  std::vector<RunningSums> window_starts_;
};

/// Checks to make in addition to the digests of the file.
struct ChecksAsked {
  bool deep = false;                       // true: compare with formats/README.md
  std::optional<PhysicsSettings> physics;  // settings of the physics check; empty: no such check
};

/// Reads all frames once and returns the lines of all checks. Calls `shown` with the number of
/// frames read so far. Throws the errors of TrajectoryReader, SpecificationCheck and PhysicsCheck.
template <int D>
std::vector<CheckLine> check_run(const TrajectoryReader& run, const ChecksAsked& asked,
                                 const std::function<void(std::size_t)>& shown = {});

}  // namespace grseg
