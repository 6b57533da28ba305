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
  FieldChoice field;           // field that sets the colours of grains
  std::optional<Range> range;  // values at the ends of the colour scale; none: FieldEnds
  bool forces = false;         // true: contacts are drawn as lines
  double line_width = 0;       // line width of a contact with the force strong_force(), m
  PartitionRule rule;          // rule for the field pressure and for split lines
  bool split_lines = false;    // true: lines of mixed contacts are divided by `rule`
  std::string region, slice;   // texts of --region and --slice; "": the default
  Plane plane = Plane::xy;
  bool project = false;  // true: grains at any depth are drawn, not only those in a slice
  bool tilt = false;     // true: the picture is turned so that gravity points down the page
  Theme theme = themes[0].value;
  bool no_time = false, no_scale = false, no_bar = false;
  bool is_film = false;
  std::optional<double> width;  // width of the page, px
  double em = 18;               // size of letters, px
};

/// Pictures of frames of one run. All have the same view, colours, line widths and page layout.
template <int D>
class Picture {
 public:
  /// `frames`: numbers of all frames that will be drawn. `panels`: number of frames on one page. Throws
  /// UsageError if a setting does not fit the run. `run` and `grains` must outlive this object.
  Picture(const TrajectoryReader& run, const GroupedGrains& grains,
          const std::vector<std::size_t>& frames, std::size_t panels,
          const PictureSettings& settings);

  const Page& page() const { return page_; }
  /// Data of a frame that must be read before draw() is called.
  TrajectoryReader::Fields needs() const { return survey_.needs; }
  /// Drawing of a frame. Several threads may call this function at once.
  Drawing draw(const Frame<D>& frame) const;
  /// To be called if no drawing has a grain. Throws UsageError if a slice or region leaves all
  /// grains out.
  void refuse_as_empty() const;
  /// Paints one drawing per panel, and the legend.
  void paint(cairo_surface_t* surface, std::span<const Drawing> drawings) const;

 private:
  void choose_slab(LengthUnits units);
  void choose_grain_colours();
  void choose_lines();
  void lay_out_page(std::size_t panels);
  std::vector<LegendItem> legend(double scale, const Vec2& panel, double width,
                                 const Vec2& gravity) const;
  std::string slab_text() const;
  /// Angle by which a picture is turned if gravity has this direction, rad, counter-clockwise.
  double angle(const Vec2& gravity) const;

  const TrajectoryReader& run_;
  const GroupedGrains& grains_;
  PictureSettings settings_;
  const Theme& theme_;  // the theme in settings_
  std::optional<GrainField<D>> field_;
  Survey<D> survey_;
  View view_;
  DrawingStyle style_;
  double strong_force_ = 0;  // result of strong_force(), N
  int decimals_ = 0;         // number of decimals of times
  Vec2 gravity_;             // gravity in the first picture, its component in the plane, m/s^2
  bool shows_gravity_ = false;
  Page page_;
};

}  // namespace grseg
