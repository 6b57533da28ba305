// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/import/convert/frame_builder.hpp"

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

RowsById::RowsById(const std::vector<std::int64_t>& ids)
{
  first_ = ids.front();
  const auto span = static_cast<std::uint64_t>(ids.back() - ids.front()) + 1;
  if (span <= 8 * ids.size() + 1024) dense_.assign(span, -1);
  for (std::size_t row = 0; row < ids.size(); ++row) {
    if (dense_.empty())
      sparse_[ids[row]] = static_cast<std::int32_t>(row);
    else
      dense_[static_cast<std::size_t>(ids[row] - first_)] = static_cast<std::int32_t>(row);
  }
}

std::int32_t RowsById::find(std::int64_t id) const
{
  if (dense_.empty()) {
    const auto found = sparse_.find(id);
    return found == sparse_.end() ? -1 : found->second;
  }
  const auto place = static_cast<std::uint64_t>(id - first_);
  return id < first_ || place >= dense_.size() ? -1 : dense_[place];
}

FrameBuilder::FrameBuilder(const ArchiveMoment& first, const RunFacts& facts,
                           const ImportSettings& settings)
    : axes_(facts.plane.axes), step_(facts.step)
{
  make_grains(first, facts, settings.species);
  require_a_plane(first);
  make_box(first);
  find_origin(first, settings.origin);
}

void FrameBuilder::make_grains(const ArchiveMoment& first, const RunFacts& facts,
                               const SpeciesSettings& settings)
{
  const auto& from = first.grains;
  if (from.size() == 0)
    throw FormatError(fmt::format("{}: the first moment holds no grains", first.place));
  for (std::size_t g = 0; g < from.size(); ++g) {
    if (from.id[g] < 0 || from.id[g] > most_ids)
      throw FormatError(fmt::format("{}: id {} is not from 0 to 2^31", first.place, from.id[g]));
    if (!(from.radius[g] > 0))
      throw FormatError(
          fmt::format("{}: grain {} has the radius {:g}", first.place, from.id[g], from.radius[g]));
  }
  std::vector<std::size_t> order(from.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return from.id[a] < from.id[b]; });

  species_ = tell_species(from, settings);
  const auto mass = masses_of(from, facts);
  std::vector<std::int64_t> ids;
  for (const auto g : order) {
    if (!ids.empty() && ids.back() == from.id[g])
      throw FormatError(fmt::format("{}: grain {} is there twice", first.place, from.id[g]));
    ids.push_back(from.id[g]);
    grains_.id.push_back(static_cast<std::int32_t>(from.id[g]));
    grains_.species.push_back(species_.species[g]);
    grains_.radius.push_back(from.radius[g]);
    grains_.mass.push_back(mass[g]);
    grains_.fixed.push_back(species_.species[g] == Species::boundary);
  }
  rows_ = RowsById(ids);
}

void FrameBuilder::require_a_plane(const ArchiveMoment& first) const
{
  double low = infinity, high = -infinity;
  for (const auto& x : first.grains.position) {
    low = std::min(low, axes_.out_of_plane(x));
    high = std::max(high, axes_.out_of_plane(x));
  }
  const double radius = *std::max_element(grains_.radius.begin(), grains_.radius.end());
  if (high - low > radius / 10)
    throw UsageError(fmt::format(
        "{}: grains lie up to {:g} apart across the plane of the flow; name the plane with --axes "
        "(xy, xz); runs in three dimensions are not imported",
        first.place, high - low));
}

void FrameBuilder::make_box(const ArchiveMoment& first)
{
  const auto axis = axes_.axis_of_x();
  const bool any_periodic = first.periodic[0] || first.periodic[1] || first.periodic[2];
  if (!axis && any_periodic)
    throw UsageError(
        "the cell is periodic but the base does not lie along one of the archive's axes; check "
        "--gravity and --slope");
  double low = infinity, high = -infinity, bottom = infinity, top = -infinity;
  for (const auto& position : first.grains.position) {
    const Vec2 x = axes_.in_plane(position);
    low = std::min(low, x.x());
    high = std::max(high, x.x());
    bottom = std::min(bottom, x.y());
    top = std::max(top, x.y());
  }
  if (axis) {
    low = axes_.x_is_forward() ? first.low[*axis] : -first.high[*axis];
    high = axes_.x_is_forward() ? first.high[*axis] : -first.low[*axis];
  }
  box_.periodic_x = axis && first.periodic[static_cast<std::size_t>(*axis)];
  box_.length_x = high - low;
  box_.length_y =
      top - bottom + 2 * *std::max_element(grains_.radius.begin(), grains_.radius.end());
  shift_x_ = -low;
  if (!(box_.length_x > 0))
    throw FormatError(fmt::format("{}: the cell has no length along the base", first.place));
}

