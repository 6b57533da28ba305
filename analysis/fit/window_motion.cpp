// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/fit/window_motion.hpp"

#include "formats/core/text.hpp"

#include <cmath>
#include <map>
#include <optional>
#include <tuple>
#include <utility>

namespace grseg {
namespace {

/// Sums over layers, weighted by frames times area, volume or mass of the grains.
struct LayersOfWindow {
  double weight = 0, square = 0;
  double small = 0, small_y = 0, large = 0, large_y = 0;  // weight, and its moment, of two species

  void add(const FitRow& row, const SpeciesPair& pair)
  {
    const double y = (row.key.bottom + row.key.top) / 2, frames = row.key.frames;
    const auto& content = row.sums.content;
    weight += frames * row.content();
    square += frames * row.content() * row.square;
    small += frames * content[pair.smaller];
    small_y += frames * content[pair.smaller] * y;
    large += frames * content[pair.larger];
    large_y += frames * content[pair.larger] * y;
  }
};

/// Sums over the layers of a run, weighted likewise.
struct LayersOfRun {
  double weight = 0, y = 0, yy = 0, u = 0, uy = 0;
  double diameter = 0, mass = 0, stress = 0;

  void add(const FitRow& row, const SpeciesList& species, const std::vector<double>& density,
           double sigma, bool annuli)
  {
    const double middle = (row.key.bottom + row.key.top) / 2;
    const double turning = annuli ? row.u / middle : row.u;
    for (std::size_t k = 0; k < species.size(); ++k) {
      const double own = row.key.frames * row.sums.content[k];
      weight += own;
      diameter += own * species[k].diameter;
      mass += own * density[k];
      y += own * middle;
      yy += own * middle * middle;
      u += own * turning;
      uy += own * turning * middle;
      stress += own * sigma;
    }
  }
  double inertial_number(bool annuli) const
  {
    const double slope = (uy - u * y / weight) / (yy - y * y / weight);
    const double shear = annuli ? slope * y / weight : slope;
    return std::abs(shear) * (diameter / weight) * std::sqrt(mass / stress);
  }
};

/// Density of each species, kg/m^2 or kg/m^3; nothing if the table does not tell.
std::optional<std::vector<double>> densities_of(const FitTable& table)
{
  std::vector<double> densities;
  for (const auto& word : column_words(table.species)) {
    const auto common = header_or(*table.table, "density", "");
    const auto own = parse_number(header_or(*table.table, "density_" + word, common));
    if (!own || !(*own > 0)) return {};
    densities.push_back(*own);
  }
  return densities;
}

}  // namespace

WindowMotion motion_of_windows(const std::vector<FitTable>& tables, const FitData& data,
                               BasePart base)
{
  using Place = std::tuple<std::size_t, double, double>;  // table; begin and end of a window
  std::map<Place, std::size_t> window_of;
  for (const auto& sample : data.samples)
    window_of[{sample.table, sample.key.begin, sample.key.end}] = sample.window;
  std::vector<std::size_t> run_of;
  for (std::size_t run = 0; run < data.runs.size(); ++run)
    run_of.insert(run_of.end(), data.runs[run], run);

  std::vector<LayersOfWindow> windows(run_of.size());
  std::vector<LayersOfRun> runs(data.runs.size());
  bool layers = true, densities_known = data.quantity == Quantity::contact;
  for (std::size_t k = 0; k < tables.size(); ++k) {
    const auto& table = tables[k];
    layers = layers && !plane_of(*table.table);
    const auto density = densities_of(table);
    densities_known = densities_known && density && layers;
    for (const auto& row : table.rows) {
      const auto window = window_of.find({k, row.key.begin, row.key.end});
      if (window == window_of.end() || !(row.content() > 0)) continue;
      windows[window->second].add(row, data.samples.front().pair);
      if (densities_known)
        runs[run_of[window->second]].add(row, table.species, *density,
                                         partial_stress(row.sums, {}, base).total(1, 1),
                                         has_annuli(*table.table));
    }
  }

  WindowMotion motion;
  motion.speed = numbers_of(
      windows, [](const LayersOfWindow& sums) { return std::sqrt(sums.square / sums.weight); });
  if (!motion.speed.allFinite()) return {};
  if (layers && !has_annuli(*tables.front().table))
    motion.height = numbers_of(windows, [](const LayersOfWindow& sums) {
      return sums.large_y / sums.large - sums.small_y / sums.small;
    });
  if (densities_known)
    motion.inertial_number = listed(runs, [&](const LayersOfRun& sums) {
      return sums.inertial_number(has_annuli(*tables.front().table));
    });
  return motion;
}

Eigen::VectorXd stress_ratio_of_windows(const FitData& data, BasePart base)
{
  Eigen::VectorXd shear = Eigen::VectorXd::Zero(index(number_of_windows(data.runs)));
  Eigen::VectorXd normal = shear;
  for (const auto& sample : data.samples) {
    const auto stress = partial_stress(data.rows[sample.row], {}, base).total;
    shear[index(sample.window)] += sample.frames * stress(0, 1);
    normal[index(sample.window)] += sample.frames * stress(1, 1);
  }
  return data.quantity == Quantity::kinetic ? normal : (shear.array() / normal.array()).abs();
}

}  // namespace grseg
