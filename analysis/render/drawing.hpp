// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/frames/contacts.hpp"
#include "analysis/render/colours.hpp"
#include "analysis/render/view.hpp"
#include "analysis/stress/partition_rule.hpp"
#include "formats/core/frame.hpp"

#include <optional>
#include <vector>

/// Shapes that show a frame, in metres in the plane of the picture. A grain or contact that crosses an end
/// of a period appears once for each of its periodic images.
namespace grseg {

struct Disc {
  Vec2 centre;
  double radius;
  Colour colour;
  double order;  // drawing order: discs with lower numbers are drawn first
};

/// Line of a contact, or the part of it that belongs to one grain. `from` is the centre of a grain, where the
/// line is round.
struct Line {
  Vec2 from, to;
  double width;
  Colour colour;
  bool round_end;  // true if `to` is round, too, because it is the centre of the other grain
};

/// A straight wall perpendicular to the plane of the picture; `normal` points to the grains.
struct WallLine {
  Vec2 point, normal;
};

/// All shapes of one panel of a picture. Walls are drawn first, then discs, then lines.
struct Drawing {
  double time = 0;              // time of the frame, s
  Vec2 gravity = Vec2::Zero();  // component of gravity in the plane, m/s^2
  std::vector<WallLine> walls;
  std::vector<Disc> discs;
  std::vector<Line> lines;
};

/// Colour scale of a field (grain_field.hpp).
struct ColourScale {
  ColourMap map = viridis;
  Range range{0, 1};
  bool below = false, above = false;  // true if some numbers lie below or above `range`
  Colour pale;                        // colour mixed into all colours, with the share `paleness`
  double paleness = 0;

  /// Colour at a place along the map, 0 to 1.
  Colour at_place(double place) const { return mix(map(place), pale, paleness); }
  Colour at(double value) const { return at_place((value - range.low) / range.length()); }
};

/// Colours of grains: by species, or by the values of a field.
struct GrainColours {
  std::vector<Colour> of_species;
  Colour boundary;                   // colour of boundary grains and of grains whose value is NaN
  std::optional<ColourScale> scale;  // colour scale of the field; none: colours of species
};

/// Style of contacts. A contact is a line between the centres of its grains; its width is proportional to
/// the normal force. With a partition rule, each grain's share of the line begins at the grain's centre
/// and has the colour of its species.
struct LineStyle {
  double width_per_newton = 0;  // line width over normal force, m/N
  std::optional<PartitionRule> rule;
  std::vector<Colour> of_species;
  Colour plain;   // colour of all lines if there is no rule
  Colour nobody;  // colour of shares without species: of the base, of mixed contacts under `drop`
};

struct DrawingStyle {
  GrainColours grains;
  std::optional<LineStyle> lines;
};

/// Draws a frame. `values`: value of the field for each grain; empty without a field. In three dimensions,
/// grains nearer to the viewer are drawn later, and only contacts with a contact point in the slab
/// (View::slab) are drawn.
template <int D>
Drawing draw_frame(const Grains& grains, const Frame<D>& frame, const std::vector<double>& values,
                   Walls<D> walls, const View& view, const DrawingStyle& style);

}  // namespace grseg
