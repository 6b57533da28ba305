// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/micro/pooling.hpp"

#include <algorithm>
#include <cmath>
#include <map>

namespace grseg {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// Up to round-off: 1.4 d_S of 5 mm are 7 mm, but for the last bits.
template <int D>
bool same_layer(const SumsRow<D>& a, const SumsRow<D>& b)
{
  const double round_off = 1e-9 * (a.top - a.bottom);
  return std::abs(a.bottom - b.bottom) <= round_off && std::abs(a.top - b.top) <= round_off;
}

/// The sums behind a mean weighted by frames.
template <int D>
class MergedRow {
 public:
  void add(const SumsRow<D>& row)
  {
    const double w = row.frames;
    all_.frames += w;
    all_.volume += w * row.volume;
    all_.sums += row.sums * w;
    all_.heights.large += w * row.heights.large;
    all_.heights.small += w * row.heights.small;
    all_.heights.bed += w * row.heights.bed;
    all_.bed_height += w * row.bed_height;
    all_.begin = std::min(all_.begin, row.begin);
    all_.end = std::max(all_.end, row.end);
    if (rows_ == 0) {
      all_.bottom = row.bottom;
      all_.top = row.top;
    } else if (!same_layer(row, all_)) {
      all_.bottom = all_.top = nan;
    }
    ++rows_;
  }

  SumsRow<D> mean() const
  {
    SumsRow<D> row = all_;
    const double frames = all_.frames;
    row.volume /= frames;
    row.sums = all_.sums / frames;
    row.heights = {all_.heights.large / frames, all_.heights.small / frames,
                   all_.heights.bed / frames};
    row.bed_height /= frames;
    return row;
  }

 private:
  std::size_t rows_ = 0;
  SumsRow<D> all_{.begin = std::numeric_limits<double>::infinity(),
                  .end = -std::numeric_limits<double>::infinity(),
                  .bottom = nan,
                  .top = nan,
                  .frames = 0,
                  .volume = 0,
                  .sums = {},
                  .heights = {0, 0, 0},
                  .bed_height = 0};
};

/// Rows with the same key are merged; the whole bed has its own, after all layers.
template <int D>
double pool_key(const SumsRow<D>& row, Pool pool)
{
  if (pool == Pool::composition) return std::min(std::floor(10 * row.sums.phi_large()), 9.0);
  // The number of the layer, which round-off does not change.
  return row.is_bed() ? std::numeric_limits<double>::infinity()
                      : std::round(row.bottom / (row.top - row.bottom));
}

}  // namespace

template <int D>
std::vector<SumsRow<D>> filtered(std::vector<SumsRow<D>> rows, const RowFilter& filter,
                                 LengthUnits units)
{
  std::vector<LayerSolid> layers;
  for (const auto& row : rows)
    if (!row.is_bed())
      layers.push_back({row.bottom, row.top, row.frames, row.sums.content() / row.volume});
  const auto heights = parse_heights(filter.heights, units, layers);
  std::erase_if(rows, [&](const SumsRow<D>& row) {
    const double time_slack = 1e-9 * (1 + std::abs(row.begin) + std::abs(row.end));
    return row.begin < filter.begin - time_slack || row.end > filter.end + time_slack ||
           !heights.holds(row.bottom, row.top);
  });
  return rows;
}

template <int D>
std::vector<SumsRow<D>> pooled(const std::vector<SumsRow<D>>& rows, Pool pool)
{
  if (pool == Pool::none) return rows;
  std::map<double, MergedRow<D>> merged;
  for (const auto& row : rows) {
    if (pool == Pool::composition && (row.is_bed() || std::isnan(row.sums.phi_large()))) continue;
    merged[pool_key(row, pool)].add(row);
  }
  std::vector<SumsRow<D>> result;
  result.reserve(merged.size());
  for (const auto& [key, row] : merged) result.push_back(row.mean());
  return result;
}

template std::vector<SumsRow<2>> filtered(std::vector<SumsRow<2>>, const RowFilter&, LengthUnits);
template std::vector<SumsRow<3>> filtered(std::vector<SumsRow<3>>, const RowFilter&, LengthUnits);
template std::vector<SumsRow<2>> pooled(const std::vector<SumsRow<2>>&, Pool);
template std::vector<SumsRow<3>> pooled(const std::vector<SumsRow<3>>&, Pool);

}  // namespace grseg
