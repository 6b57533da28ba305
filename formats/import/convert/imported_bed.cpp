// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/import/convert/imported_bed.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <numeric>

namespace grseg {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr auto most_ids = std::numeric_limits<std::int32_t>::max();

}  // namespace

ImportedBed::ImportedBed(const ArchiveMoment& first, const RunFacts& facts,
                         const ImportSettings& settings)
    : axes(facts.plane.axes)
{
  make_grains(first, facts, settings.species);
  require_a_plane(first);
  make_box(first);
  find_origin(first, settings.origin);
}

void ImportedBed::make_grains(const ArchiveMoment& first, const RunFacts& facts,
                              const SpeciesSettings& settings)
{
  const auto& from = first.grains;
  if (from.size() == 0)
    throw FormatError(fmt::format("{}: the first moment has no grains", first.place));
  for (std::size_t g = 0; g < from.size(); ++g) {
    if (from.id[g] < 0 || from.id[g] > most_ids)
      throw FormatError(
          fmt::format("{}: id {} is not between 0 and 2^31", first.place, from.id[g]));
    if (!(from.radius[g] > 0))
      throw FormatError(
          fmt::format("{}: grain {} has the radius {:g}", first.place, from.id[g], from.radius[g]));
  }
  std::vector<std::size_t> order(from.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return from.id[a] < from.id[b]; });

  species = assign_species(from, settings);
  const auto mass = masses_of(from, facts);
  std::vector<std::int64_t> ids;
  for (const auto g : order) {
    if (!ids.empty() && ids.back() == from.id[g])
      throw FormatError(fmt::format("{}: grain {} appears twice", first.place, from.id[g]));
    ids.push_back(from.id[g]);
    grains.id.push_back(static_cast<std::int32_t>(from.id[g]));
    grains.species.push_back(species.species[g]);
    grains.radius.push_back(from.radius[g]);
    grains.mass.push_back(mass[g]);
    grains.fixed.push_back(species.species[g] == Species::boundary);
  }
  rows = RowsById(ids);
}

void ImportedBed::require_a_plane(const ArchiveMoment& first) const
{
  double low = infinity, high = -infinity;
  for (const auto& x : first.grains.position) {
    low = std::min(low, axes.out_of_plane(x));
    high = std::max(high, axes.out_of_plane(x));
  }
  const double radius = *std::max_element(grains.radius.begin(), grains.radius.end());
  if (high - low > radius / 10)
    throw UsageError(fmt::format(
        "{}: grains lie up to {:g} apart across the plane of the flow; name the plane with --axes "
        "(xy, xz); runs in three dimensions are not imported",
        first.place, high - low));
}

void ImportedBed::make_box(const ArchiveMoment& first)
{
  const auto axis = axes.axis_of_x();
  const bool any_periodic = first.periodic[0] || first.periodic[1] || first.periodic[2];
  if (!axis && any_periodic)
    throw UsageError(
        "the cell is periodic but the base does not lie along one of the archive's axes; check "
        "--gravity and --slope");
  double low = infinity, high = -infinity, bottom = infinity, top = -infinity;
  for (const auto& position : first.grains.position) {
    const Vec2 x = axes.in_plane(position);
    low = std::min(low, x.x());
    high = std::max(high, x.x());
    bottom = std::min(bottom, x.y());
    top = std::max(top, x.y());
  }
  if (axis) {
    low = axes.x_is_forward() ? first.low[*axis] : -first.high[*axis];
    high = axes.x_is_forward() ? first.high[*axis] : -first.low[*axis];
  }
  box.periodic_x = axis && first.periodic[static_cast<std::size_t>(*axis)];
  box.length_x = high - low;
  box.length_y = top - bottom + 2 * *std::max_element(grains.radius.begin(), grains.radius.end());
  shift_x = -low;
  if (!(box.length_x > 0))
    throw FormatError(fmt::format("{}: the cell has no length along the base", first.place));
}

/// The highest of the boundary grains below the middle of the others.
void ImportedBed::find_origin(const ArchiveMoment& first, const std::string& text)
{
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), origin);
  if (error == std::errc() && end == text.data() + text.size() && std::isfinite(origin)) return;
  if (text != "top" && text != "centre")
    throw UsageError(
        fmt::format("--origin '{}' is not top, centre, or a height in the archive", text));
  double sum = 0;
  std::size_t mobile = 0;
  const auto height = [&](std::size_t g) { return axes.in_plane(first.grains.position[g]).y(); };
  const auto& ids = first.grains.id;
  for (std::size_t g = 0; g < ids.size(); ++g)
    if (!is_boundary(static_cast<std::size_t>(rows.find(ids[g])))) {
      sum += height(g);
      ++mobile;
    }
  origin = -infinity;
  for (std::size_t g = 0; g < ids.size(); ++g)
    if (is_boundary(static_cast<std::size_t>(rows.find(ids[g]))) &&
        height(g) * static_cast<double>(mobile) <= sum)
      origin = std::max(origin, height(g) + (text == "top" ? first.grains.radius[g] : 0));
  if (!std::isfinite(origin))
    throw UsageError(
        "no boundary grains lie below the others: give the height in the archive that is "
        "y = 0");
}

}  // namespace grseg
