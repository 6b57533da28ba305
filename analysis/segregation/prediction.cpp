// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/segregation/prediction.hpp"

#include "analysis/segregation/closure_points.hpp"
#include "analysis/segregation/transport.hpp"
#include "analysis/stress/contact_sums.hpp"
#include "formats/core/errors.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace grseg {
namespace {

constexpr std::size_t column_cells = 200;
constexpr std::size_t by_closure = 0;  // index in prediction_laws
constexpr const char* remedy = "a table of grseg-segregation has it";

/// Properties of a bed that laws use.
struct PredictedBed {
  double small_diameter, large_diameter;  // m
  double gravity, cosine;                 // g cos(slope), m/s^2; cos(slope)
  double solid, height;                   // solid fraction; height with it everywhere, m
  double diameter;                        // mean nominal diameter, m
  double shear_rate = 0;                  // 1/s

  double mean_diameter(double phi_large) const
  {
    return (1 - phi_large) * small_diameter + phi_large * large_diameter;
  }
};

/// S and D of Trewhela et al., whose A, B, C and E are a, b, c and e here.
TransportRates trewhela(const PredictedBed& bed, double height, double phi_large, bool intruder)
{
  constexpr double a = 0.108, b = 0.3744, c = 0.2712, e = 2.0957;
  const double excess = bed.large_diameter / bed.small_diameter - 1;
  const double d = bed.mean_diameter(phi_large);
  const double pressure = bed.solid * (bed.height - height) * bed.cosine;
  const double size = excess + (intruder ? 0 : e * phi_large * excess * excess);
  const double spread = bed.shear_rate * d * d;
  return {b * spread * size / (c * d + pressure), a * spread};
}

/// The laws in the order of prediction_laws.
std::array<TransportLaw, prediction_laws.size()> laws_of(const PredictedBed& bed,
                                                         const FluxCoefficients& fitted)
{
  const double d = bed.diameter;
  const TransportRates scaled{fitted.B_over_c * bed.gravity * bed.shear_rate * d / fitted.shear_d,
                              fitted.d_over_c * bed.shear_rate * d * d / fitted.shear_d2};
  // Noise may make a fitted d negative, which no bed can have.
  const auto uniform = [](TransportRates rates) {
    rates.D = std::max(rates.D, 0.0);
    return [=](double, double) { return rates; };
  };
  const auto by_place = [&](bool intruder) {
    return [=](double height, double phi) { return trewhela(bed, height, phi, intruder); };
  };
  return {uniform(scaled), by_place(false), by_place(true), uniform({})};
}

/// The windows of a table in order of time, with the layers that are not too loose, from the base
/// upward.
std::vector<PredictedWindow> windows_of(const Table& table, const RowFilter& filter)
{
  const auto keys = read_layer_keys(table, remedy);
  const auto contents = content_columns(species_of(table), dimension_of(table));
  const auto small = find_column(table, contents[0], remedy);
  const auto large = find_column(table, contents[1], remedy);
  std::vector<PredictedLayer> all;
  std::vector<LayerSolid> solids;
  for (std::size_t row = 0; row < keys.size(); ++row) {
    const auto& key = keys[row];
    if (std::isnan(key.bottom)) continue;
    const double part = non_negative_cell(table, row, large);
    const double content = part + non_negative_cell(table, row, small);
    all.push_back({key, content, content > 0 ? part / content : 0});
    solids.push_back({key, content / key.volume});
  }
  const LengthUnits units{table.header_positive("small_diameter"),
                          table.header_positive("large_diameter")};
  auto whole_bed = filter;
  whole_bed.heights = "all";
  const auto range = whole_bed.range(units, solids);
  std::map<Span, std::vector<PredictedLayer>> by_time;
  for (const auto& layer : all)
    if (layer.content > 0 && range.holds_window(layer.key) &&
        layer.content / layer.key.volume >= range.least_solid)
      by_time[{layer.key.begin, layer.key.end}].push_back(layer);
  std::vector<PredictedWindow> windows;
  for (auto& [span, layers] : by_time) {
    std::ranges::sort(layers, {}, [](const auto& layer) { return layer.key.bottom; });
    windows.push_back({span, std::move(layers)});
  }
  return windows;
}

double content_of(const PredictedWindow& window)
{
  double content = 0;
  for (const auto& layer : window.layers) content += layer.content;
  return content;
}

/// Mean over the part from `low` to `high` of a line that is divided at `edges`, of values that are
/// constant between them. Edges ascend; low < high.
double mean_between(double low, double high, const std::vector<double>& edges,
                    const std::vector<double>& values)
{
  double sum = 0;
  for (std::size_t k = 0; k < values.size(); ++k)
    sum += values[k] * std::max(0.0, std::min(high, edges[k + 1]) - std::max(low, edges[k]));
  return sum / (high - low);
}

/// Edges of the layers of a window as shares of all its grains.
std::vector<double> shares_below(const PredictedWindow& window)
{
  std::vector<double> shares{0};
  const double all = content_of(window);
  for (const auto& layer : window.layers) shares.push_back(shares.back() + layer.content / all);
  return shares;
}

std::vector<double> equal_shares()
{
  std::vector<double> shares(column_cells + 1);
  for (std::size_t k = 0; k <= column_cells; ++k) shares[k] = static_cast<double>(k) / column_cells;
  return shares;
}

std::vector<double> cells_of(const PredictedWindow& window)
{
  const auto shares = shares_below(window), cells = equal_shares();
  std::vector<double> measured, phi;
  for (const auto& layer : window.layers) measured.push_back(layer.phi_large);
  for (std::size_t k = 0; k < column_cells; ++k)
    phi.push_back(mean_between(cells[k], cells[k + 1], shares, measured));
  return phi;
}

PredictedBed bed_of(const Table& table, const PredictedWindow& first, double solid)
{
  const auto component = [&](const char* key) {
    return table.has_header(key) ? table.header_number(key) : 0.0;
  };
  const double y = component("gravity_y");
  const double g = std::hypot(component("gravity_x"), y, component("gravity_z"));
  const auto& lowest = first.layers.front().key;
  const double base = lowest.volume / (lowest.top - lowest.bottom);
  double large = 0;
  for (const auto& layer : first.layers) large += layer.content * layer.phi_large;
  PredictedBed bed{table.header_positive("small_diameter"),
                   table.header_positive("large_diameter"),
                   -y,
                   g > 0 ? -y / g : 0,
                   solid,
                   content_of(first) / (base * solid),
                   0};
  bed.diameter = bed.mean_diameter(large / content_of(first));
  return bed;
}

double solid_of(const PredictedWindow& window)
{
  std::vector<LayerSolid> layers;
  for (const auto& [key, content, phi, predicted] : window.layers)
    layers.push_back({key, content / key.volume});
  return median_solid(layers);
}

/// Mean height of the large grains, m, if their share of each layer is of(layer).
template <class Of>
double mean_height(const PredictedWindow& window, const Of& of)
{
  double weight = 0, sum = 0;
  for (const auto& layer : window.layers) {
    weight += layer.content * of(layer);
    sum += layer.content * of(layer) * (layer.key.bottom + layer.key.top) / 2;
  }
  return sum / weight;
}

double measured_height(const PredictedWindow& window)
{
  return mean_height(window, [](const PredictedLayer& layer) { return layer.phi_large; });
}

double predicted_height(const PredictedWindow& window, std::size_t law)
{
  return mean_height(window, [law](const PredictedLayer& layer) { return layer.predicted[law]; });
}

void add_law(NamedNumbers& numbers, const Prediction& run, std::size_t law,
             const FromFlux& from_flux)
{
  double weight = 0, squares = 0, of_heights = 0;
  for (std::size_t k = 1; k < run.windows.size(); ++k) {
    const auto& window = run.windows[k];
    for (const auto& layer : window.layers) {
      weight += layer.content;
      squares += layer.content * std::pow(layer.predicted[law] - layer.phi_large, 2);
    }
    of_heights += std::pow(predicted_height(window, law) - measured_height(window), 2);
  }
  const auto add = [&](const char* name, const char* unit, const Estimate& estimate) {
    numbers.numbers.emplace_back(
        fmt::format("{}_of_{}@{}{}", name, prediction_laws[law], run.name, unit), estimate);
  };
  add("rms_phi_L", "", {std::sqrt(squares / weight)});
  add("rms_y_L", "[m]", {std::sqrt(of_heights / static_cast<double>(run.windows.size() - 1))});
  const double last = predicted_height(run.windows.back(), law);
  add("y_L_last", "[m]", law == by_closure ? from_flux(last, run.slopes) : Estimate{last});
}

/// Shear rates of the bed in the windows, 1/s.
std::vector<double> shear_rates_in(const Table& table, const std::vector<PredictedWindow>& windows)
{
  const auto known = shear_rates_of(table);
  std::vector<double> rates;
  for (const auto& [span, layers] : windows) {
    const auto found = known.find(span);
    if (found == known.end() || !std::isfinite(found->second))
      throw FormatError(fmt::format(
          "{}: no shear rate of the bed from {:g} to {:g} s, which is in the row without y0 and y1; "
          "make the table again with grseg-segregation",
          table.name, span.first, span.second));
    rates.push_back(found->second);
  }
  return rates;
}

/// Throws RunError if the fit has no numbers to predict with.
void check(const FluxCoefficients& fitted)
{
  if (!std::isfinite(fitted.B_over_c + fitted.d_over_c))
    throw RunError(
        "the fit gives no B/c and d/c to predict with; give runs of other stages of "
        "segregation to the fit");
  if (!(fitted.shear_d > 0 && fitted.shear_d2 > 0))
    throw RunError(
        "the tables of grseg-segregation of the fit have no shear rate of the bed, which "
        "a prediction needs; make them again with this version");
}

/// Predicts phi_L of all windows by one law, with a shear rate, 1/s, for each window.
void advance(std::vector<PredictedWindow>& windows, std::size_t law, PredictedBed bed,
             const std::vector<double>& shear_rates, const FluxCoefficients& fitted)
{
  const auto middle = [](const Span& span) { return (span.first + span.second) / 2; };
  const auto cells = equal_shares();
  TransportColumn column(cells_of(windows.front()), bed.height);
  for (std::size_t n = 0; n < windows.size(); ++n) {
    auto& window = windows[n];
    const std::size_t last = n > 0 ? n - 1 : 0;
    bed.shear_rate = (shear_rates[last] + shear_rates[n]) / 2;
    column.advance(middle(window.span) - middle(windows[last].span), laws_of(bed, fitted)[law]);
    const auto shares = shares_below(window);
    for (std::size_t k = 0; k < window.layers.size(); ++k)
      window.layers[k].predicted[law] =
          mean_between(shares[k], shares[k + 1], cells, column.phi_large());
  }
}

/// Prediction::slopes, from differences.
std::array<double, 2> slopes_of(std::vector<PredictedWindow> windows, const PredictedBed& bed,
                                const std::vector<double>& shear_rates,
                                const FluxCoefficients& fitted)
{
  constexpr double part = 1e-3;  // of a coefficient
  const auto slope = [&](double FluxCoefficients::*coefficient) {
    const double difference = part * fitted.*coefficient;
    std::array<double, 2> last{};
    for (const std::size_t side : {0, 1}) {
      auto changed = fitted;
      changed.*coefficient += (side == 1 ? difference : -difference);
      advance(windows, by_closure, bed, shear_rates, changed);
      last[side] = predicted_height(windows.back(), by_closure);
    }
    return difference == 0 ? 0 : (last[1] - last[0]) / (2 * difference);
  };
  return {slope(&FluxCoefficients::B_over_c), slope(&FluxCoefficients::d_over_c)};
}

}  // namespace

