// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/import/convert/imported_bed.hpp"

#include "formats/import/common/text_values.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <tuple>

namespace grseg {

RowsById::RowsById(std::vector<std::int64_t> sorted_ids) : ids_(std::move(sorted_ids))
{
  const auto span = static_cast<std::uint64_t>(ids_.back() - ids_.front()) + 1;
  if (span > 8 * ids_.size() + 1024) return;
  dense_.assign(span, -1);
  for (std::size_t row = 0; row < ids_.size(); ++row)
    dense_[static_cast<std::size_t>(ids_[row] - ids_.front())] = static_cast<std::int32_t>(row);
}

std::int32_t RowsById::find(std::int64_t id) const
{
  if (ids_.empty() || id < ids_.front() || id > ids_.back()) return -1;
  if (!dense_.empty()) return dense_[static_cast<std::size_t>(id - ids_.front())];
  const auto at = std::lower_bound(ids_.begin(), ids_.end(), id);
  return *at == id ? static_cast<std::int32_t>(at - ids_.begin()) : -1;
}

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr auto largest_id = std::numeric_limits<std::int32_t>::max();  // limit of trajectory files

/// Settings of species, without base grains if the flow has walls and nothing names base grains.
SpeciesSettings base_settings(const ArchiveFrame& first, const RunFacts& facts,
                              SpeciesSettings settings)
{
  const auto& fixed = first.grains.fixed;
  const bool marked = std::find(fixed.begin(), fixed.end(), std::uint8_t{1}) != fixed.end();
  if (!facts.walls.empty() && !marked && !settings.boundary && !settings.boundary_ids)
    settings.boundary = "none";
  return settings;
}

}  // namespace

ImportedBed::ImportedBed(const ArchiveFrame& first, const RunFacts& facts,
                         const ImportSettings& settings, bool come_and_go)
    : axes(facts.orientation.axes),
      gravity(facts.orientation.gravity),
      step(facts.step),
      has_force(!first.grains.force.empty()),
      has_angular_velocity(!first.grains.angular_velocity.empty()),
      counts_periods(first.grains.counts_periods()),
      grains_come_and_go(come_and_go)
{
  box.dimension = facts.dimension;
  if (facts.dimension == 2) gravity.z() = 0;
  box.periodic_x = false;
  walls = parse_walls(settings.walls);
  make_grains(first, facts, base_settings(first, facts, settings.species));
  if (species.base == "none" && !facts.walls.empty())
    species.base = fmt::format("walls {}", fmt::join(facts.walls, ", "));
  require_no_other_period(first);
  make_box(first);
  find_origin(first, settings.origin);
  shift.y() = -origin;
}

Vec3 ImportedBed::components(const Vec3& vector) const
{
  Vec3 in_flow = axes.components(vector);
  if (box.dimension == 2) in_flow.z() = 0;
  return in_flow;
}

Vec3 ImportedBed::spin(const Vec3& angular_velocity) const
{
  if (box.dimension == 3) return axes.components(angular_velocity);
  return {0, 0, axes.spin_in_plane(angular_velocity)};
}

void ImportedBed::make_grains(const ArchiveFrame& first, const RunFacts& facts,
                              const SpeciesSettings& settings)
{
  const auto& from = first.grains;
  if (from.size() == 0)
    throw FormatError(fmt::format("{}: the first frame has no grains", first.place));
  for (std::size_t g = 0; g < from.size(); ++g) {
    if (from.id[g] < 0)
      throw FormatError(fmt::format("{}: id {} is negative", first.place, from.id[g]));
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
      throw FormatError(fmt::format("{}: grain {} appears twice{}", first.place, from.id[g],
                                    hint_of_digits(from.id[g])));
    ids.push_back(from.id[g]);
    grains.species.push_back(species.species[g]);
    grains.radius.push_back(from.radius[g]);
    grains.mass.push_back(mass[g]);
    grains.fixed.push_back(species.species[g] == Species::boundary);
    const auto keep = [g](const auto& its, auto& kept) {
      if (!its.empty()) kept.push_back(its[g]);
    };
    keep(from.id, known.id);
    keep(from.radius, known.radius);
    keep(from.mass, known.mass);
    keep(from.type, known.type);
    keep(from.fixed, known.fixed);
  }
  has_new_ids = ids.back() > largest_id;
  for (const auto id : ids)
    grains.id.push_back(static_cast<std::int32_t>(has_new_ids ? grains.id.size() + 1 : id));
  rows = RowsById(std::move(ids));
}

void ImportedBed::make_box(const ArchiveFrame& first)
{
  double bottom = infinity, top = -infinity;
  for (const auto& position : first.grains.position) {
    const double y = axes.components(position).y();
    bottom = std::min(bottom, y);
    top = std::max(top, y);
  }
  box.length_x = make_length(first, 0);
  box.length_y = top - bottom + 2 * *std::max_element(grains.radius.begin(), grains.radius.end());
  if (!(box.length_x > 0))
    throw FormatError(fmt::format("{}: the cell has no length along the base", first.place));
  if (box.dimension == 3) {
    box.length_z = make_length(first, 2);
    if (!(box.length_z > 0))
      throw FormatError(fmt::format("{}: the cell has no length across the flow", first.place));
  }
  for (const auto& period : periods)
    (period.direction == 0 ? box.periodic_x : box.periodic_z) = true;
}

