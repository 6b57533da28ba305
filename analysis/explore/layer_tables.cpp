// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/explore/layer_tables.hpp"

#include "analysis/balance/momentum_balance.hpp"
#include "analysis/balance/table.hpp"
#include "analysis/frames/composition.hpp"
#include "analysis/frames/ratio.hpp"
#include "analysis/maps/fields.hpp"
#include "analysis/micro/derived_quantities.hpp"
#include "analysis/micro/structure_by_layer.hpp"
#include "analysis/stress/kinetic_stress.hpp"
#include "analysis/stress/partial_contact_stress.hpp"
#include "formats/core/dimension.hpp"

#include <string>
#include <utility>
#include <vector>

namespace grseg {
namespace {

using Json = nlohmann::ordered_json;

/// All windows as one.
Window whole(const FrameLoop& loop)
{
  const auto windows = loop.windows();
  Window all{windows.front().begin, windows.back().end, {}};
  for (const auto& window : windows)
    all.frames.insert(all.frames.end(), window.frames.begin(), window.frames.end());
  return all;
}

/// A table by layer in the making.
class LayerTable {
 public:
  LayerTable(const char* name, const char* tool, const char* note, std::vector<std::string> shown)
      : table_{{"name", name},
               {"tool", tool},
               {"note", note},
               {"columns", Json::array()},
               {"shown", std::move(shown)},
               {"rows", Json::array()}}
  {
  }

  void add(const Layers& layers, std::size_t layer, const std::vector<Cell>& cells)
  {
    if (table_["columns"].empty()) {
      table_["columns"] = {"y0[m]", "y1[m]"};
      for (const auto& column : columns_of(cells)) table_["columns"].push_back(column);
    }
    Json row{layers.bottom(layer), layers.top(layer)};
    for (const double value : values_of(cells)) row.push_back(value);
    table_["rows"].push_back(std::move(row));
  }
  Json take() { return std::move(table_); }

