// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/frames/contacts.hpp"
#include "analysis/render/colours.hpp"
#include "analysis/render/view.hpp"
#include "analysis/stress/partition_rule.hpp"
#include "formats/core/frame.hpp"

#include <optional>
#include <vector>

/// What of a frame is drawn, in metres in the plane of the picture; images of what crosses a period
/// are things of their own.
namespace grseg {

struct Disc {
  Vec2 centre;
  double radius;
  Colour colour;
  double order;  // the lowest is drawn first
};

/// A contact, or one grain's part of it. It begins at the centre of a grain, where it is round.
struct Line {
  Vec2 from, to;
  double width;
  Colour colour;
  bool round_end;  // it also ends at a grain
};

/// A straight wall that stands upright on the plane; `normal` points to the grains.
struct WallLine {
  Vec2 point, normal;
};

/// In the order in which it is drawn: walls, discs, lines.
struct Drawing {
  double time = 0;              // s
  Vec2 gravity = Vec2::Zero();  // m/s^2, its part in the plane
  std::vector<WallLine> walls;
  std::vector<Disc> discs;
  std::vector<Line> lines;
};

/// Colours of a field.
struct ColourScale {
  ColourMap map = viridis;
  Range range{0, 1};
  bool below = false, above = false;  // some numbers lie there and have the colour of the end
  Colour pale;                        // what all colours are mixed with, and its share
  double paleness = 0;

  /// `place`: 0 to 1 along the map.
  Colour at_place(double place) const { return mix(map(place), pale, paleness); }
  Colour at(double value) const { return at_place((value - range.low) / range.length()); }
};

/// What colour a grain has.
struct GrainColours {
  std::vector<Colour> of_species;
  Colour boundary;                   // and of grains without a number
  std::optional<ColourScale> scale;  // where they show a field
};

/// How contacts are drawn: their normal force is the width of a line between the centres. With a
/// rule a line has the colours of the species, and the part of it that belongs to each grain begins
/// at that grain's centre.
struct LineStyle {
  double width_per_newton = 0;  // m/N
  std::optional<PartitionRule> rule;
  std::vector<Colour> of_species;
  Colour plain;   // without a rule
  Colour nobody;  // what no species has: the part of the base, and mixed contacts under `drop`
};

struct DrawingStyle {
  GrainColours grains;
  std::optional<LineStyle> lines;
};

/// `values` is empty, or has a number for each grain. In three dimensions what is nearer comes
/// later; lines are those of the contacts whose contact point lies in the slab.
template <int D>
Drawing draw_frame(const Grains& grains, const Frame<D>& frame, const std::vector<double>& values,
                   Walls<D> walls, const View& view, const DrawingStyle& style);

}  // namespace grseg
