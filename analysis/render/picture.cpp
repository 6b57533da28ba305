// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/render/picture.hpp"

#include "analysis/render/canvas.hpp"
#include "analysis/render/painter.hpp"
#include "analysis/render/picture_file.hpp"
#include "formats/core/errors.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

namespace grseg {
namespace {

// Share of the background that is mixed into grains under lines, so that lines stand out.
constexpr double pale_species = 0.62, pale_field = 0.45;

/// Number of decimals that tell the times of the pictures from times of neighbouring frames: the
/// least with which all are off by less than a hundredth of the mean distance of frames.
int decimals_of(const TrajectoryReader& run, const std::vector<std::size_t>& frames)
{
  constexpr int most = 6;
  const auto& times = run.times();
  const double between =
      times.size() > 1 ? (times.back() - times.front()) / static_cast<double>(times.size() - 1) : 1;
  for (int decimals = 0; decimals < most; ++decimals) {
    const double unit = std::pow(10, -decimals);
    const bool all = std::ranges::all_of(frames, [&](std::size_t frame) {
      const double time = times[frame];
      return std::abs(time - std::round(time / unit) * unit) < 0.01 * between;
    });
    if (all) return decimals;
  }
  return most;
}

/// Region shown by default: the whole period along a periodic axis; along another axis as far as grains
/// reach, plus a margin of a third of the largest diameter.
template <int D>
Region whole_region(const Survey<D>& survey, const View& view)
{
  const double room = survey.largest_diameter / 3;
  Region region{view.flat<D>(survey.low), view.flat<D>(survey.high)};
  for (int axis = 0; axis < 2; ++axis) {
    if (view.period(axis) > 0) {
      region.low[axis] = 0;
      region.high[axis] = view.period(axis);
    } else {
      region.low[axis] -= room;
      region.high[axis] += room;
    }
  }
  return region;
}

}  // namespace

template <int D>
Picture<D>::Picture(const TrajectoryReader& run, const GroupedGrains& grains,
                    const std::vector<std::size_t>& frames, std::size_t panels,
                    const PictureSettings& settings)
    : run_(run),
      grains_(grains),
      settings_(settings),
      theme_(settings_.theme),
      field_(settings.field.is_species()
                 ? std::nullopt
                 : std::optional<GrainField<D>>(std::in_place, settings.field, run, grains.grains,
                                                grains.species, settings.rule)),
      survey_(survey_frames<D>(run, frames, grains.grains, field_)),
      view_(settings.plane, run.box())
{
  const LengthUnits units{run.small_diameter(), run.large_diameter()};
  if (!(survey_.largest_diameter > 0))
    throw RunError(fmt::format("{}: the run has no grains to draw", run.path()));
  view_.region = whole_region(survey_, view_);
  if (!settings.region.empty())
    view_.region = parse_region(settings.region, view_, view_.region, units);
  choose_slab(units);
  choose_grain_colours();
  if (settings.forces) choose_lines();
  decimals_ = decimals_of(run, frames);
  gravity_ = view_.flat<D>(run.gravity<D>().at(survey_.times.front()));
  if (settings.tilt && !(gravity_.norm() > 0))
    throw UsageError("--tilt: gravity has no component in the plane of the picture");
  // One arrow for all panels is enough, unless gravity turns between panels.
  const bool common = panels == 1 || settings.tilt || !run.gravity<D>().turns();
  shows_gravity_ = common && gravity_.norm() > 0;
  lay_out_page(panels);
}

template <int D>
void Picture<D>::choose_slab(LengthUnits units)
{
  if constexpr (D == 2) {
    if (settings_.project || !settings_.slice.empty() || settings_.plane != Plane::xy)
      throw UsageError("--plane, --slice and --project are for runs in three dimensions");
    return;
  }
  if (settings_.project) return;
  if (!settings_.slice.empty()) {
    view_.slab = parse_slab(settings_.slice, units);
    return;
  }
  const auto depth = view_.depth_axis() % D;
  const double middle = view_.depth_period() > 0 ? view_.depth_period() / 2
                                                 : (survey_.low[depth] + survey_.high[depth]) / 2;
  const double half = survey_.largest_diameter / 2;
  view_.slab = Range{middle - half, middle + half};
}

template <int D>
void Picture<D>::choose_grain_colours()
{
  auto& colours = style_.grains;
  const double paleness = settings_.forces ? pale_species : 0;
  const auto pale = [&](const Colour& colour) { return mix(colour, theme_.background, paleness); };
  colours.boundary = pale(theme_.boundary);
  const std::size_t count = grains_.species.size();
  for (std::size_t k = 0; k < count; ++k)
    colours.of_species.push_back(pale(species_colours(k, count).grain));
  if (!field_) return;
  const auto ends = field_->definition().ends;
  ColourScale scale;
  scale.map = ends == FieldEnds::both_signs ? blue_white_red : viridis;
  scale.range = settings_.range ? *settings_.range : range_of(ends, survey_.values);
  scale.pale = theme_.background;
  scale.paleness = settings_.forces ? pale_field : 0;
  for (const double value : survey_.values) {
    scale.below = scale.below || value < scale.range.low;
    scale.above = scale.above || value > scale.range.high;
  }
  colours.scale = scale;
}

template <int D>
void Picture<D>::choose_lines()
{
  LineStyle lines;
  strong_force_ = strong_force(survey_.forces);
  if (strong_force_ > 0) lines.width_per_newton = settings_.line_width / strong_force_;
  if (settings_.split_lines) lines.rule = settings_.rule;
  const std::size_t count = grains_.species.size();
  for (std::size_t k = 0; k < count; ++k)
    lines.of_species.push_back(species_colours(k, count).line);
  lines.plain = theme_.ink;
  lines.nobody = mix(theme_.ink, theme_.background, 0.4);
  style_.lines = lines;
}

template <int D>
double Picture<D>::angle(const Vec2& gravity) const
{
  return settings_.tilt ? -std::atan2(gravity.x(), -gravity.y()) : 0;
}

template <int D>
void Picture<D>::lay_out_page(std::size_t panels)
{
  PageContent content;
  content.panels = panels;
  content.titles = !settings_.no_time;
  for (const double time : survey_.times)
    content.panel = content.panel.cwiseMax(
        turned_size(view_.region, angle(view_.flat<D>(run_.gravity<D>().at(time)))));
  content.legend = [this](double scale, const Vec2& panel, double width) {
    return legend(scale, panel, width, gravity_);
  };
  page_ = lay_out(content, settings_.width, settings_.em, settings_.is_film);
}

template <int D>
std::string Picture<D>::slab_text() const
{
  if (D == 2) return "";
  if (!view_.slab) return fmt::format("all along {}", view_.depth());
  return fmt::format("{} = {}", view_.depth(), lengths_text(*view_.slab));
}

template <int D>
std::vector<LegendItem> Picture<D>::legend(double scale, const Vec2& panel, double width,
                                           const Vec2& gravity) const
{
  // This surface only measures letters.
  const CairoSurface surface(cairo_image_surface_create(CAIRO_FORMAT_RGB24, 1, 1));
  const Canvas canvas(surface.get(), settings_.em);
  const auto& ink = theme_.ink;
  std::vector<LegendItem> items;
  if (!settings_.no_scale) {
    items.push_back(scale_bar(canvas, scale, std::min(panel.x() / 4, 12 * settings_.em), ink));
    if (shows_gravity_) {
      const Projection turn(view_.region, Vec2::Zero(), 1, angle(gravity));
      items.push_back(gravity_arrow(canvas, turn.direction(gravity).normalized(), ink));
    }
    if (const auto text = slab_text(); !text.empty()) items.push_back(remark(canvas, text, ink));
  }
  if (settings_.no_bar) return items;
  if (field_) {
    items.push_back(
        colour_bar(canvas, *style_.grains.scale, field_->title(), width - 2 * settings_.em, ink));
  } else {
    const auto add = [&](const std::string& name, const Colour& grain, std::optional<Colour> line) {
      items.push_back(species_key(canvas, name, grain, line, ink));
    };
    for (std::size_t k = 0; k < grains_.species.size(); ++k)
      add(grains_.species[k].name, style_.grains.of_species[k],
          settings_.split_lines ? std::optional(style_.lines->of_species[k]) : std::nullopt);
    const auto& fixed = grains_.grains.fixed;
    if (std::any_of(fixed.begin(), fixed.end(), [](auto each) { return each != 0; }))
      add(name_of_boundary, style_.grains.boundary, std::nullopt);
  }
  if (style_.lines && strong_force_ > 0) {
    const std::string title = settings_.split_lines
                                  ? fmt::format("normal force (rule: {})", settings_.rule.name())
                                  : "normal force";
    items.push_back(
        force_key(canvas, strong_force_, scale * style_.lines->width_per_newton, title, ink));
  }
  return items;
}

template <int D>
Drawing Picture<D>::draw(const Frame<D>& frame) const
{
  const auto values = field_ ? field_->values(frame) : std::vector<double>{};
  auto drawing = draw_frame<D>(grains_.grains, frame, values, survey_.walls, view_, style_);
  drawing.gravity = view_.flat<D>(run_.gravity<D>().at(frame.time));
  return drawing;
}

template <int D>
void Picture<D>::refuse_as_empty() const
{
  std::vector<std::string> selection, extent;
  if (view_.slab) selection.push_back("the slice " + slab_text());
  if (!settings_.region.empty())
    selection.push_back(fmt::format("--region '{}'", settings_.region));
  if (selection.empty()) return;
  for (Eigen::Index axis = 0; axis < D; ++axis)
    extent.push_back(
        fmt::format("{} = {}", "xyz"[axis], lengths_text({survey_.low[axis], survey_.high[axis]})));
  throw UsageError(fmt::format("no grain is in {}: the grains lie at {}{}",
                               fmt::join(selection, " of "), fmt::join(extent, ", "),
                               view_.slab ? "; choose another --slice, or use --project" : ""));
}

template <int D>
void Picture<D>::paint(cairo_surface_t* surface, std::span<const Drawing> drawings) const
{
  Canvas canvas(surface, settings_.em, settings_.is_film);
  canvas.fill_all(theme_.background);
  for (std::size_t k = 0; k < drawings.size(); ++k) {
    const auto& drawing = drawings[k];
    const Projection to_page(view_.region, page_.panels[k] + page_.panel_size / 2, page_.scale,
                             angle(drawing.gravity));
    paint_panel(canvas, drawing, view_, to_page, theme_, D == 3);
    if (!settings_.no_time)
      // Adding 0.0 turns -0 into 0.
      canvas.text(
          page_.panels[k] - Vec2(0, 0.6 * settings_.em),
          fmt::format("t = {:.{}f} s", std::round(drawing.time * 1e6) / 1e6 + 0.0, decimals_),
          theme_.ink);
  }
  const auto items =
      legend(page_.scale, page_.panel_size, page_.size.x(), drawings.front().gravity);
  for (std::size_t k = 0; k < items.size(); ++k) items[k].paint(canvas, page_.items[k]);
}

template class Picture<2>;
template class Picture<3>;

}  // namespace grseg