Prediction predict(const Table& table, const FluxCoefficients& fitted, const RowFilter& filter)
{
  require_one_density(table);
  check(fitted);
  Prediction prediction{table.name, windows_of(table, filter), {}};
  auto& windows = prediction.windows;
  if (windows.size() < 2)
    throw RunError(
        fmt::format("{}: {} windows are left to predict, and two are needed, the first to "
                    "begin with; choose other --begin, --end or --min-solid",
                    table.name, windows.size()));
  const auto shear_rates = shear_rates_in(table, windows);
  const auto bed = bed_of(table, windows.front(), solid_of(windows.front()));
  for (std::size_t law = 0; law < prediction_laws.size(); ++law)
    advance(windows, law, bed, shear_rates, fitted);
  prediction.slopes = slopes_of(windows, bed, shear_rates, fitted);
  return prediction;
}

void refuse_fitted_runs(const std::vector<Table>& predicted, const std::vector<Table>& fitted)
{
  auto tables = predicted;
  for (const auto& table : fitted)
    if (table.has_column("q_L")) tables.push_back(table);
  const auto run = find_runs(tables).run;
  for (std::size_t k = 0; k < predicted.size(); ++k)
    for (std::size_t other = predicted.size(); other < tables.size(); ++other)
      if (run[k] == run[other])
        throw UsageError(fmt::format(
            "{}: it is of the same run as {}, from which the coefficients come; predict runs that "
            "are not among the tables of the fit",
            tables[k].name, tables[other].name));
}

