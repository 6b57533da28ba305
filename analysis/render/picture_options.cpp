// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/render/picture_options.hpp"

#include "formats/cli/words.hpp"
#include "formats/core/errors.hpp"
#include "formats/core/length.hpp"
#include "formats/core/text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <utility>

namespace grseg {
namespace {

Range parse_range(const std::string& text)
{
  const auto colon = text.find(':');
  if (colon != std::string::npos) {
    const auto low = parse_number(text.substr(0, colon)),
               high = parse_number(text.substr(colon + 1));
    if (low && high && std::isfinite(*low) && std::isfinite(*high) && *low < *high)
      return {*low, *high};
  }
  throw UsageError(fmt::format(
      "--range '{}': write the values of the first and the last colour, as in 0:0.5", text));
}

/// Number of the frame at `word`: "start", "end" or a time in s.
std::size_t frame_at(const TrajectoryReader& run, const std::string& word)
{
  if (word == "start") return 0;
  if (word == "end") return run.size() - 1;
  if (const auto time = parse_number(word)) return frame_nearest(run, *time, "--at " + word);
  throw UsageError(fmt::format("--at '{}': write a time in s, start or end", word));
}

}  // namespace

void PictureOptions::add_to(po::options_description& options)
{
  auto add = options.add_options();
  const auto text = [](std::string& place, const char* name) {
    auto* value = po::value(&place)->value_name(name);
    return place.empty() ? value : value->default_value(place);
  };
  add("at", po::value(&at)->composing()->value_name("TIME,..."),
      "time of the picture: seconds, start or end; several times give one panel each (default: end)");
  add("color", word_option(&color, words_of_fields()), list_of_fields().c_str());
  add("range", text(range, "a:b"),
      "values of the first and the last colour (default: round numbers; 1 % of the values may lie "
      "beyond)");
  add("forces", po::bool_switch(&plain.forces),
      "draw contacts as lines between the grains' centres, as wide as their normal force");
  add("force-width", text(force_width, "LENGTH"),
      "line width of a strong contact: 99 % of the contacts, in up to 16 of the frames, have "
      "thinner lines");
  add("partition", word_option(&partition, words_of_rule()),
      ("partition rule: with --forces, lines have the colours of the species, and the rule splits the "
       "lines of mixed contacts; with --color pressure, the rule shares mixed contacts; " +
       list_of_rules() + " (default for pressure: size)")
          .c_str());
  add("region", text(plain.region, "x0:x1,y0:y1"),
      "part of the run to show, in lengths such as 10dS; beyond a period the cell is repeated "
      "(default: all)");
  add("plane", word_option(&plane, words_of(planes)),
      ("in three dimensions: the axis that points right and the axis that points up, " +
       list_of(planes))
          .c_str());
  add("slice", text(plain.slice, "z0:z1"),
      "in three dimensions: show only grains whose centres lie in this range of the third axis "
      "(default: as thick as the largest grain, in the middle)");
  add("project", po::bool_switch(&plain.project),
      "in three dimensions: show all grains, the nearest in front");
  add("tilt", po::bool_switch(&plain.tilt),
      "turn the picture so that gravity points down the page (default: x points to the right)");
  add("theme", word_option(&theme, words_of(themes)), list_of(themes).c_str());
  add("width", text(width, "N"),
      "width in pixels; or on paper, e.g. 86mm, 8.6cm or 3.4in, with letters of 8 points (default: 1280 "
      "pixels, or less so that the height is at most 1280 pixels)");
  add("no-time", po::bool_switch(&plain.no_time), "leave out the time");
  add("no-scale", po::bool_switch(&plain.no_scale),
      "leave out the scale bar, the direction of gravity and the slice");
  add("no-bar", po::bool_switch(&plain.no_bar), "leave out the legend of colours and line widths");
}

PictureSettings PictureOptions::settings(const TrajectoryReader& run) const
{
  const LengthUnits units{run.small_diameter(), run.large_diameter()};
  auto s = plain;
  s.field = parse_field(color);
  if (!range.empty()) {
    if (s.field.is_species())
      throw UsageError("--range: species have no range; choose a field with --color");
    s.range = parse_range(range);
  }
  if (s.forces) s.line_width = parse_length(force_width, "--force-width", units);
  if (s.forces && !(s.line_width > 0)) throw UsageError("--force-width must be positive");
  if (!partition.empty()) {
    s.rule = parse_rule(partition);
    const bool of_pressure = s.field.definition && s.field.definition->kind == FieldKind::pressure;
    if (!s.forces && !of_pressure)
      throw UsageError("--partition needs --forces, whose lines it splits, or --color pressure");
    s.split_lines = s.forces;
  }
  s.plane = choose(plane, "--plane", planes);
  if (s.project && !s.slice.empty()) throw UsageError("--project and --slice exclude each other");
  s.theme = choose(theme, "--theme", themes);
  const auto page = parse_width(width);
  s.width = page.pixels;
  s.em = page.em;
  return s;
}

std::vector<std::size_t> PictureOptions::frames_at(const TrajectoryReader& run) const
{
  if (run.size() == 0) throw RunError(fmt::format("{}: the run has no frames", run.path()));
  std::vector<std::size_t> frames;
  for (const auto& list : at) {
    std::istringstream words(list);
    for (std::string word; std::getline(words, word, ',');) frames.push_back(frame_at(run, word));
  }
  if (frames.empty()) frames.push_back(run.size() - 1);
  if (frames.size() > 100)
    throw UsageError(fmt::format("--at: {} panels; at most 100 fit", frames.size()));
  return frames;
}

std::string PictureOptions::other_times(const TrajectoryReader& run) const
{
  const auto& times = run.times();
  const double tolerance =
      0.01 * (times.back() - times.front()) / static_cast<double>(times.size());
  std::string text;
  for (const auto& list : at) {
    std::istringstream words(list);
    for (std::string word; std::getline(words, word, ',');) {
      const auto asked = parse_number(word);
      const double shown = times[frame_at(run, word)];
      if (asked && std::abs(shown - *asked) > tolerance)
        text += fmt::format("{}{:.6g} s for --at {}", text.empty() ? "" : ", ", shown, word);
    }
  }
  return text;
}

PageWidth parse_width(const std::string& text)
{
  constexpr double per_inch = 300, letters = 8, points_of_inch = 72, least = 64, most = 20000;
  constexpr double points_of_pixel = 0.75;  // as browsers have it
  if (text.empty()) return {std::nullopt, usual_em(usual_page), points_of_pixel};
  constexpr std::pair<const char*, double> units[] = {
      {"mm", 1 / 25.4}, {"cm", 1 / 2.54}, {"in", 1}, {"", 0}};
  for (const auto& [name, inches] : units) {
    if (!text.ends_with(name)) continue;
    const auto number = parse_number(text.substr(0, text.size() - std::string(name).size()));
    if (!number) continue;
    const double pixels = std::round(inches > 0 ? *number * inches * per_inch : *number);
    if (!(pixels >= least && pixels <= most))
      throw UsageError(fmt::format("--width {}: that is {:g} pixels; choose {:g} to {:g}", text,
                                   pixels, least, most));
    if (inches > 0) return {pixels, letters * per_inch / points_of_inch, points_of_inch / per_inch};
    return {pixels, usual_em(pixels), points_of_pixel};
  }
  throw UsageError(fmt::format(
      "--width '{}': write a number of pixels, or a width on paper as 86mm, 8.6cm or 3.4in", text));
}

}  // namespace grseg
