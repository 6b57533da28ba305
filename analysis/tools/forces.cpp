// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/frames/sums.hpp"
#include "analysis/frames/table_writer.hpp"
#include "analysis/micro/force_distribution.hpp"
#include "analysis/tools/tool_main.hpp"
#include "formats/cli/words.hpp"
#include "formats/core/frame.hpp"

#include <cmath>

using namespace grseg;

namespace {

constexpr ToolInfo info{
    "grseg-forces",
    "histograms of the contacts' normal forces f_n by layer, window and pair of species.",
    "grseg-forces run.h5 [options] > forces.tsv",
    "  grseg-forces run.h5 --window 30 -o forces.tsv    f_n over its mean, by layer and bed\n"
    "  grseg-forces run.h5 --unit type                  over the mean of the same pair type\n"};

struct Settings {
  FrameOptions frames;
  std::string unit = "layer";
  double bin = 0.1;
};

po::options_description options_into(Settings& s)
{
  po::options_description options("Options");
  auto add = options.add_options();
  add("unit", word_option(&s.unit, words_of(force_units)),
      "unit of f_n, a mean force: of all contacts between grains in the layer, without them of its "
      "contacts with the base (layer), or of contacts of the same pair type, such as LS (type)");
  add("bin", po::value(&s.bin)->default_value(s.bin, "0.1")->value_name("X"),
      "width of the 100 bins, in that unit; a last bin has all larger forces");
  s.frames.add_to(options);
  return options;
}

template <int D>
void tabulate(FrameLoop& loop, const Settings& s, ForceUnit unit, const std::string& command)
{
  TableWriter table(loop, command, {{"unit", s.unit}, {"bin", format_number(s.bin)}},
                    ForceDistribution<D>::columns());
  const TrajectoryReader::Fields contacts{.velocity = false, .contacts = true};
  loop.expect_passes(2);
  for (const auto& window : loop.windows()) {
    const auto [mean] = loop.sum<D>(window, contacts, MeanNormalForce<D>(loop.layers()));
    const auto [forces] =
        loop.sum<D>(window, contacts, ForceDistribution<D>(loop.layers(), mean, unit, s.bin));
    for (std::size_t layer = 0; layer < forces.layers(); ++layer)
      for (const auto& row : forces.rows(layer)) table.add(window, layer, row);
    for (const auto& row : forces.bed_rows()) table.add_bed(window, no_number, row);
  }
  table.write();
}

void tabulate(Settings& s, const po::variables_map& values, const std::string& command)
{
  const auto unit = choose(s.unit, "--unit", force_units);
  if (!(s.bin > 0) || !std::isfinite(s.bin)) throw UsageError("--bin must be positive");
  FrameLoop loop(info, values, s.frames);
  loop.require_two_species();
  with_dimension(loop.dimension(), [&](auto d) { tabulate<d>(loop, s, unit, command); });
}

}  // namespace

int main(int argc, char** argv)
{
  return tool_main<Settings>(argc, argv, info, options_into, tabulate);
}