void add_predictions(NamedNumbers& numbers, const std::vector<Prediction>& predictions,
                     const FromFlux& from_flux)
{
  for (const auto& run : predictions) {
    numbers.numbers.emplace_back(fmt::format("y_L_first@{}[m]", run.name),
                                 Estimate{measured_height(run.windows.front())});
    numbers.numbers.emplace_back(fmt::format("y_L_last@{}[m]", run.name),
                                 Estimate{measured_height(run.windows.back())});
    for (std::size_t law = 0; law < prediction_laws.size(); ++law)
      add_law(numbers, run, law, from_flux);
  }
}

Table prediction_table(const std::vector<Prediction>& predictions)
{
  Table table;
  table.columns = {"run", "t0[s]", "t1[s]", "y0[m]", "y1[m]", "solid", "phi_L"};
  for (const auto* law : prediction_laws) table.columns.push_back(fmt::format("phi_L_{}", law));
  for (std::size_t run = 0; run < predictions.size(); ++run)
    for (const auto& window : predictions[run].windows)
      for (const auto& layer : window.layers) {
        auto& row = table.rows.emplace_back();
        const auto& [key, content, phi, predicted] = layer;
        row = {static_cast<double>(run + 1), key.begin, key.end, key.bottom, key.top,
               content / key.volume,         phi};
        row.insert(row.end(), predicted.begin(), predicted.end());
      }
  return table;
}

}  // namespace grseg