/// The highest of the boundary grains below the middle of the others.
void FrameBuilder::find_origin(const ArchiveMoment& first, const std::string& text)
{
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), origin_);
  if (error == std::errc() && end == text.data() + text.size() && std::isfinite(origin_)) return;
  if (text != "top" && text != "centre")
    throw UsageError(
        fmt::format("--origin '{}' is not top, centre, or a height in the archive", text));
  double sum = 0;
  std::size_t mobile = 0;
  const auto height = [&](std::size_t g) { return axes_.in_plane(first.grains.position[g]).y(); };
  const auto& ids = first.grains.id;
  for (std::size_t g = 0; g < ids.size(); ++g)
    if (!is_boundary(row_of(ids[g], first))) {
      sum += height(g);
      ++mobile;
    }
  origin_ = -infinity;
  for (std::size_t g = 0; g < ids.size(); ++g)
    if (is_boundary(row_of(ids[g], first)) && height(g) * static_cast<double>(mobile) <= sum)
      origin_ = std::max(origin_, height(g) + (text == "top" ? first.grains.radius[g] : 0));
  if (!std::isfinite(origin_))
    throw UsageError(
        "no boundary grains lie below the others: say with --origin which height in the archive is "
        "y = 0");
}

std::size_t FrameBuilder::row_of(std::int64_t id, const ArchiveMoment& moment) const
{
  const auto row = rows_.find(id);
  if (row >= 0) return static_cast<std::size_t>(row);
  throw FormatError(fmt::format(
      "{}: grain {} is not among those of the first moment; the number of grains must not change",
      moment.place, id));
}

void FrameBuilder::build(const ArchiveMoment& moment, Frame& frame) const
{
  if (moment.step)
    frame.step = *moment.step;
  else
    frame.step = std::llround(*moment.time / step_);
  frame.time = moment.time.value_or(static_cast<double>(frame.step) * step_);
  require_same_cell(moment);
  place_grains(moment, frame);
  add_contacts(moment, frame.contacts, frame);
  require_numbers(moment, frame);
}

/// What readers of some formats let through.
void FrameBuilder::require_numbers(const ArchiveMoment& moment, const Frame& frame) const
{
  const auto fail = [&](const std::string& what) {
    throw FormatError(fmt::format("{}: {} has a number that is not finite", moment.place, what));
  };
  for (std::size_t g = 0; g < grains_.size(); ++g)
    if (!frame.position[g].allFinite() || !frame.velocity[g].allFinite() ||
        !std::isfinite(frame.angular_velocity[g]) ||
        (!frame.force.empty() && !frame.force[g].allFinite()))
      fail(fmt::format("grain {}", grains_.id[g]));
  const auto& contacts = frame.contacts;
  for (std::size_t c = 0; c < contacts.size(); ++c)
    if (!contacts.force[c].allFinite() || !contacts.branch[c].allFinite() ||
        !std::isfinite(contacts.gap[c]))
      fail(fmt::format("a contact of grain {}",
                       grains_.id[static_cast<std::size_t>(contacts.i[c])]));
}

void FrameBuilder::require_same_cell(const ArchiveMoment& moment) const
{
  if (!box_.periodic_x) return;
  const auto axis = *axes_.axis_of_x();
  const double length = moment.high[axis] - moment.low[axis];
  if (std::abs(length - box_.length_x) > 1e-9 * box_.length_x)
    throw FormatError(
        fmt::format("{}: the periodic length is {:.10g} after {:.10g} in the first moment; a cell "
                    "that changes is not imported",
                    moment.place, length, box_.length_x));
}

