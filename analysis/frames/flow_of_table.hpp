// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/cli/table.hpp"

#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

/// The flow of a table, and the difference of two. Runs of one flow agree in all recorded settings
/// except the seed.
namespace grseg {

/// Largest difference between the overall compositions of two runs of one flow. Seeds change the
/// composition by about 0.001, because radii are drawn at random; cells of a few hundred grains
/// may also have one large grain more or less.
inline constexpr double composition_tolerance = 0.02;

/// Largest difference between the nominal diameters of two runs of one flow, relative to the larger
/// diameter. For imported runs the nominal diameter is measured: the mean of the smallest and the
/// largest grain of a species. For n grains spread evenly over +-10 % it scatters by 0.14/n.
inline constexpr double diameter_tolerance = 0.01;

/// A header line of a table that tells flows apart: its key, unit and meaning, and the largest
/// relative difference that still counts as one flow.
struct FlowLine {
  const char *key, *unit, *what;
  double tolerance = 1e-6;
};
std::span<const FlowLine> flow_lines();
/// True if both tables have the same value in this line, or if neither has the line.
bool agree(const Table& one, const Table& other, const FlowLine& line);

/// Keys and values of a table's line "# scene: KEY = VALUE; ..." that matter for its flow; empty if
/// the table has no such line. The slope at t = 0 counts where gravity turns, and so has no value.
std::map<std::string, std::string> scene_of(const Table& table);
/// "[m]", "[degree/s]", or "" for the numbers of a scene key.
std::string unit_of_key(std::string_view key);
/// Keys that both tables' scenes state, with different values.
std::vector<std::string> scene_differences(const Table& one, const Table& other);

/// Share of each species in the grains' area, volume or mass, over all layers and windows of a
/// table, weighted by frames.
std::vector<double> composition_of(const Table& table);
bool same_composition(const std::vector<double>& a, const std::vector<double>& b);
/// Composition in words: "Phi_L = 0.30", or "Phi = 0.20/0.30/0.50" for three species.
std::string composition_words(const std::vector<double>& composition);

/// Which differences between flows require_one_flow() refuses.
enum class FlowsApart {
  by_any,       ///< all
  by_settings,  ///< all but different compositions
};
/// Throws UsageError, with the first difference, if two of the tables are of different flows. Tables
/// of one run (`run`: its number, for each table) may differ in composition, since grains may leave.
void require_one_flow(const std::vector<Table>& tables, const std::vector<std::size_t>& run,
                      FlowsApart apart);

}  // namespace grseg
