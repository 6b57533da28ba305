// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/cli/words.hpp"
#include "formats/import/common/frame_tools.hpp"
#include "formats/import/convert/imported_bed.hpp"
#include "formats/import/convert/scan.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <limits>

namespace grseg {
namespace {

/// Row of the grain with this id. Throws FormatError if the frame does not have it.
std::size_t row_of(const ImportedBed& bed, std::int64_t id, const ArchiveFrame& raw,
                   const Frame<3>& frame)
{
  const auto found = bed.rows.find(id);
  if (found >= 0 && is_present(frame, row(found))) return row(found);
  throw FormatError(fmt::format(
      "{}: a contact names grain {}, which is not among the grains of this frame; are i and j "
      "ids, and were grains and contacts written at the same steps{}?",
      raw.place, id, hint_of_digits(id).empty() ? "" : ", with all digits (%d, not %g)"));
}

/// Throws FormatError for a number that is not finite; not all readers check this.
void require_numbers(const ImportedBed& bed, const ArchiveFrame& raw, const Frame<3>& frame)
{
  const auto fail = [&](const std::string& what) {
    throw FormatError(fmt::format("{}: {} has a number that is not finite", raw.place, what));
  };
  for (const auto id : raw.grains.id) {
    const auto g = row(bed.rows.find(id));
    if (!frame.position[g].allFinite() || !frame.velocity[g].allFinite() ||
        !frame.angular_velocity[g].allFinite() ||
        (!frame.force.empty() && !frame.force[g].allFinite()))
      fail(fmt::format("grain {}", id));
  }
  const auto& contacts = frame.contacts;
  for (std::size_t c = 0; c < contacts.size(); ++c)
    if (!contacts.force[c].allFinite() || !contacts.branch[c].allFinite() ||
        !std::isfinite(contacts.gap[c]))
      fail(fmt::format("a contact of grain {}", bed.known.id[row(contacts.i[c])]));
}

void require_same_cell(const ImportedBed& bed, const ArchiveFrame& raw)
{
  for (const auto& period : bed.periods) {
    const double length = raw.high[period.axis] - raw.low[period.axis];
    if (std::abs(length - period.length) > 1e-9 * period.length)
      throw FormatError(
          fmt::format("{}: the periodic length is {:.10g}, but {:.10g} in the first frame; a cell "
                      "that changes cannot be imported",
                      raw.place, length, period.length));
  }
}

/// Throws FormatError if a vector lacks a component, which in three dimensions would be read as 0.
void require_all_components(const ArchiveFrame& raw)
{
  auto missing = raw.grains.missing;
  missing.insert(missing.end(), raw.contacts.missing.begin(), raw.contacts.missing.end());
  if (missing.empty()) return;
  throw FormatError(fmt::format(
      "{}: a flow in three dimensions needs all components, but there is no {}; write this column "
      "as well, or leave out the other components of the same vector",
      raw.place, fmt::join(missing, ", nor ")));
}

void place(const ImportedBed& bed, const ArchiveFrame& raw, std::size_t g, std::size_t to,
           Frame<3>& frame)
{
  const auto& from = raw.grains;
  Vec3 x = bed.components(from.position[g]) + bed.shift;
  for (const auto& [direction, length, axis, forward] : bed.periods) {
    double periods = std::floor(x[direction] / length);
    if (periods != 0) x[direction] -= periods * length;
    if (x[direction] >= length) {  // possible by rounding
      x[direction] = 0;
      ++periods;
    }
    if (!from.image.empty()) {
      const double image = from.image[g][static_cast<std::size_t>(axis)];
      periods += forward ? image : -image;
    }
    if (!(std::abs(periods) <= std::numeric_limits<std::int32_t>::max()))
      throw FormatError(fmt::format("{}: grain {} is {:.3g} periods from the cell, more than 2^31",
                                    raw.place, from.id[g], periods));
    frame.image[to][static_cast<std::size_t>(direction)] = static_cast<std::int32_t>(periods);
  }
  frame.position[to] = x;
  frame.velocity[to] = bed.components(from.velocity[g]);
  frame.angular_velocity[to].setZero();
  if (!from.angular_velocity.empty())
    frame.angular_velocity[to] = bed.spin(from.angular_velocity[g]);
  if (from.force.empty()) return;
  // Forces on immobile grains are set to 0: they depend on the order of a program's computations.
  frame.force[to].setZero();
  if (!bed.is_boundary(to)) frame.force[to] = bed.components(from.force[g]);
}

void place_grains(const ImportedBed& bed, const ArchiveFrame& raw, Frame<3>& frame)
{
  const auto& from = raw.grains;
  const auto n = bed.grains.size();
  const auto refuse_others = [&](const std::string& what) {
    throw OtherGrains(
        fmt::format("{}: {}; not all frames have the grains of the first one", raw.place, what));
  };
  if (!bed.grains_come_and_go && from.size() != n)
    refuse_others(fmt::format("{}, but {} in the first frame", counted(from.size(), "grain"), n));
  if (bed.counts_periods && from.size() > 0 && !from.counts_periods())
    throw FormatError(fmt::format(
        "{}: earlier frames state how often grains have crossed the periodic cell, and this one "
        "does not; import them separately, with --begin and --end",
        raw.place));
  if (from.velocity.empty() && from.size() > 0)
    throw FormatError(fmt::format("{}: the grains have no velocities", raw.place));
  frame.position.resize(n);
  frame.image.resize(n);
  frame.velocity.resize(n);
  frame.angular_velocity.resize(n);
  frame.force.resize(bed.has_force ? n : 0);
  for (std::size_t g = 0; g < n; ++g) make_absent(frame, g);
  std::vector<bool> placed(n);
  for (std::size_t g = 0; g < from.size(); ++g) {
    const auto found = bed.rows.find(from.id[g]);
    if (found < 0) refuse_others(fmt::format("grain {} is not in the first frame", from.id[g]));
    if (placed[row(found)])
      throw FormatError(fmt::format("{}: grain {} appears twice{}", raw.place, from.id[g],
                                    hint_of_digits(from.id[g])));
    placed[row(found)] = true;
    require_same_grain(bed.known, row(found), from, g, raw.place);
    place(bed, raw, g, row(found), frame);
  }
}

void add_contact(const ImportedBed& bed, const ArchiveFrame& raw, std::size_t c, Frame<3>& frame)
{
  const auto& from = raw.contacts;
  const bool wall = !from.wall.empty() && from.wall[c] >= 0;
  auto i = row_of(bed, from.i[c], raw, frame);
  auto j = wall ? i : row_of(bed, from.j[c], raw, frame);
  if (!wall && i == j)
    throw FormatError(fmt::format("{}: a contact joins grain {} to itself; check --columns",
                                  raw.place, from.i[c]));
  if (bed.is_boundary(i) && (wall || bed.is_boundary(j))) return;
  Vec3 force = bed.components(from.force[c]);
  const bool has_branch = !from.branch.empty() && !std::isnan(from.branch[c].x());
  Vec3 branch = has_branch ? bed.components(from.branch[c])
                           : minimum_image(bed.box, frame.position[i] - frame.position[j]);
  const double radii = bed.grains.radius[i] + (wall ? 0 : bed.grains.radius[j]);
  double gap = branch.norm() - radii;
  if (!from.overlap.empty() && !std::isnan(from.overlap[c]))
    gap = -from.overlap[c];
  else if (!from.distance.empty() && !std::isnan(from.distance[c]))
    gap = from.distance[c] - radii;
  if (bed.is_boundary(i)) {
    std::swap(i, j);
    force = -force;
    branch = -branch;
  }
  auto& contacts = frame.contacts;
  contacts.i.push_back(static_cast<std::int32_t>(i));
  contacts.j.push_back(wall ? -from.wall[c] - 1 : static_cast<std::int32_t>(j));
  contacts.force.push_back(force);
  contacts.branch.push_back(branch);
  contacts.gap.push_back(gap);
}

}  // namespace

void ImportedBed::build(const ArchiveFrame& raw, Frame<3>& frame) const
{
  frame.step = raw.step ? *raw.step : std::llround(*raw.time / step);
  frame.time = raw.time.value_or(static_cast<double>(frame.step) * step);
  require_same_cell(*this, raw);
  if (box.dimension == 3) require_all_components(raw);
  place_grains(*this, raw, frame);
  frame.contacts.clear();
  frame.contacts.reserve(raw.contacts.size());
  for (std::size_t c = 0; c < raw.contacts.size(); ++c) add_contact(*this, raw, c, frame);
  require_numbers(*this, raw, frame);
}

}  // namespace grseg
