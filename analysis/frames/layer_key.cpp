// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/frames/layer_key.hpp"

#include "analysis/frames/sums.hpp"
#include "formats/core/errors.hpp"

#include <fmt/format.h>
#include <gsl/gsl_statistics.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace grseg {

bool HeightRange::holds(double bottom, double top) const
{
  const double slack = 1e-9 * (top - bottom);
  return !(bottom < lowest - slack || top > highest + slack);
}

namespace {

constexpr double margin = 4;  // small diameters

HeightRange between(const std::string& text, LengthUnits units)
{
  HeightRange range;
  const auto colon = text.find(':');
  if (colon == std::string::npos)
    throw UsageError(
        fmt::format("--heights {}: write inside, all, or low:high, e.g. 4dS:56dS or 4dS:", text));
  const auto low = text.substr(0, colon), high = text.substr(colon + 1);
  if (!low.empty()) range.lowest = parse_length(low, "--heights", units);
  if (!high.empty()) range.highest = parse_length(high, "--heights", units);
  return range;
}

HeightRange inside_of(const std::vector<LayerSolid>& layers, double small_diameter)
{
  const double median = median_solid(layers);
  struct Mean {
    double top = 0, frames = 0, solid = 0;
  };
  std::map<double, Mean> means;  // by bottom
  for (const auto& layer : layers) {
    if (!(layer.frames > 0)) continue;
    auto& mean = means[layer.bottom];
    mean.top = layer.top;
    mean.frames += layer.frames;
    mean.solid += layer.frames * layer.solid;
  }
  double base = std::numeric_limits<double>::infinity(), height = 0;
  for (const auto& [bottom, mean] : means) {
    const double filled = mean.solid / mean.frames / median;
    if (filled >= 0.5) base = std::min(base, bottom);
    height += filled * (mean.top - bottom);
  }
  return {base + margin * small_diameter, base + height - margin * small_diameter};
}

}  // namespace

double median_solid(const std::vector<LayerSolid>& layers)
{
  std::vector<double> solid;
  for (const auto& layer : layers)
    if (layer.solid > 0) solid.push_back(layer.solid);
  return solid.empty() ? 0 : gsl_stats_median(solid.data(), 1, solid.size());
}

std::string heights_in_words(const std::string& text)
{
  return text == inside_the_bed
             ? fmt::format("inside: without {:g} d_S at the base and under the surface", margin)
             : text;
}

void check_heights(const std::string& text)
{
  if (text != inside_the_bed && text != "all") between(text, {1, 1});
}

HeightRange parse_heights(const std::string& text, LengthUnits units,
                          const std::vector<LayerSolid>& layers)
{
  if (text == "all") return {};
  return text == inside_the_bed ? inside_of(layers, units.small_diameter) : between(text, units);
}

std::string KeyColumn::name_with_unit(int dimension) const
{
  return std::string(name) + (value == &LayerKey::volume ? unit_of_volume(dimension) : unit);
}

const char* unit_of_volume(int dimension)
{
  return dimension == 3 ? "[m^3]" : "[m^2]";
}

std::vector<std::string> with_key_columns(int dimension, const std::vector<std::string>& more)
{
  std::vector<std::string> names;
  for (const auto& column : key_columns) names.push_back(column.name_with_unit(dimension));
  return add_all(names, more);
}

std::vector<double> with_key(const LayerKey& key, const std::vector<double>& more)
{
  std::vector<double> row;
  for (const auto& column : key_columns) row.push_back(key.*column.value);
  return add_all(row, more);
}

bool RowRange::holds_window(const LayerKey& key) const
{
  const double slack = 1e-9 * (1 + std::abs(key.begin) + std::abs(key.end));
  return !(key.begin < begin - slack) && !(key.end > end + slack);
}

}  // namespace grseg
