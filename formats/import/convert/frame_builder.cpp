// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/import/convert/frame_builder.hpp"

#include "formats/import/common/minimum_image.hpp"
#include "formats/import/convert/scan.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <limits>

namespace grseg {
namespace {

template <int D>
Spin<D> no_spin()
{
  if constexpr (D == 2)
    return 0;
  else
    return Spin<D>::Zero();
}

bool is_finite(double spin)
{
  return std::isfinite(spin);
}
bool is_finite(const Vec3& spin)
{
  return spin.allFinite();
}

}  // namespace

FrameBuilder::FrameBuilder(const ArchiveMoment& all, const RunFacts& facts,
                           const ImportSettings& settings, bool grains_come_and_go)
    : bed_(all, facts, settings),
      step_(facts.step),
      has_force_(!all.grains.force.empty()),
      counts_periods_(all.grains.counts_periods()),
      grains_come_and_go_(grains_come_and_go)
{
}

/// Of a grain that a contact names.
template <int D>
std::size_t FrameBuilder::row_of(std::int64_t id, const ArchiveMoment& moment,
                                 const Frame<D>& frame) const
{
  const auto row = bed_.rows.find(id);
  if (row >= 0 && is_present(frame, static_cast<std::size_t>(row)))
    return static_cast<std::size_t>(row);
  throw FormatError(fmt::format(
      "{}: a contact names grain {}, which is not among the grains of this moment; are i and j "
      "ids, and were grains and contacts written at the same steps?",
      moment.place, id));
}

template <int D>
void FrameBuilder::build(const ArchiveMoment& moment, Frame<D>& frame) const
{
  if (moment.step)
    frame.step = *moment.step;
  else
    frame.step = std::llround(*moment.time / step_);
  frame.time = moment.time.value_or(static_cast<double>(frame.step) * step_);
  require_same_cell(moment);
  if (D == 3) require_all_components(moment);
  place_grains(moment, frame);
  add_contacts(moment, frame.contacts, frame);
  require_numbers(moment, frame);
}

/// Readers of some formats do not check this.
template <int D>
void FrameBuilder::require_numbers(const ArchiveMoment& moment, const Frame<D>& frame) const
{
  const auto fail = [&](const std::string& what) {
    throw FormatError(fmt::format("{}: {} has a number that is not finite", moment.place, what));
  };
  const auto require_of_grain = [&](std::size_t g) {
    if (!frame.position[g].allFinite() || !frame.velocity[g].allFinite() ||
        !is_finite(frame.angular_velocity[g]) ||
        (!frame.force.empty() && !frame.force[g].allFinite()))
      fail(fmt::format("grain {}", bed_.known.id[g]));
  };
  for (const auto id : moment.grains.id)
    require_of_grain(static_cast<std::size_t>(bed_.rows.find(id)));
  const auto& contacts = frame.contacts;
  for (std::size_t c = 0; c < contacts.size(); ++c)
    if (!contacts.force[c].allFinite() || !contacts.branch[c].allFinite() ||
        !std::isfinite(contacts.gap[c]))
      fail(fmt::format("a contact of grain {}",
                       bed_.known.id[static_cast<std::size_t>(contacts.i[c])]));
}

void FrameBuilder::require_same_cell(const ArchiveMoment& moment) const
{
  for (const auto& period : bed_.periods) {
    const double length = moment.high[period.axis] - moment.low[period.axis];
    if (std::abs(length - period.length) > 1e-9 * period.length)
      throw FormatError(
          fmt::format("{}: the periodic length is {:.10g}, but {:.10g} in the first moment; a cell "
                      "that changes is not imported",
                      moment.place, length, period.length));
  }
}

/// A component that an archive of a flow in space lacks would be taken for 0.
void FrameBuilder::require_all_components(const ArchiveMoment& moment) const
{
  auto missing = moment.grains.missing;
  missing.insert(missing.end(), moment.contacts.missing.begin(), moment.contacts.missing.end());
  if (missing.empty()) return;
  throw FormatError(fmt::format(
      "{}: a flow in three dimensions needs all components, but there is no {}; write the "
      "columns, too, or leave out those that go with them",
      moment.place, fmt::join(missing, ", nor ")));
}

template <int D>
void FrameBuilder::place_grains(const ArchiveMoment& moment, Frame<D>& frame) const
{
  const auto& from = moment.grains;
  const auto n = bed_.grains.size();
  const auto refuse_others = [&](const std::string& what) {
    throw OtherGrains(fmt::format("{}: {}; the grains of the first moment are not those of all",
                                  moment.place, what));
  };
  if (!grains_come_and_go_ && from.size() != n)
    refuse_others(fmt::format("{} grains, but {} in the first moment", from.size(), n));
  if (counts_periods_ && from.size() > 0 && !from.counts_periods())
    throw FormatError(fmt::format(
        "{}: moments before tell how often grains have crossed the periods, and this one "
        "does not; import them separately, with --begin and --end",
        moment.place));
  if (from.velocity.empty() && from.size() > 0)
    throw FormatError(fmt::format("{}: the grains have no velocities", moment.place));
  frame.position.resize(n);
  frame.image.resize(n);
  frame.velocity.resize(n);
  frame.angular_velocity.resize(n);
  frame.force.resize(has_force_ ? n : 0);
  for (std::size_t row = 0; row < n; ++row) make_absent(frame, row);
  std::vector<bool> placed(n);
  for (std::size_t g = 0; g < from.size(); ++g) {
    const auto found = bed_.rows.find(from.id[g]);
    if (found < 0) refuse_others(fmt::format("grain {} is not in the first moment", from.id[g]));
    const auto row = static_cast<std::size_t>(found);
    if (placed[row])
      throw FormatError(fmt::format("{}: grain {} appears twice", moment.place, from.id[g]));
    placed[row] = true;
    require_same_grain(bed_.known, row, from, g, moment.place);
    place(moment, g, row, frame);
  }
}

template <int D>
void FrameBuilder::place(const ArchiveMoment& moment, std::size_t g, std::size_t row,
                         Frame<D>& frame) const
{
  const auto& from = moment.grains;
  Vector<D> x = bed_.axes.components<D>(from.position[g]) + bed_.shift.head<D>();
  for (const auto& [direction, length, axis, forward] : bed_.periods) {
    if (direction >= D) continue;
    double periods = std::floor(x[direction] / length);
    if (periods != 0) x[direction] -= periods * length;
    if (x[direction] >= length) {  // by rounding
      x[direction] = 0;
      ++periods;
    }
    if (!from.image.empty()) {
      const double image = from.image[g][static_cast<std::size_t>(axis)];
      periods += forward ? image : -image;
    }
    if (!(std::abs(periods) <= std::numeric_limits<std::int32_t>::max()))
      throw FormatError(fmt::format("{}: grain {} is {:.3g} periods from the cell, more than 2^31",
                                    moment.place, from.id[g], periods));
    frame.image[row][static_cast<std::size_t>(direction)] = static_cast<std::int32_t>(periods);
  }
  frame.position[row] = x;
  frame.velocity[row] = bed_.axes.components<D>(from.velocity[g]);
  frame.angular_velocity[row] =
      from.angular_velocity.empty() ? no_spin<D>() : bed_.axes.spin<D>(from.angular_velocity[g]);
  if (from.force.empty()) return;
  // What programs write as the force on held grains depends on the order of their computations.
  frame.force[row] =
      bed_.is_boundary(row) ? Vector<D>(Vector<D>::Zero()) : bed_.axes.components<D>(from.force[g]);
}

template <int D>
void FrameBuilder::add_contacts(const ArchiveMoment& moment, ContactList<D>& contacts,
                                const Frame<D>& frame) const
{
  contacts.clear();
  contacts.reserve(moment.contacts.size());
  for (std::size_t c = 0; c < moment.contacts.size(); ++c) add_contact(moment, c, frame, contacts);
}

template <int D>
void FrameBuilder::add_contact(const ArchiveMoment& moment, std::size_t c, const Frame<D>& frame,
                               ContactList<D>& contacts) const
{
  const auto& from = moment.contacts;
  const bool wall = !from.wall.empty() && from.wall[c] >= 0;
  auto i = row_of(from.i[c], moment, frame);
  auto j = wall ? i : row_of(from.j[c], moment, frame);
  if (!wall && i == j)
    throw FormatError(fmt::format("{}: a contact joins grain {} to itself; check --columns",
                                  moment.place, from.i[c]));
  if (bed_.is_boundary(i) && (wall || bed_.is_boundary(j))) return;

  Vector<D> force = bed_.axes.components<D>(from.force[c]);
  const bool has_branch = !from.branch.empty() && !std::isnan(from.branch[c].x());
  Vector<D> branch = !has_branch ? minimum_image<D>(bed_.box, frame.position[i] - frame.position[j])
                                 : bed_.axes.components<D>(from.branch[c]);
  const double radii = bed_.grains.radius[i] + (wall ? 0 : bed_.grains.radius[j]);
  double gap = branch.norm() - radii;
  if (!from.overlap.empty() && !std::isnan(from.overlap[c]))
    gap = -from.overlap[c];
  else if (!from.distance.empty() && !std::isnan(from.distance[c]))
    gap = from.distance[c] - radii;
  if (bed_.is_boundary(i)) {
    std::swap(i, j);
    force = -force;
    branch = -branch;
  }
  contacts.i.push_back(static_cast<std::int32_t>(i));
  contacts.j.push_back(wall ? -from.wall[c] - 1 : static_cast<std::int32_t>(j));
  contacts.force.push_back(force);
  contacts.branch.push_back(branch);
  contacts.gap.push_back(gap);
}

template void FrameBuilder::build<2>(const ArchiveMoment&, Frame<2>&) const;
template void FrameBuilder::build<3>(const ArchiveMoment&, Frame<3>&) const;

}  // namespace grseg