 private:
  Json table_;
};

/// "sigma_S_yy[N/m]" for each species and component.
template <int D>
std::vector<Cell> partial_cells(const PartialStress<D>& stress, const SpeciesList& species)
{
  const char* unit = D == 3 ? "[Pa]" : "[N/m]";
  std::vector<Cell> cells;
  const auto words = column_words(species);
  for (std::size_t k = 0; k < words.size(); ++k)
    for (const auto& [suffix, row, column] : tensor_components(D))
      cells.push_back({"sigma_" + words[k] + suffix + unit, stress.of_species[k](row, column)});
  return cells;
}

template <int D>
Json stress_table(FrameLoop& loop, const Window& window)
{
  const auto& species = loop.species();
  const auto [composition, contacts] =
      loop.sum<D>(window, {.velocity = false, .contacts = true},
                  Composition<D>(loop.layers(), GrainArea::clipped, std::nullopt, species.size()),
                  PartialContactStress<D>(loop.layers(), Assignment::contact_point, std::nullopt,
                                          std::nullopt, species.size()));
  const char* unit = D == 3 ? "[Pa]" : "[N/m]";
  LayerTable table(
      "stress", "grseg-stress", "Contact stress; mixed contacts shared by size.",
      {"nu", "phi_L", std::string("sigma_yy") + unit, "stress_ratio",
       std::string("sigma_S_yy") + unit, std::string("sigma_L_yy") + unit, "mixed_share_yy"});
  for (std::size_t layer = 0; layer < contacts.layers(); ++layer) {
    auto sums = contacts.mean(layer).sums;
    sums.content = composition.mean(layer);
    sums.volume = loop.layers().volume(layer);
    const auto stress = partial_stress(sums, PartitionRule{});
    auto cells = stress_fields(sums, species, {PartitionRule{}});
    for (auto& cell : partial_cells(stress, species)) cells.push_back(std::move(cell));
    double mixed = 0;
    for (std::size_t pair = 0; pair < number_of_pairs(species.size()); ++pair)
      mixed += sums.of(PairSum::whole, pair)(1, 1) / sums.volume;
    cells.push_back({"mixed_share_yy", ratio(mixed, stress.total(1, 1))});
    table.add(loop.layers(), layer, cells);
  }
  return table.take();
}

template <int D>
Json kinetic_table(FrameLoop& loop, const Window& window)
{
  const TrajectoryReader::Fields moving{.velocity = true, .contacts = false};
  const auto& species = loop.species();
  const auto [mean] =
      loop.sum<D>(window, moving,
                  MeanVelocity<D>(loop.layers(), loop.run().small_diameter() / 2, species.size()));
  const auto [stress] = loop.sum<D>(
      window, moving, KineticStress<D>(loop.layers(), MeanFlow::profile, mean, species.size()));
  LayerTable table("kinetic", "grseg-kinetic",
                   "Mean flow, and granular temperatures about its profile.",
                   {"u[m/s]", "du_dy[1/s]", "T_S_x[m^2/s^2]", "T_S_y[m^2/s^2]", "T_L_x[m^2/s^2]",
                    "T_L_y[m^2/s^2]", "equipartition_y"});
  for (std::size_t layer = 0; layer < stress.layers(); ++layer)
    table.add(loop.layers(), layer, stress.cells(species, layer));
  return table.take();
}

template <int D>
RunConstants constants_of(const FrameLoop& loop)
{
  const auto& parameters = loop.run().parameters();
  const auto number = [&](const char* name) {
    return parameters.find_number(name).value_or(std::numeric_limits<double>::quiet_NaN());
  };
  const auto gravity = loop.run().gravity<D>();
  RunConstants constants{loop.species()[0].diameter, loop.species()[1].diameter,
                         gravity.start.x(),          gravity.start.y(),
                         number("density"),          number("friction")};
  if constexpr (D == 3) constants.gravity_z = gravity.start.z();
  return constants;
}

template <int D>
Json micro_table(FrameLoop& loop, const Window& window)
{
  const auto constants = constants_of<D>(loop);
  const auto [micro] =
      loop.sum<D>(window, {.velocity = false, .contacts = true},
                  StructureByLayer<D>(loop.layers(), GrainArea::clipped, constants.friction));
  LayerTable table("micro", "grseg-micro --derived",
                   "Contacts per grain, mean forces, friction and fabric.",
                   {"z_S", "z_L", "f_S[N]", "f_L[N]", "f_SS[N]", "f_LS[N]", "f_LL[N]",
                    "mixed_share", "neutral_share", "sliding_all"});
  for (std::size_t layer = 0; layer < micro.layers(); ++layer) {
    const SumsRow<D> row{window.begin,
                         window.end,
                         loop.layers().bottom(layer),
                         loop.layers().top(layer),
                         static_cast<double>(window.frames.size()),
                         loop.layers().volume(layer),
                         micro.mean(layer),
                         {},
                         micro.heights().bed};
    table.add(loop.layers(), layer, derived_quantities(row, constants, DerivedSettings{}));
  }
  return table.take();
}

template <int D>
Json balance_table(FrameLoop& loop, const Window& window)
{
  const auto& run = loop.run();
  const auto& species = loop.species();
  const Kernel kernel(KernelShape::gauss, run.small_diameter());
  const auto [balance] = loop.sum<D>(
      window, {.velocity = true, .contacts = true, .force = true},
      MomentumBalance<D>(loop.layers(), kernel, run.gravity<D>(), run.step(), species.size()));
  const std::string unit = D == 3 ? "[N/m^3]" : "[N/m^2]";
  LayerTable table(
      "balance", "grseg-balance",
      "Momentum balance of the large grains along y; mixed contacts cut at the contact point.",
      {"gravity_L_y" + unit, "contact_L_y" + unit, "interaction_L_y" + unit, "base_L_y" + unit,
       "kinetic_L_y" + unit, "push" + unit, "push_kinetic" + unit, "drag" + unit});
  const auto columns = balance_columns<D>(species);
  for (std::size_t layer = 0; layer < balance.layers(); ++layer) {
    const auto values = balance_row(balance, layer);
    std::vector<Cell> cells;
    cells.reserve(columns.size());
    for (std::size_t k = 0; k < columns.size(); ++k) cells.push_back({columns[k], values[k]});
    table.add(loop.layers(), layer, cells);
  }
  return table.take();
}

}  // namespace

Json layer_tables(FrameLoop& loop)
{
  const Window window = whole(loop);
  Json all{{"begin", window.begin},
           {"end", window.end},
           {"frames", window.frames.size()},
           {"tables", Json::array()},
           {"missing", Json::array()}};
  auto& tables = all["tables"];
  auto& missing = all["missing"];
  with_dimension(loop.dimension(), [&](auto d) {
    tables.push_back(stress_table<d>(loop, window));
    tables.push_back(kinetic_table<d>(loop, window));
    if (loop.species().size() == 2)
      tables.push_back(micro_table<d>(loop, window));
    else
      missing.push_back("grseg-micro compares two species, and the run has another number");
    if (loop.run().has_force())
      tables.push_back(balance_table<d>(loop, window));
    else
      missing.push_back("grseg-balance needs the forces on grains, which the run does not have");
  });
  return all;
}

}  // namespace grseg
