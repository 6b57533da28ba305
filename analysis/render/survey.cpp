// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/render/survey.hpp"

#include "analysis/frames/contacts.hpp"
#include "analysis/frames/sums.hpp"

#include <algorithm>
#include <cmath>

namespace grseg {
namespace {

constexpr std::size_t most_frames = 16;

std::vector<std::size_t> evenly_spread(const std::vector<std::size_t>& frames)
{
  const std::size_t count = std::min(frames.size(), most_frames);
  std::vector<std::size_t> some;
  some.reserve(count);
  for (std::size_t k = 0; k < count; ++k)
    some.push_back(frames[count > 1 ? k * (frames.size() - 1) / (count - 1) : 0]);
  return some;
}

/// Quantile: the number below which the share `share` of all values lies. `values` is not empty, and is
/// reordered.
double quantile(std::vector<double>& values, double share)
{
  const auto last = static_cast<double>(values.size() - 1);
  const auto place = values.begin() + std::lround(share * last);
  std::nth_element(values.begin(), place, values.end());
  return *place;
}

}  // namespace

template <int D>
Survey<D> survey_frames(const TrajectoryReader& run, const std::vector<std::size_t>& frames,
                        const Grains& grains, const std::optional<GrainField<D>>& field)
{
  Survey<D> survey;
  survey.low = Vector<D>::Constant(std::numeric_limits<double>::infinity());
  survey.high = -survey.low;
  Frame<D> frame;
  if (field) {
    survey.needs.velocity = field->definition().needs.velocity;
    survey.needs.force = field->definition().needs.force;
  }
  for (const auto index : evenly_spread(frames)) {
    run.read(index, frame, survey.needs);
    survey.times.push_back(frame.time);
    survey.walls.add(frame);
    for (std::size_t g = 0; g < grains.size(); ++g) {
      if (!is_present(frame, g)) continue;
      const auto reach = Vector<D>::Constant(grains.radius[g]);
      survey.low = survey.low.cwiseMin(frame.position[g] - reach);
      survey.high = survey.high.cwiseMax(frame.position[g] + reach);
      survey.largest_diameter = std::max(survey.largest_diameter, 2 * grains.radius[g]);
    }
    for (std::size_t k = 0; k < frame.contacts.size(); ++k) {
      const double force = force_parts(frame.contacts, k).f_n;
      if (force > 0) survey.forces.push_back(force);
    }
    if (!field) continue;
    for (const double value : field->values(frame))
      if (!std::isnan(value)) survey.values.push_back(value);
  }
  return survey;
}

double strong_force(std::vector<double> forces)
{
  return forces.empty() ? 0 : quantile(forces, 0.99);
}

Range range_of(FieldEnds ends, std::vector<double> values)
{
  if (ends == FieldEnds::zero_to_one || values.empty()) return {0, 1};
  if (ends == FieldEnds::both_signs) {
    for (double& value : values) value = std::abs(value);
    const auto range = round_range({0, quantile(values, 0.99)});
    return {-range.high, range.high};
  }
  const double high = quantile(values, 0.99);
  if (ends == FieldEnds::zero_to_most) return round_range({0, high});
  return round_range({quantile(values, 0.01), high});
}

template Survey<2> survey_frames(const TrajectoryReader&, const std::vector<std::size_t>&,
                                 const Grains&, const std::optional<GrainField<2>>&);
template Survey<3> survey_frames(const TrajectoryReader&, const std::vector<std::size_t>&,
                                 const Grains&, const std::optional<GrainField<3>>&);

}  // namespace grseg
