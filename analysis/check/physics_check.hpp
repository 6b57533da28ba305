// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/check/check_report.hpp"
#include "analysis/check/contact_violations.hpp"
#include "analysis/check/force_balance.hpp"
#include "analysis/check/stress_closure.hpp"
#include "analysis/check/total_motion.hpp"
#include "analysis/check/weight_balance.hpp"
#include "analysis/frames/windows.hpp"
#include "formats/trajectory/reader.hpp"

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace grseg {

/// What a run may miss. Three kinds: of round-off, of the solver, and of statistics, where a line
/// fails only if it is beyond both the number given here and what chance does to it: the quantile
/// of Student's t at `false_alarm`, over all layers together, times the standard error.
struct CheckTolerances {
  /// (An energy defect is relative to energies; it counts while the kinetic one is above
  /// 1e-12 M g d_S.)
  double round_off = 1e-10, single_precision = 1e-5;
  double mean_overlap = 5e-3, largest_overlap = 0.1;     // d_S
  double mean_approach = 1e-3, largest_approach = 0.05;  // d_S per step
  double false_alarm = 1e-3;
  double weight = 0.01, slope = 0.005;
  double overlap_drift = 1e-3;  // d_S over the run
  double x_drift = 1e-3;        // sqrt(g d_S)
  double least_load = 0.02;     // of the load of the first layer; lighter ones are left out

  struct Named {
    const char* name;
    double CheckTolerances::*value;
    const char* meaning;
  };
  static const std::array<Named, 12>& all();
  /// UsageError, naming the option, where one is no tolerance.
  void require_sense() const;
};

struct PhysicsSettings {
  std::string layer = "4dS";
  WindowSettings windows;
  CheckTolerances tolerances;
};

/// Holds a run against the laws that it should obey. Frames are added one by one and forgotten;
/// what a frame of another program does not tell is skipped, and the line says so.
class PhysicsCheck {
 public:
  PhysicsCheck(const TrajectoryReader& run, const PhysicsSettings& settings);

  /// Frames in order, whole (all of TrajectoryReader::Fields); those before --begin (t = 0) and
  /// from --end on are not used.
  void add(std::size_t index, const Frame& frame);
  std::vector<CheckLine> lines() const;

 private:
  /// Sums over the frames before the first one of a window.
  struct Mark {
    double time = 0;                   // s
    double stray = 0;                  // m
    double overlap = 0, overlaps = 0;  // m
    double energy_defect = 0, frames = 0;
  };
  bool in_window(std::size_t index) const;
  bool steady_slope() const;
  bool at_rest(const TotalMotion& total) const;
  void begin_window(const Frame& frame);
  void end_window();
  void add_balances(std::vector<CheckLine>& lines) const;
  void add_contacts(std::vector<CheckLine>& lines) const;
  void add_layers(std::vector<CheckLine>& lines) const;
  void add_drifts(std::vector<CheckLine>& lines) const;

  CheckLine exact(const std::string& quantity, const WorstCase& worst,
                  const std::string& what) const;
  CheckLine statistical(const std::string& quantity, double deviation, double error, double allowed,
                        std::size_t windows, std::size_t together) const;

  const TrajectoryReader& run_;
  CheckTolerances tolerances_;
  Gravity gravity_;
  double small_diameter_;
  ContactRules rules_;
  bool rotation_, has_force_ = true;
  Layers layers_;
  double begin_, end_;  // s
  std::vector<Window> windows_;

  ForceBalance forces_;
  MotionBalance motion_;
  StressClosure partials_;
  ContactViolations contacts_;
  WorstCase energy_;
  std::vector<Vec2> base_force_;       // N, by frame; empty where the file does not tell
  std::vector<double> energy_defect_;  // likewise

  std::size_t window_ = 0;  // the one that frames are added to
  std::optional<WeightSums> weights_;
  std::vector<WeightWindow> weight_windows_;
  std::vector<Mark> marks_;
};

}  // namespace grseg
