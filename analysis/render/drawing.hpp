// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/frames/contacts.hpp"
#include "analysis/render/colours.hpp"
#include "analysis/render/view.hpp"
#include "analysis/stress/partition_rule.hpp"
#include "formats/core/frame.hpp"

#include <optional>
#include <vector>

/// Shapes that are drawn of a frame, in metres in the plane of the picture. A grain or contact that
/// crosses a period appears once for each of its images.
namespace grseg {

struct Disc {
  Vec2 centre;
  double radius;
  Colour colour;
  double order;  // the lowest is drawn first
};

/// A contact, or one grain's part of it. It begins, with a round end, at the centre of a grain.
struct Line {
  Vec2 from, to;
  double width;
  Colour colour;
  bool round_end;  // the other end is at a grain, too
};

/// A straight wall perpendicular to the plane; `normal` points to the grains.
struct WallLine {
  Vec2 point, normal;
};

/// Everything in one panel. Walls are drawn first, then discs, then lines.
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
  bool below = false, above = false;  // some numbers lie beyond that end and have its colour
  Colour pale;                        // mixed into all colours, with the share `paleness`
  double paleness = 0;

  /// `place`: 0 to 1 along the map.
  Colour at_place(double place) const { return mix(map(place), pale, paleness); }
  Colour at(double value) const { return at_place((value - range.low) / range.length()); }
};

/// Colours of grains: by species, or by the numbers of a field.
struct GrainColours {
  std::vector<Colour> of_species;
  Colour boundary;                   // of boundary grains, and of grains without a number
  std::optional<ColourScale> scale;  // of the field; none: colours of species
};

/// Style of contacts, which are lines between centres, as wide as the normal force is strong. If there
/// is a rule, each grain's share of the line has the colour of its species and begins at its centre.
struct LineStyle {
  double width_per_newton = 0;  // m/N
  std::optional<PartitionRule> rule;
  std::vector<Colour> of_species;
  Colour plain;   // of all lines, without a rule
  Colour nobody;  // of shares that no species has: of the base, and of mixed contacts under `drop`
};

struct DrawingStyle {
  GrainColours grains;
  std::optional<LineStyle> lines;
};

/// Draws a frame. `values`: the field's number of each grain; empty without a field. In three
/// dimensions nearer grains come later, and contacts are drawn if their contact point lies in the slab.
template <int D>
Drawing draw_frame(const Grains& grains, const Frame<D>& frame, const std::vector<double>& values,
                   Walls<D> walls, const View& view, const DrawingStyle& style);

}  // namespace grseg