void FrameBuilder::place_grains(const ArchiveMoment& moment, Frame& frame) const
{
  const auto& from = moment.grains;
  const auto n = grains_.size();
  if (from.size() != n)
    throw FormatError(fmt::format(
        "{}: {} grains after {} in the first moment; the number of grains must not change",
        moment.place, from.size(), n));
  if (from.velocity.empty())
    throw FormatError(fmt::format("{}: the grains have no velocities", moment.place));
  // What is in none of the rows has been left out for a grain that is there twice.
  frame.position.assign(n, Vec2::Constant(NAN));
  frame.image.assign(n, {0, 0});
  frame.velocity.resize(n);
  frame.angular_velocity.assign(n, 0);
  frame.force.assign(from.force.empty() ? 0 : n, Vec2::Zero());
  for (std::size_t g = 0; g < n; ++g) {
    const auto row = row_of(from.id[g], moment);
    if (!std::isnan(frame.position[row].x()))
      throw FormatError(fmt::format("{}: grain {} is there twice", moment.place, from.id[g]));
    if (!from.radius.empty() &&
        std::abs(from.radius[g] - grains_.radius[row]) > 1e-5 * grains_.radius[row])
      throw FormatError(fmt::format("{}: the radius of grain {} changes from {:g} to {:g}",
                                    moment.place, from.id[g], grains_.radius[row], from.radius[g]));
    place(moment, g, row, frame);
  }
}

void FrameBuilder::place(const ArchiveMoment& moment, std::size_t g, std::size_t row,
                         Frame& frame) const
{
  const auto& from = moment.grains;
  Vec2 x = axes_.in_plane(from.position[g]);
  x.x() += shift_x_;
  x.y() -= origin_;
  if (box_.periodic_x) {
    double periods = std::floor(x.x() / box_.length_x);
    if (periods != 0) x.x() -= periods * box_.length_x;
    if (x.x() >= box_.length_x) {  // by rounding
      x.x() = 0;
      ++periods;
    }
    if (!from.image.empty()) {
      const auto image = from.image[g][static_cast<std::size_t>(*axes_.axis_of_x())];
      periods += axes_.x_is_forward() ? image : -image;
    }
    frame.image[row][0] = static_cast<std::int32_t>(periods);
  }
  frame.position[row] = x;
  frame.velocity[row] = axes_.in_plane(from.velocity[g]);
  if (!from.angular_velocity.empty())
    frame.angular_velocity[row] = axes_.counter_clockwise(from.angular_velocity[g]);
  // What programs say about the force on grains that are held depends on the order of their parts.
  if (!from.force.empty() && !is_boundary(row)) frame.force[row] = axes_.in_plane(from.force[g]);
}

void FrameBuilder::add_contacts(const ArchiveMoment& moment, ContactList& contacts,
                                const Frame& frame) const
{
  contacts.clear();
  contacts.reserve(moment.contacts.size());
  for (std::size_t c = 0; c < moment.contacts.size(); ++c) add_contact(moment, c, frame, contacts);
}

void FrameBuilder::add_contact(const ArchiveMoment& moment, std::size_t c, const Frame& frame,
                               ContactList& contacts) const
{
  const auto& from = moment.contacts;
  const bool wall = !from.wall.empty() && from.wall[c] >= 0;
  auto i = row_of(from.i[c], moment);
  auto j = wall ? i : row_of(from.j[c], moment);
  if (!wall && i == j)
    throw FormatError(fmt::format("{}: a contact joins grain {} to itself; check --columns",
                                  moment.place, from.i[c]));
  if (is_boundary(i) && (wall || is_boundary(j))) return;

  Vec2 force = axes_.in_plane(from.force[c]);
  Vec2 branch;
  if (!from.branch.empty()) {
    branch = axes_.in_plane(from.branch[c]);
  } else {
    branch = frame.position[i] - frame.position[j];
    if (box_.periodic_x) branch.x() -= box_.length_x * std::round(branch.x() / box_.length_x);
  }
  const double radii = grains_.radius[i] + (wall ? 0 : grains_.radius[j]);
  double gap = branch.norm() - radii;
  if (!from.overlap.empty())
    gap = -from.overlap[c];
  else if (!from.distance.empty())
    gap = from.distance[c] - radii;
  if (is_boundary(i)) {
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

}  // namespace grseg
