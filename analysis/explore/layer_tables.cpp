// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/balance/balance_table.hpp"
#include "analysis/balance/momentum_balance.hpp"
#include "analysis/explore/run_of_page.hpp"
#include "analysis/frames/composition.hpp"
#include "analysis/frames/sums.hpp"
#include "analysis/frames/table_writer.hpp"
#include "analysis/micro/derived_quantities.hpp"
#include "analysis/micro/structure_sums.hpp"
#include "analysis/segregation/rates.hpp"
#include "analysis/stress/kinetic_stress.hpp"
#include "analysis/stress/partial_contact_stress.hpp"
#include "analysis/stress/partial_stress.hpp"
#include "formats/core/frame.hpp"
#include "formats/core/length.hpp"
#include "formats/core/text.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

namespace grseg {
namespace {

using Json = nlohmann::ordered_json;

/// Builds a table with one row per layer: means over the frames of all windows. A window that does
/// not reach up to a layer counts with the numbers of an empty layer: 0, or NaN for quotients. NaN
/// and infinities are left out of the means.
class LayerTable {
 public:
  LayerTable(const char* name, const char* tool, const char* note, std::vector<std::string> shown)
      : table_{{"name", name},
               {"tool", tool},
               {"note", note},
               {"columns", Json::array()},
               {"shown", std::move(shown)},
               {"rows", Json::array()},
               {"frames", Json::array()}}
  {
  }

  /// Adds the numbers of one layer in one window.
  void add(const Window& window, std::size_t layer, const std::vector<Cell>& cells)
  {
    if (layers_.size() <= layer) layers_.resize(layer + 1);
    auto& own = layers_[layer];
    const auto frames = static_cast<double>(window.frames.size());
    own.frames += frames;
    own.add(frames, values_of(cells));
  }
  /// The finished table over all windows of the loop, which layer_tables() describes. `empty`: the
  /// numbers of an empty layer.
  Json take(const FrameLoop& loop, const std::vector<Cell>& empty)
  {
    double all = 0;
    for (const auto& window : loop.windows()) all += static_cast<double>(window.frames.size());
    table_["columns"] = {"y0[m]", "y1[m]"};
    for (const auto& column : columns_of(empty)) table_["columns"].push_back(column);
    for (std::size_t layer = 0; layer < layers_.size(); ++layer) {
      auto& own = layers_[layer];
      if (own.frames < all) own.add(all - own.frames, values_of(empty));
      Json row{loop.layers().bottom(layer), loop.layers().top(layer)};
      for (const auto& mean : own.means) row.push_back(ratio(mean.sum, mean.frames));
      table_["rows"].push_back(std::move(row));
      table_["frames"].push_back(own.frames);
    }
    return std::move(table_);
  }

 private:
  struct Mean {
    double sum = 0, frames = 0;
  };
  struct Layer {
    double frames = 0;        // of the windows that reach up to the layer
    std::vector<Mean> means;  // by column

