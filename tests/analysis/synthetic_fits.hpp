// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/fit/fit_data.hpp"
#include "analysis/fit/fit_pairs.hpp"
#include "tests/analysis/synthetic_sums.hpp"

#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

/// Points and tables whose fits are known, and short names for what tests read from them.
namespace grseg::synthetic {

inline const std::vector<double> compositions{0.05, 0.2, 0.35, 0.5, 0.65, 0.8, 0.95};

/// Points y = k x^a in one window, of unequal weights.
inline std::vector<FitPoint> power_law(double k, double a)
{
  std::vector<FitPoint> points;
  for (const double phi : compositions) {
    FitPoint point{.phi_large = phi, .weight = 1 + 3 * phi, .size_ratio = 2};
    point.large = 1.7;
    point.small = 1.7 * k * std::pow(point.ratio(), a);
    point.total = point.small + point.large;
    points.push_back(point);
  }
  return points;
}

/// A pseudo-random number in [-1, 1].
inline double scatter(std::size_t k)
{
  const double any = 43758.5453 * std::sin(12.9898 * static_cast<double>(k + 1));
  return 2 * (any - std::floor(any)) - 1;
}

/// Rows of 30 windows of 7 layers: neutral contacts whose mixed part scatters by `noise`.
inline std::vector<TableRow> neutral_rows(double noise, double r = 2, int windows = 30)
{
  std::vector<TableRow> rows;
  for (int window = 0; window < windows; ++window)
    for (const double phi : compositions) {
      auto sums = neutral_sums(phi, r);
      const double factor = 1 + noise * scatter(rows.size());
      sums.of(OwnSum::inside, 1) *= factor;
      rows.push_back({1.25 * window, 1.25 * (window + 1), 25, sums});
    }
  return rows;
}

/// Table of a run with two windows and one layer of this composition.
inline Table run_of(double phi_large, const std::string& gravity = "3.83", double scatter = 0)
{
  auto table = stress_table({{0, 1, 10, neutral_sums(phi_large, 2 + scatter)},
                             {1, 2, 10, neutral_sums(phi_large, 2 - scatter / 2)}});
  table.header.emplace_back("gravity_x", gravity);
  table.header.emplace_back("gravity_y", "-9.02");
  return table;
}

inline std::vector<FitTable> read_all(const std::vector<Table>& tables)
{
  return read_fit_tables(tables, Quantity::contact, {{}});
}

inline FitData read(const std::vector<Table>& tables, const FitFilters& filters = {},
                    Quantity quantity = Quantity::contact)
{
  return select_fit_data(read_fit_tables(tables, quantity, {}), quantity, filters, {{0, 1}});
}

inline FitData neutral_data(double noise)
{
  return read({stress_table(neutral_rows(noise))});
}

inline RuleFit fit(const FitData& data, const std::string& rule, const FitSettings& settings = {})
{
  return fit_flows(data, parse_rule(rule), settings).all;
}

/// Message of the Error thrown while `tables` are read; "" if there is none.
template <class Error>
std::string sentence_of(const std::vector<Table>& tables, const FitFilters& filters = {},
                        Quantity quantity = Quantity::contact)
{
  try {
    read(tables, filters, quantity);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

inline bool holds(const std::string& text, const std::string& part)
{
  return text.find(part) != std::string::npos;
}

}  // namespace grseg::synthetic
