// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/fit/time_series.hpp"

#include "analysis/fit/estimators.hpp"
#include "analysis/fit/window_motion.hpp"

#include <algorithm>

namespace grseg {

std::vector<std::vector<Cell>> time_series(const std::vector<FitTable>& tables, const FitData& data,
                                           const std::vector<PartitionRule>& rules,
                                           const FitSettings& settings)
{
  const auto windows = number_of_windows(data.runs);
  std::vector<LayerKey> times(windows);
  Eigen::VectorXd frames = Eigen::VectorXd::Zero(index(windows)), large = frames;
  for (const auto& sample : data.samples) {
    times[sample.window] = sample.key;
    frames[index(sample.window)] += sample.frames;
    large[index(sample.window)] += sample.frames * sample.phi_large;
  }
  const auto motion = motion_of_windows(tables, data, settings.base);
  const auto stress = stress_ratio_of_windows(data, settings.base);
  const auto at = [](const Eigen::VectorXd& numbers, std::size_t window) {
    return numbers.size() > 0 ? numbers[index(window)] : no_number;
  };
  std::vector<std::vector<Cell>> rows;
  for (std::size_t run = 0; run < data.runs.size(); ++run)
    for (std::size_t k = 0; k < data.runs[run]; ++k) {
      const auto window = rows.size();
      rows.push_back({{"run", static_cast<double>(run + 1)},
                      {"t0[s]", times[window].begin},
                      {"t1[s]", times[window].end}});
    }
  for (const auto& rule : rules) {
    const auto sums = window_sums(fit_points(data, rule, settings), data.runs);
    for (std::size_t window = 0; window < windows; ++window)
      rows[window].push_back({"B_" + (data.quantity == Quantity::kinetic ? "kinetic" : rule.name()),
                              rule.adds_up()
                                  ? sums.excess()[index(window)] / sums.weight()[index(window)]
                                  : no_number});
  }
  for (std::size_t window = 0; window < windows; ++window)
    add_all(rows[window], {{"phi_L", at(large, window) / at(frames, window)},
                           {"y_L_minus_y_S[m]", at(motion.height, window)},
                           {"speed[m/s]", at(motion.speed, window)},
                           {"stress_ratio", at(stress, window)}});
  return rows;
}

}  // namespace grseg
