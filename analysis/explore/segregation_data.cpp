// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/explore/segregation_data.hpp"

#include "analysis/segregation/run.hpp"
#include "formats/core/dimension.hpp"
#include "formats/core/length.hpp"
#include "formats/core/text.hpp"

#include <algorithm>
#include <vector>

namespace grseg {
namespace {

using Json = nlohmann::ordered_json;

/// Of the whole bed: the last columns of grseg-segregation, which those of layers come before.
constexpr const char* first_of_bed = "yL[m]";

template <int D>
Json segregation_of(FrameLoop& loop, const RateFilter& filter)
{
  const auto& species = loop.species();
  const double small = species[0].diameter, large = species[1].diameter;
  SegregationRun<D> run(loop.layers(), small, large);
  const auto columns = SegregationRun<D>::columns();
  const auto first = static_cast<std::size_t>(
      std::find(columns.begin(), columns.end(), first_of_bed) - columns.begin());
  Json all{{"numbers", Json::array()},
           {"remarks", Json::array()},
           {"columns", {"t0[s]", "t1[s]"}},
           {"rows", Json::array()}};
  for (std::size_t k = first; k < columns.size(); ++k) all["columns"].push_back(columns[k]);
  for (const auto& window : loop.windows()) {
    const auto [series, flux] = loop.sum<D>(
        window, {.velocity = true, .contacts = false}, SegregationSeries<D>(loop.layers()),
        SegregationFlux<D>(loop.layers(), window, small, large));
    run.add(loop.grains(), series, flux);
    const auto bed = run.bed_row();
    Json row{window.begin, window.end};
    for (std::size_t k = first; k < bed.size(); ++k) row.push_back(bed[k]);
    all["rows"].push_back(std::move(row));
  }
  const auto summary = run.summary(filter);
  for (const auto& [name, estimate] : summary.numbers)
    all["numbers"].push_back({name, estimate.value, estimate.low, estimate.high});
  for (const auto& remark : summary.remarks) all["remarks"].push_back(printable(remark));
  return all;
}

}  // namespace

Json segregation_data(FrameLoop& loop, const std::string& heights)
{
  if (loop.species().size() != 2) return nullptr;
  const RateFilter filter{heights};
  return with_dimension(loop.dimension(), [&](auto d) { return segregation_of<d>(loop, filter); });
}

}  // namespace grseg