/// Length of the cell along x or z; or of the bed, if the direction is not an axis of the archive.
double ImportedBed::make_length(const ArchiveFrame& first, int direction)
{
  const auto axis = axes.axis_of(direction);
  double low = infinity, high = -infinity;
  std::string source = "the extent of the grains";
  if (axis) {
    const auto k = static_cast<std::size_t>(*axis);
    double first_end = first.low[*axis], last_end = first.high[*axis];
    if (first.cell[k] == CellSource::told) source = "as told by --cell";
    if (first.cell[k] == CellSource::archive) source = "stated by the archive";
    if (const auto ends = between_walls(walls, *axis); ends && first.cell[k] != CellSource::told) {
      std::tie(first_end, last_end) = *ends;
      source = "between walls";
    }
    const bool forward = axes.is_forward(direction);
    low = forward ? first_end : -last_end;
    high = forward ? last_end : -first_end;
    if (first.periodic[k]) periods.push_back({direction, high - low, *axis, forward});
  } else {
    for (const auto& position : first.grains.position) {
      const double x = axes.components(position)[direction];
      low = std::min(low, x);
      high = std::max(high, x);
    }
  }
  const bool periodic = axis && first.periodic[static_cast<std::size_t>(*axis)];
  if (periodic)
    shift[direction] = -low;
  else
    (direction == 0 ? box.low_x : box.low_z) = low;
  cell += fmt::format("{}{:.6g} long along {}, {}", cell.empty() ? "" : "\n", high - low,
                      direction == 0 ? "x" : "z", source);
  return high - low;
}

std::string ImportedBed::coordinates() const
{
  std::string text;
  for (int direction = 0; direction < box.dimension; ++direction) {
    std::string sum;
    const auto add = [&](double factor, const std::string& term) {
      const auto sign = factor < 0 ? (sum.empty() ? "-" : " - ") : (sum.empty() ? "" : " + ");
      sum += sign + term;
    };
    for (int axis = 0; axis < 3; ++axis) {
      const double part = axes.components(Vec3::Unit(axis))[direction], size = std::abs(part);
      if (size > 1e-12)
        add(part, (size > 1 - 1e-12 ? "" : fmt::format("{:.6g} ", size)) + "xyz"[axis]);
    }
    if (shift[direction] != 0)
      add(shift[direction], fmt::format("{:.6g}", std::abs(shift[direction])));
    text += fmt::format("{}{} = {}", direction == 0 ? "" : ", ", "xyz"[direction], sum);
  }
  return text;
}

/// Throws UsageError if the cell is periodic in another direction than x and z.
void ImportedBed::require_no_other_period(const ArchiveFrame& first) const
{
  const auto across = axes.axis_of(2), along = axes.axis_of(0), normal = axes.axis_of(1);
  if (normal) require_open_normal(first, *normal);
  for (int axis = 0; axis < 3; ++axis) {
    if (!first.periodic[static_cast<std::size_t>(axis)] || axis == across || axis == along)
      continue;
    throw UsageError(
        "the cell is periodic but the base does not lie along one of the archive's axes; check "
        "--gravity and --slope");
  }
}

/// Sets y = 0 at the highest boundary grain below the mean height of the mobile grains, or at the
/// highest wall there if there are no boundary grains. A number in `text` is the height itself.
void ImportedBed::find_origin(const ArchiveFrame& first, const std::string& text)
{
  if (parse_finite(text, origin)) return;
  const auto top = find_choice(text, origin_words);
  if (!top)
    throw UsageError(
        fmt::format("--origin '{}' is not top, centre, or a height in the archive", text));
  double sum = 0;
  std::size_t mobile = 0;
  const auto height = [&](std::size_t g) { return axes.components(first.grains.position[g]).y(); };
  const auto& ids = first.grains.id;
  for (std::size_t g = 0; g < ids.size(); ++g)
    if (!is_boundary(static_cast<std::size_t>(rows.find(ids[g])))) {
      sum += height(g);
      ++mobile;
    }
  origin = -infinity;
  const bool has_base = mobile < ids.size();
  for (std::size_t g = 0; g < ids.size(); ++g)
    if (is_boundary(static_cast<std::size_t>(rows.find(ids[g]))) &&
        height(g) * static_cast<double>(mobile) <= sum)
      origin = std::max(origin, height(g) + (*top ? first.grains.radius[g] : 0));
  for (const auto& wall : walls) {
    const double up = axes.components(Vec3::Unit(wall.axis)).y();
    const bool is_floor =
        std::abs(up) > 1 - 1e-6 && up * wall.position * static_cast<double>(mobile) <= sum;
    if (!has_base && is_floor) origin = std::max(origin, up * wall.position);
  }
  if (!std::isfinite(origin))
    throw OpenQuestions(
        Question{"the height in the archive that is y = 0", proposed_origin(first.grains, axes),
                 "no base grains lie below the others; this is the lowest point of the grains"});
}

std::string proposed_origin(const ArchiveGrains& grains, const Axes& axes)
{
  double lowest = infinity;
  for (std::size_t g = 0; g < grains.size(); ++g)
    lowest = std::min(lowest, axes.components(grains.position[g]).y() - grains.radius[g]);
  return fmt::format("--origin {:.6g}", lowest);
}

}  // namespace grseg
