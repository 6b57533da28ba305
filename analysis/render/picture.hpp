// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/frames/grouping.hpp"
#include "analysis/render/drawing.hpp"
#include "analysis/render/grain_field.hpp"
#include "analysis/render/legend.hpp"
#include "analysis/render/survey.hpp"
#include "analysis/render/view.hpp"
#include "analysis/stress/partition_rule.hpp"
#include "formats/trajectory/reader.hpp"

#include <cairo.h>

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace grseg {

/// Content and look of the pictures of a run.
struct PictureSettings {
  FieldChoice field;           // that gives grains their colours
  std::optional<Range> range;  // of the field's colours
  bool forces = false;         // contacts as lines
  double line_width = 0;       // m, of a contact with strong_force()
  PartitionRule rule;          // of the field pressure, and of lines that are split
  bool split_lines = false;
  std::string region, slice;  // as typed; "": the default
  Plane plane = Plane::xy;
  bool project = false;  // all of the depth instead of a slice
  bool tilt = false;     // gravity points down the page
  Theme theme = themes[0].value;
  bool no_time = false, no_scale = false, no_bar = false;
  bool is_film = false;
  std::optional<double> width;  // px
  double em = 18;               // px
};

/// Pictures of frames of one run, which share view, colours, widths of lines and page.
template <int D>
class Picture {
 public:
  /// `frames`: numbers of all frames that will be drawn. `panels`: frames on one page. UsageError where
  /// a setting does not fit the run. Both run and grains must outlive this.
  Picture(const TrajectoryReader& run, const GroupedGrains& grains,
          const std::vector<std::size_t>& frames, std::size_t panels,
          const PictureSettings& settings);

  const Page& page() const { return page_; }
  /// Parts of a frame that must be read for draw().
  TrajectoryReader::Fields needs() const { return survey_.needs; }
  /// Drawing of a frame. Several threads may call it at once.
  Drawing draw(const Frame<D>& frame) const;
  /// Paints as many drawings as there are panels.
  void paint(cairo_surface_t* surface, std::span<const Drawing> drawings) const;

 private:
  void choose_slab(LengthUnits units);
  void choose_grain_colours();
  void choose_lines();
  void lay_out_page(std::size_t panels);
  std::vector<LegendItem> legend(double scale, const Vec2& panel, double width,
                                 const Vec2& gravity) const;
  std::string slab_text() const;
  /// Angle by which a picture with this gravity is turned, rad, counter-clockwise.
  double angle(const Vec2& gravity) const;

  const TrajectoryReader& run_;
  const GroupedGrains& grains_;
  PictureSettings settings_;
  const Theme& theme_;  // of settings_
  std::optional<GrainField<D>> field_;
  Survey<D> survey_;
  View view_;
  DrawingStyle style_;
  double strong_force_ = 0;  // N
  int decimals_ = 0;         // of times
  Vec2 gravity_;             // m/s^2, of the first picture, in the plane
  bool shows_gravity_ = false;
  Page page_;
};

}  // namespace grseg
