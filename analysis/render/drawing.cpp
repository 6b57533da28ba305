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

template <int D>
std::vector<Disc> discs_of(const Grains& grains, const Frame<D>& frame,
                           const std::vector<double>& values, const View& view,
                           const GrainColours& colours)
{
  std::vector<Disc> discs;
  discs.reserve(grains.size());
  for (std::size_t g = 0; g < grains.size(); ++g) {
    if (!is_present(frame, g)) continue;
    const auto nearness = view.nearness<D>(frame.position[g]);
    if (!nearness) continue;
    // In two dimensions all grains are equally near, and boundary grains are drawn first.
    const double order = D == 3 ? *nearness : is_mobile(grains, g) ? 1 : 0;
    const Vec2 centre = view.flat<D>(frame.position[g]);
    const Vec2 reach = Vec2::Constant(grains.radius[g]);
    const Colour colour = colour_of(grains, g, values, colours);
    view.for_images(centre - reach, centre + reach, [&](const Vec2& shift) {
      discs.push_back({centre + shift, grains.radius[g], colour, order});
    });
  }
  std::ranges::stable_sort(discs, {}, &Disc::order);
  return discs;
}

/// Adds the line `whole` of contact `k`, divided by the rule of the style into parts with the colours of the
/// two species.
template <int D>
void add_shared(std::vector<Line>& lines, const Line& whole, const Grains& grains,
                const Frame<D>& frame, std::size_t k, const LineStyle& style)
{
  const auto [i, j] = partners(grains, frame, k);
  const auto shares = contact_shares(grains, frame, k, *style.rule);
  const auto colour = [&](std::size_t g) {
    return style.of_species[static_cast<std::size_t>(grains.species[g])];
  };
  const Vec2 &from = whole.from, &to = whole.to;
  const double width = whole.width;
  const Vec2 along = to - from;
  if (j && grains.species[i] == grains.species[*j]) {
    lines.push_back({from, to, width, colour(i), true});
    return;
  }
  if (shares.i + shares.j < 1) lines.push_back({from, to, width, style.nobody, true});
  if (shares.i > 0)
    lines.push_back({from, from + shares.i * along, width, colour(i), shares.i == 1});
  if (shares.j > 0) lines.push_back({to, to - shares.j * along, width, colour(*j), shares.j == 1});
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
      const Line whole{from + shift, to + shift, width, style.plain, true};
      if (style.rule)
        add_shared(lines, whole, grains, frame, k, style);
      else
        lines.push_back(whole);
    });
  }
  // Strong contacts are drawn last, over weak ones.
  std::ranges::stable_sort(lines, {}, &Line::width);
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
