// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/render/drawing.hpp"

#include "analysis/frames/contacts.hpp"
#include "analysis/stress/partition_rule.hpp"
#include "formats/core/species.hpp"

#include <algorithm>
#include <cmath>

namespace grseg {
namespace {

Colour colour_of(const Grains& grains, std::size_t g, const std::vector<double>& values,
                 const GrainColours& colours)
{
  if (!is_mobile(grains, g)) return colours.boundary;
  if (!colours.scale) return colours.of_species[static_cast<std::size_t>(grains.species[g])];
  return std::isnan(values[g]) ? colours.boundary : colours.scale->at(values[g]);
}

/// A disc and when it is drawn: the lowest first.
struct Placed {
  double order;
  Disc disc;
};

template <int D>
std::vector<Disc> discs_of(const Grains& grains, const Frame<D>& frame,
                           const std::vector<double>& values, const View& view,
                           const GrainColours& colours)
{
  std::vector<Placed> placed;
  placed.reserve(grains.size());
  for (std::size_t g = 0; g < grains.size(); ++g) {
    if (!is_present(frame, g)) continue;
    const auto nearness = view.nearness<D>(frame.position[g]);
    if (!nearness) continue;
    // In two dimensions nothing is nearer; boundary grains then lie below.
    const double order = D == 3 ? *nearness : is_mobile(grains, g) ? 1 : 0;
    const Vec2 centre = view.flat<D>(frame.position[g]);
    const Vec2 reach = Vec2::Constant(grains.radius[g]);
    const Colour colour = colour_of(grains, g, values, colours);
    view.for_images(centre - reach, centre + reach, [&](const Vec2& shift) {
      placed.push_back({order, {centre + shift, grains.radius[g], colour}});
    });
  }
  std::stable_sort(placed.begin(), placed.end(),
                   [](const Placed& a, const Placed& b) { return a.order < b.order; });
  std::vector<Disc> discs;
  discs.reserve(placed.size());
  for (const auto& each : placed) discs.push_back(each.disc);
  return discs;
}

/// A contact on the page: `i` and `j` are where its grains' centres are, or j the contact point at a
/// wall.
struct Contact {
  Vec2 i, j;
  double width;
};

/// The lines of a contact whose grains have these parts of it.
template <int D>
void add_shared(std::vector<Line>& lines, const Contact& line, const Grains& grains,
                const Frame<D>& frame, std::size_t k, const LineStyle& style)
{
  const auto [i, j] = partners(grains, frame, k);
  const auto shares = contact_shares(grains, frame, k, *style.rule);
  const auto colour = [&](std::size_t g) {
    return style.of_species[static_cast<std::size_t>(grains.species[g])];
  };
  const Vec2 along = line.j - line.i;
  if (j && grains.species[i] == grains.species[*j]) {
    lines.push_back({line.i, line.j, line.width, colour(i), true});
    return;
  }
  if (shares.i + shares.j < 1) lines.push_back({line.i, line.j, line.width, style.nobody, true});
  if (shares.i > 0)
    lines.push_back({line.i, line.i + shares.i * along, line.width, colour(i), shares.i == 1});
  if (shares.j > 0)
    lines.push_back({line.j, line.j - shares.j * along, line.width, colour(*j), shares.j == 1});
}

template <int D>
std::vector<Line> lines_of(const Grains& grains, const Frame<D>& frame, const View& view,
                           const LineStyle& style)
{
  std::vector<Line> lines;
  const auto& list = frame.contacts;
  lines.reserve(list.size());
  for (std::size_t k = 0; k < list.size(); ++k) {
    const double force = force_parts(list, k).f_n;
    if (!(force > 0) || !view.nearness<D>(contact_point(grains, frame, k))) continue;
    const auto& centre = frame.position[static_cast<std::size_t>(list.i[k])];
    const Vec2 from = view.flat<D>(centre), to = from - view.flat<D>(list.branch[k]);
    const double width = style.width_per_newton * force;
    const Vec2 margin = Vec2::Constant(width / 2);
    view.for_images(from.cwiseMin(to) - margin, from.cwiseMax(to) + margin, [&](const Vec2& shift) {
      const Contact contact{from + shift, to + shift, width};
      if (style.rule)
        add_shared(lines, contact, grains, frame, k, style);
      else
        lines.push_back({contact.i, contact.j, width, style.plain, true});
    });
  }
  // Strong contacts over weak ones.
  std::stable_sort(lines.begin(), lines.end(),
                   [](const Line& a, const Line& b) { return a.width < b.width; });
  return lines;
}

template <int D>
std::vector<WallLine> walls_of(const Walls<D>& walls, const View& view)
{
  std::vector<WallLine> lines;
  for (const auto& [number, wall] : walls.all()) {
    const Vec2 normal = view.flat<D>(wall.normal);
    if (normal.norm() > 0.999) lines.push_back({view.flat<D>(wall.point), normal.normalized()});
  }
  return lines;
}

}  // namespace

template <int D>
Drawing draw_frame(const Grains& grains, const Frame<D>& frame, const std::vector<double>& values,
                   Walls<D> walls, const View& view, const DrawingStyle& style)
{
  walls.add(frame);
  Drawing drawing;
  drawing.time = frame.time;
  drawing.walls = walls_of(walls, view);
  drawing.discs = discs_of(grains, frame, values, view, style.grains);
  if (style.lines) drawing.lines = lines_of(grains, frame, view, *style.lines);
  return drawing;
}

template Drawing draw_frame(const Grains&, const Frame<2>&, const std::vector<double>&, Walls<2>,
                            const View&, const DrawingStyle&);
template Drawing draw_frame(const Grains&, const Frame<3>&, const std::vector<double>&, Walls<3>,
                            const View&, const DrawingStyle&);

}  // namespace grseg