    void add(double weight, const std::vector<double>& values)
    {
      means.resize(values.size());
      for (std::size_t k = 0; k < values.size(); ++k) {
        if (!std::isfinite(values[k])) continue;
        means[k].sum += weight * values[k];
        means[k].frames += weight;
      }
    }
  };
  Json table_;
  std::vector<Layer> layers_;
};

/// Sums over two frames without grains, which have one empty layer.
template <int D, class Sums>
Sums of_no_grains(Sums sums)
{
  Frame<D> frame;
  sums.add(Grains{}, frame);
  frame.time = 1;
  sums.add(Grains{}, frame);
  return sums;
}

/// Partial stress of each species and component, in columns such as "sigma_S_yy[N/m]".
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
std::vector<Cell> stress_cells(const FrameLoop& loop, const Composition<D>& composition,
                               const PartialContactStress<D>& contacts, std::size_t layer)
{
  const auto& species = loop.species();
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
  return cells;
}

template <int D>
Json stress_table(FrameLoop& loop)
{
  const auto& layers = loop.layers();
  const auto species = loop.species().size();
  const char* unit = D == 3 ? "[Pa]" : "[N/m]";
  LayerTable table(
      "stress", "grseg-stress", "Contact stress; mixed contacts shared by size.",
      {"nu", "phi_L", std::string("sigma_yy") + unit, "stress_ratio",
       std::string("sigma_S_yy") + unit, std::string("sigma_L_yy") + unit, "mixed_share_yy"});
  const Composition<D> no_grains(layers, GrainArea::clipped, std::nullopt, species);
  const PartialContactStress<D> no_contacts(layers, Assignment::contact_point, std::nullopt,
                                            std::nullopt, species);
  for (const auto& window : loop.windows()) {
    const auto [composition, contacts] =
        loop.sum<D>(window, {.velocity = false, .contacts = true}, no_grains, no_contacts);
    for (std::size_t layer = 0; layer < contacts.layers(); ++layer)
      table.add(window, layer, stress_cells(loop, composition, contacts, layer));
  }
  return table.take(
      loop, stress_cells(loop, of_no_grains<D>(no_grains), of_no_grains<D>(no_contacts), 0));
}

template <int D>
Json kinetic_table(FrameLoop& loop)
{
  const TrajectoryReader::Fields moving{.velocity = true, .contacts = false};
  const auto& layers = loop.layers();
  const auto& species = loop.species();
  LayerTable table("kinetic", "grseg-kinetic",
                   "Mean flow, and granular temperatures about its profile in each window.",
                   {"u[m/s]", "du_dy[1/s]", "T_S_x[m^2/s^2]", "T_S_y[m^2/s^2]", "T_L_x[m^2/s^2]",
                    "T_L_y[m^2/s^2]", "equipartition_y"});
  const MeanVelocity<D> no_grains(layers, loop.run().small_diameter() / 2, species.size());
  const auto about = [&](const MeanVelocity<D>& mean) {
    return KineticStress<D>(layers, MeanFlow::profile, mean, species.size());
  };
  for (const auto& window : loop.windows()) {
    const auto [mean] = loop.sum<D>(window, moving, no_grains);
    const auto [stress] = loop.sum<D>(window, moving, about(mean));
    for (std::size_t layer = 0; layer < stress.layers(); ++layer)
      table.add(window, layer, stress.cells(species, layer));
  }
  return table.take(loop, of_no_grains<D>(about(of_no_grains<D>(no_grains))).cells(species, 0));
}

template <int D>
Json micro_table(FrameLoop& loop)
{
  const auto constants = read_run_constants(empty_table(loop, "", {}, {}));
  const auto& layers = loop.layers();
  LayerTable table("micro", "grseg-derive", "Contacts per grain, mean forces, friction and fabric.",
                   {"z_S", "z_L", "f_S[N]", "f_L[N]", "f_SS[N]", "f_LS[N]", "f_LL[N]",
                    "mixed_share", "neutral_share", "sliding_all"});
  const StructureByLayer<D> no_grains(layers, GrainArea::clipped, constants.friction);
  const auto cells_of = [&](const StructureByLayer<D>& micro, const Window& window,
                            std::size_t layer) {
    const SumsRow<D> row{{window.begin, window.end, layers.bottom(layer), layers.top(layer),
                          static_cast<double>(window.frames.size()), layers.volume(layer)},
                         micro.mean(layer),
                         {},
                         micro.heights().bed};
    return derived_quantities(row, constants, DerivedSettings{});
  };
  for (const auto& window : loop.windows()) {
    const auto [micro] = loop.sum<D>(window, {.velocity = false, .contacts = true}, no_grains);
    for (std::size_t layer = 0; layer < micro.layers(); ++layer)
      table.add(window, layer, cells_of(micro, window, layer));
  }
  return table.take(loop, cells_of(of_no_grains<D>(no_grains), loop.windows().front(), 0));
}

template <int D>
Json balance_table(FrameLoop& loop)
{
  const auto& layers = loop.layers();
  const auto& run = loop.run();
  const auto& species = loop.species();
  const Kernel kernel(run.small_diameter());
  const std::string unit = D == 3 ? "[N/m^3]" : "[N/m^2]";
  LayerTable table(
      "balance", "grseg-balance",
      species.size() == 2
          ? "Momentum balance of the large grains along y; mixed contacts cut at the contact point."
          : "Momentum balance of each species; contacts of two species cut at the contact point.",
      {"gravity_L_y" + unit, "contact_L_y" + unit, "interaction_L_y" + unit, "base_L_y" + unit,
       "kinetic_L_y" + unit, "push" + unit, "push_kinetic" + unit, "drag" + unit});
  const MomentumBalance<D> no_grains(layers, kernel, run.gravity<D>(), run.step(), species.size());
  for (const auto& window : loop.windows()) {
    const auto [balance] =
        loop.sum<D>(window, {.velocity = true, .contacts = true, .force = true}, no_grains);
    for (std::size_t layer = 0; layer < balance.layers(); ++layer)
      table.add(window, layer, balance_cells(balance, species, layer));
  }
  return table.take(loop, balance_cells(of_no_grains<D>(no_grains), species, 0));
}

/// First column of grseg-segregation's table that describes the whole bed; columns before it describe layers.
constexpr const char* first_of_bed = "yL[m]";

template <int D>
Json segregation_of(FrameLoop& loop, const RowFilter& filter)
{
  const auto& species = loop.species();
  const double small = species[0].diameter, large = species[1].diameter;
  SegregationTable<D> run(loop.layers(), small, large);
  const auto columns = SegregationTable<D>::columns();
  const auto first = std::ranges::find(columns, first_of_bed) - columns.begin();
  // Begin and end of a window, then the row's cells that describe the bed; or the names of these columns.
  const auto of_bed = [&](auto begin, auto end, const auto& row) {
    Json all{begin, end};
    for (auto cell = row.begin() + first; cell != row.end(); ++cell) all.push_back(*cell);
    return all;
  };
  Json all{{"numbers", Json::array()},
           {"remarks", Json::array()},
           {"columns", of_bed("t0[s]", "t1[s]", columns)},
           {"rows", Json::array()}};
  for (const auto& window : loop.windows()) {
    const auto [series, flux] = loop.sum<D>(
        window, {.velocity = true, .contacts = false}, SegregationSeries<D>(loop.layers()),
        SegregationFlux<D>(loop.layers(), window, small, large));
    run.add(loop.grains(), series, flux);
    all["rows"].push_back(of_bed(window.begin, window.end, run.bed_row()));
  }
  const auto summary = run.summary(filter);
  for (const auto& [name, estimate] : summary.numbers)
    all["numbers"].push_back({name, estimate.value, estimate.low, estimate.high});
  for (const auto& remark : summary.remarks) all["remarks"].push_back(printable(remark));
  return all;
}

}  // namespace

Json layer_tables(FrameLoop& loop)
{
  const auto windows = loop.windows();
  Json all{{"begin", windows.front().begin},
           {"end", windows.back().end},
           {"windows", windows.size()},
           {"tables", Json::array()},
           {"missing", Json::array()}};
  auto& tables = all["tables"];
  auto& missing = all["missing"];
  with_dimension(loop.dimension(), [&](auto d) {
    tables.push_back(stress_table<d>(loop));
    tables.push_back(kinetic_table<d>(loop));
    if (loop.species().size() == 2)
      tables.push_back(micro_table<d>(loop));
    else
      missing.push_back("grseg-micro compares two species, and the run has another number");
    if (loop.run().has_force())
      tables.push_back(balance_table<d>(loop));
    else
      missing.push_back("grseg-balance needs the forces on grains, which the run does not have");
  });
  if (const auto below = loop.about_grains_below(); !below.empty())
    missing.push_back(printable(below));
  return all;
}

Json segregation_data(FrameLoop& loop, const std::string& heights)
{
  if (loop.species().size() != 2) return nullptr;
  const RowFilter filter{.heights = heights};
  return with_dimension(loop.dimension(), [&](auto d) { return segregation_of<d>(loop, filter); });
}

}  // namespace grseg
