// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/frames/layer_key.hpp"

#include "analysis/frames/sums.hpp"
#include "formats/cli/words.hpp"
#include "formats/core/errors.hpp"

#include <fmt/format.h>
#include <gsl/gsl_statistics.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>
#include <utility>

namespace grseg {

bool HeightRange::holds(double bottom, double top) const
{
  const double slack = 1e-9 * (top - bottom);
  return !(bottom < lowest - slack || top > highest + slack);
}

namespace {

HeightRange between(const std::string& text, LengthUnits units)
{
  HeightRange range;
  const auto colon = text.find(':');
  if (colon == std::string::npos)
    throw UsageError(
        fmt::format("--heights {}: write inside, all, or low:high, e.g. 4dS:56dS or 4dS:", text));
  const auto low = text.substr(0, colon), high = text.substr(colon + 1);
  if (!low.empty()) range.lowest = parse_length(low, "--heights", units);
  if (!high.empty()) range.highest = parse_length(high, "--heights", units);
  return range;
}

HeightRange inside_of(const std::vector<LayerSolid>& layers, double small_diameter)
{
  const double median = median_solid(layers);
  double base = std::numeric_limits<double>::infinity(), height = 0;
  for (const auto& mean : mean_layers(layers)) {
    const double filled = mean.solid / median;
    if (filled >= 0.5) base = std::min(base, mean.key.bottom);
    height += filled * (mean.key.top - mean.key.bottom);
  }
  return {base + margin_inside * small_diameter, base + height - margin_inside * small_diameter};
}

}  // namespace

double median_solid(const std::vector<LayerSolid>& layers)
{
  std::vector<double> solid;
  for (const auto& layer : layers)
    if (layer.solid > 0) solid.push_back(layer.solid);
  return solid.empty() ? 0 : gsl_stats_median(solid.data(), 1, solid.size());
}

std::vector<LayerSolid> mean_layers(const std::vector<LayerSolid>& layers)
{
  std::map<double, LayerSolid> means;  // by the layer's bottom, m
  for (const auto& layer : layers) {
    const auto& key = layer.key;
    if (!(key.frames > 0)) continue;
    auto& mean = means.try_emplace(key.bottom, LayerSolid{{.bottom = key.bottom, .top = key.top}})
                     .first->second;
    mean.key.frames += key.frames;
    mean.solid += key.frames * layer.solid;
  }
  return listed(means, [](const auto& entry) {
    auto mean = entry.second;
    mean.solid /= mean.key.frames;
    return mean;
  });
}

std::string heights_in_words(const std::string& text, bool annuli)
{
  if (text != inside_the_bed) return text;
  return fmt::format(
      "inside: without {:g} d_S at the {}", margin_inside,
      annuli ? "wall and, off the axis, at the surface" : "base and under the surface");
}

void check_heights(const std::string& text)
{
  if (text != inside_the_bed && text != "all") between(text, {1, 1});
}

HeightRange parse_heights(const std::string& text, LengthUnits units,
                          const std::vector<LayerSolid>& layers)
{
  if (text == "all") return {};
  return text == inside_the_bed ? inside_of(layers, units.small_diameter) : between(text, units);
}

std::string KeyColumn::name_with_unit(int dimension) const
{
  return std::string(name) + (value == &LayerKey::volume ? unit_of_volume(dimension) : unit);
}

const char* unit_of_volume(int dimension)
{
  return dimension == 3 ? "[m^3]" : "[m^2]";
}

std::vector<std::string> with_key_columns(int dimension, const std::vector<std::string>& more)
{
  auto names = listed(key_columns,
                      [&](const KeyColumn& column) { return column.name_with_unit(dimension); });
  return add_all(names, more);
}

std::vector<double> with_key(const LayerKey& key, const std::vector<double>& more)
{
  auto row = listed(key_columns, [&](const KeyColumn& column) { return key.*column.value; });
  return add_all(row, more);
}

bool RowRange::holds_window(const LayerKey& key) const
{
  const double slack = 1e-9 * (1 + std::abs(key.begin) + std::abs(key.end));
  return !(key.begin < begin - slack) && !(key.end > end + slack);
}

void RowFilter::add_times_to(po::options_description& options)
{
  options.add_options()("begin", po::value(&begin)->value_name("s"),
                        "leave out windows that begin before this time");
  options.add_options()("end", po::value(&end)->value_name("s"),
                        "leave out windows that end after this time");
}

void RowFilter::add_layers_to(po::options_description& options, const std::string& when)
{
  options.add_options()("heights",
                        po::value(&heights)->value_name("y0:y1")->default_value(inside_the_bed),
                        fmt::format("{}layers to use: {}", when, heights_help).c_str());
  options.add_options()(
      "min-solid", po::value(&min_solid)->default_value(0.5, "0.5")->value_name("X"),
      (when + "leave out layers with a solid fraction below X times the median of layers").c_str());
}

void RowFilter::check() const
{
  if (std::isnan(begin) || std::isnan(end))
    throw UsageError("--begin and --end must be times in seconds");
  if (!(min_solid >= 0)) throw UsageError("--min-solid must not be negative");
  check_heights(heights);
}

Header RowFilter::lines() const
{
  return {{"heights", heights_in_words(heights)}, {"min_solid", format_number(min_solid)}};
}

std::vector<LayerSolid> RowFilter::in_times(std::vector<LayerSolid> layers) const
{
  std::erase_if(layers, [this](const LayerSolid& layer) { return !holds_window(layer.key); });
  return layers;
}

RowRange RowFilter::range(LengthUnits units, const std::vector<LayerSolid>& layers) const
{
  const auto bed = in_times(layers);
  return {begin, end, parse_heights(heights, units, bed), min_solid * median_solid(bed)};
}

namespace {

[[noreturn]] void refuse_row(const Table& table, std::size_t row, const std::string& why)
{
  throw FormatError(fmt::format("{}: row {}: {}", table.name, row + 1, why));
}

void require_positive_header(const Table& table)
{
  for (const char* key : {"small_diameter", "large_diameter", "step", "layer", "window"})
    if (table.has_header(key)) table.header_positive(key);
}

void require_sense(const Table& table, std::size_t row, const LayerKey& key)
{
  const bool bed = std::isnan(key.bottom) && std::isnan(key.top);
  if (!(key.begin < key.end))
    refuse_row(table, row, fmt::format("a window from {:g} to {:g} s", key.begin, key.end));
  const auto require_edges = [&](const char* what, double low, double high) {
    if (!(low < high && std::isfinite(high - low)))
      refuse_row(table, row, fmt::format("a {} from {:g} to {:g} m", what, low, high));
  };
  const bool cell = plane_of(table).has_value();
  if (!bed) require_edges(cell ? "cell" : "layer", key.bottom, key.top);
  if (cell) require_edges("cell", key.left, key.right);
  if (!(key.frames > 0) || key.frames != std::floor(key.frames))
    refuse_row(table, row, fmt::format("{} frames", format_number(key.frames)));
  if (bed ? key.volume < 0 : !(key.volume > 0))
    refuse_row(
        table, row,
        fmt::format("a volume V of {} m^{}", format_number(key.volume), dimension_of(table)));
}

/// An interval of time (s) or height (m), and the row that contains it.
struct Piece {
  double begin, end;
  std::size_t row;
};

/// Throws FormatError if two intervals overlap by more than round-off.
void refuse_overlaps(const Table& table, std::vector<Piece> pieces, const char* what)
{
  std::ranges::sort(pieces, [](const Piece& a, const Piece& b) {
    return std::pair(a.begin, a.end) < std::pair(b.begin, b.end);
  });
  for (std::size_t k = 1; k < pieces.size(); ++k) {
    const auto &a = pieces[k - 1], &b = pieces[k];
    constexpr double round_off = 1e-6;  // relative to the lengths: tables may have few digits
    if (b.begin < a.end - round_off * std::min(a.end - a.begin, b.end - b.begin))
      throw FormatError(fmt::format("{}: the {} of rows {} and {} overlap", table.name, what,
                                    std::min(a.row, b.row) + 1, std::max(a.row, b.row) + 1));
  }
}

using Span = std::pair<double, double>;

void refuse_overlapping_rows(const Table& table, const std::vector<LayerKey>& keys)
{
  using Column = std::map<Span, std::size_t>;         // rows by layer
  std::map<Span, std::map<Span, Column>> columns_of;  // by window, then by edges along x
  std::map<Span, std::size_t> bed_of;                 // row of the whole bed, by window
  std::vector<Piece> windows;
  const std::string layer = plane_of(table) ? "cell" : "layer";
  for (std::size_t row = 0; row < keys.size(); ++row) {
    const auto& key = keys[row];
    const Span window(key.begin, key.end);
    if (!columns_of.contains(window)) windows.push_back({key.begin, key.end, row});
    auto& layers = columns_of[window][{key.left, key.right}];
    const auto [place, is_new] = std::isnan(key.bottom)
                                     ? bed_of.emplace(window, row)
                                     : layers.emplace(Span(key.bottom, key.top), row);
    if (!is_new)
      throw FormatError(fmt::format("{}: row {} repeats the window and {} of row {}", table.name,
                                    row + 1, layer, place->second + 1));
  }
  refuse_overlaps(table, windows, "windows");
  for (const auto& [window, columns] : columns_of) {
    std::vector<Piece> beside;
    for (const auto& [edges, layers] : columns) {
      if (!layers.empty()) beside.push_back({edges.first, edges.second, layers.begin()->second});
      std::vector<Piece> pieces;
      for (const auto& [heights, row] : layers)
        pieces.push_back({heights.first, heights.second, row});
      refuse_overlaps(table, std::move(pieces), (layer + "s").c_str());
    }
    refuse_overlaps(table, std::move(beside), (layer + "s").c_str());
  }
}

}  // namespace

int dimension_of(const Table& table)
{
  const auto word = header_or(table, "dimension", "2");
  if (word == "2") return 2;
  if (word == "3") return 3;
  throw FormatError(fmt::format("{}: '# dimension: {}' should be 2 or 3", table.name, word));
}

SpeciesList species_of(const Table& table)
{
  if (!table.has_header("species"))
    return two_sizes(table.header_positive("small_diameter"),
                     table.header_positive("large_diameter"));
  if (auto list = parse_species(table.header_text("species")); !list.empty()) return list;
  throw FormatError(fmt::format(
      "{}: '# species: {}' should list names and diameters in order of size, as in SE 3e-06, AM "
      "1.2e-05",
      table.name, table.header_text("species")));
}

Header provenance_of(const std::vector<Table>& tables, const ToolInfo& info,
                     const std::string& preset, const std::string& command)
{
  Header header{program_line(info)};
  if (!info.presets.empty()) header.emplace_back("preset", preset);
  for (const auto& line : header_values(tables, "history")) header.emplace_back("history", line);
  header.emplace_back("history", command);
  for (const auto& input : header_values(tables, "input")) header.emplace_back("input", input);
  return add_all(header, trust_of(tables));
}

std::optional<MapPlane> plane_of(const Table& table)
{
  const auto bins = header_or(table, "bins", "");
  return find_choice(bins.substr(0, bins.find(' ')), map_planes);
}

bool has_annuli(const Table& table)
{
  return header_or(table, "bins", "").starts_with("radius");
}

void refuse_map(const Table& table)
{
  if (plane_of(table))
    throw FormatError(fmt::format(
        "{}: the table is a map (bins: {}) with rows of cells, not layers; make it without --bins",
        table.name, header_or(table, "bins", "")));
}

namespace {

/// A number of LayerKey and its column in a table.
struct KeyPlace {
  double LayerKey::*value;
  std::size_t column;
};

std::vector<KeyPlace> key_places(const Table& table, const std::string& remedy)
{
  const auto plane = plane_of(table);
  const std::string axes = plane ? word_of(*plane, map_planes) : "";
  std::vector<KeyPlace> places;
  const auto add = [&](const std::string& name, double LayerKey::*value) {
    places.push_back({value, find_column(table, name, remedy)});
  };
  for (const auto& column : key_columns) {
    auto name = column.name_with_unit(dimension_of(table));
    if (plane && name.front() == 'y') name.front() = axes[1];
    add(name, column.value);
  }
  if (!plane) return places;
  add(fmt::format("{}0[m]", axes[0]), &LayerKey::left);
  add(fmt::format("{}1[m]", axes[0]), &LayerKey::right);
  return places;
}

}  // namespace

std::vector<LayerKey> read_layer_keys(const Table& table, const std::string& remedy)
{
  refuse_map(table);
  return read_keys(table, remedy);
}

std::vector<LayerKey> read_keys(const Table& table, const std::string& remedy)
{
  const auto places = key_places(table, remedy);
  const bool map = plane_of(table).has_value();
  require_positive_header(table);

  std::vector<LayerKey> keys(table.rows.size());
  for (std::size_t row = 0; row < keys.size(); ++row) {
    for (const auto& [value, column] : places) {
      // Rows of the whole bed have NaN heights, and no volume if its top lies below y = 0.
      const bool may_be_nan =
          !map && (value == &LayerKey::bottom || value == &LayerKey::top ||
                   (value == &LayerKey::volume && std::isnan(keys[row].bottom)));
      keys[row].*value = may_be_nan ? table.rows[row][column] : finite_cell(table, row, column);
    }
    require_sense(table, row, keys[row]);
  }
  refuse_overlapping_rows(table, keys);
  return keys;
}

std::size_t find_column(const Table& table, const std::string& name, const std::string& remedy)
{
  const auto plain = without_unit(name);
  if (!table.has_column(plain))
    throw FormatError(fmt::format(
        "{}: {}no column '{}'; {}", table.name,
        table.made_by_hand() ? ""
                             : fmt::format("a table of {} has ", header_or(table, "program", "")),
        plain, remedy));
  const auto column = table.column(plain);
  const auto& found = table.columns[column];
  if (found != name && !(table.made_by_hand() && found == plain))
    throw FormatError(fmt::format("{}: column '{}' should be '{}'; units are not converted",
                                  table.name, found, name));
  return column;
}

std::optional<std::size_t> find_kept_column(const Table& table, const std::string& name,
                                            const std::string& remedy)
{
  const auto plain = without_unit(name);
  std::istringstream not_kept(header_or(table, "not kept", ""));
  for (std::string word; not_kept >> word;)
    if (word == plain && !table.has_column(plain)) return {};
  return find_column(table, name, remedy);
}

const std::string& with_unit(const std::string& name, const std::vector<std::string>& written)
{
  return *std::ranges::find(written, name, without_unit);
}

double finite_cell(const Table& table, std::size_t row, std::size_t column)
{
  const double value = table.rows[row][column];
  if (!std::isfinite(value))
    throw FormatError(fmt::format("{}: row {}, column {}: {} is not a finite number", table.name,
                                  row + 1, table.columns[column], format_number(value)));
  return value;
}

double non_negative_cell(const Table& table, std::size_t row, std::size_t column, double round_off)
{
  const double value = finite_cell(table, row, column);
  if (value < -round_off)
    throw FormatError(fmt::format("{}: row {}, column {}: {} should not be negative", table.name,
                                  row + 1, table.columns[column], format_number(value)));
  return value;
}

}  // namespace grseg
