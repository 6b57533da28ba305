// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/frames/presets.hpp"
#include "analysis/frames/table_writer.hpp"
#include "analysis/stress/partial_contact_stress.hpp"
#include "analysis/stress/partial_stress.hpp"
#include "analysis/tools/tool_main.hpp"
#include "formats/cli/output.hpp"
#include "formats/cli/provenance.hpp"
#include "formats/cli/words.hpp"
#include "formats/core/frame.hpp"

using namespace grseg;

namespace {

constexpr ToolInfo info{
    "grseg-stress",
    "contact stress (sums of force (x) branch vector) by layer, window and pair of species.",
    "grseg-stress run.h5 [options] > sums.tsv",
    "  grseg-stress run.h5 -o sums.tsv                  layers of 4 dS, windows of 1.25 s\n"
    "  grseg-stress run.h5 --assign branch --layer 1dS  thin layers, exact momentum balance\n"
    "  grseg-stress run.h5 --assign gauss --kernel-width 1dS   coarse grained by a Gaussian\n"
    "  grseg-stress drum.h5 --bins radius --layer 2dS   annuli about the axis of a drum\n"
    "  grseg-stress drum.h5 --bins xy --layer 2dS -o map.h5           a map, for h5py or xarray\n"
    "  grseg-stress run.h5 --partition power:2 | grseg-fit - --partition power:2\n",
    presets::stress};

struct Settings {
  FrameOptions frames;
  ContactAssignmentOptions assignment;
  std::string base = "contact-point", volume = "bulk", partition = "size";
};

po::options_description options_into(Settings& s)
{
  po::options_description options("Options");
  s.assignment.add_to(options);
  auto add = options.add_options();
  add("partition", word_option(&s.partition, words_of_rule()),
      "rule that grseg-fit uses by default for this table; power:Q adds columns Mpower_*");
  add("base-part", word_option(&s.base, words_of(base_parts)),
      ("default of grseg-fit, too: part of a contact with base or wall that its grain gets: " +
       list_of(base_parts))
          .c_str());
  add("volume", word_option(&s.volume, words_of(stress_volumes)),
      ("default of grseg-fit, too: volume to divide by: " + list_of(stress_volumes)).c_str());
  s.frames.add_bins_to(options);
  s.frames.add_to(options);
  return options;
}

/// Choices by which sums become stress in a map. For a table of layers grseg-fit makes them.
MapStress stress_of(Settings& s)
{
  const MapStress how{parse_rule(s.partition), choose(s.base, "--base-part", base_parts),
                      choose(s.volume, "--volume", stress_volumes)};
  s.partition = how.rule.name();
  return how;
}

template <int D>
void tabulate(FrameLoop& loop, const Settings& s, const ContactAssignment& chosen,
              const MapStress& how, const std::string& command)
{
  std::optional<double> power;  // exponent of the columns Mpower_*, if the rule needs them
  if (how.rule.kind == PartitionRule::Kind::power) power = how.rule.value;
  const bool map = loop.layers().map() != nullptr;
  Header settings{{"assign", s.assignment.assign},
                  {"composition", s.assignment.composition},
                  {"partition", s.partition},
                  {"base", s.base},
                  {"volume", s.volume}};
  if (power) settings.emplace_back("power", format_number(*power));
  const auto kernel =
      s.assignment.kernel(chosen, {loop.run().small_diameter(), loop.run().large_diameter()});
  if (kernel) settings.emplace_back("width", format_number(kernel->width()));
  const auto& species = loop.species();
  const Composition<D> no_grains(loop.layers(), chosen.area, kernel, species.size());
  const PartialContactStress<D> no_contacts(loop.layers(), chosen.assignment, power, kernel,
                                            species.size());
  const auto fields_of = [&](const ContactSums<D>& sums) {
    return map ? stress_fields(sums, species, how) : std::vector<Cell>{};
  };
  auto columns = content_columns(species, D);
  add_all(columns, motion_columns(D));
  add_all(columns, no_contacts.columns(species));
  add_all(columns, columns_of(fields_of(ContactSums<D>(species.size()))));
  TableWriter table(loop, command, settings, columns);

  for (const auto& window : loop.windows()) {
    const auto [composition, stress] =
        loop.sum<D>(window, {.velocity = true, .contacts = true}, no_grains, no_contacts);
    for (std::size_t layer = 0; layer < stress.layers(); ++layer) {
      auto row = composition.row(layer);
      auto sums = map ? stress.mean(layer).sums : ContactSums<D>(0);
      sums.content = composition.mean(layer);
      sums.volume = loop.layers().volume(layer);
      add_all(row, stress.row(layer));
      table.add(window, layer, add_all(row, values_of(fields_of(sums))));
    }
  }
  table.write("grseg-fit");
}

void tabulate(Settings& s, const po::variables_map& values, const std::string& command)
{
  const bool default_in_annuli = s.frames.annuli() && s.assignment.composition.empty();
  auto chosen = s.assignment.contact_assignment(values, s.frames.map() ? "centre" : "clipped");
  s.assignment.require_bins(chosen, s.frames);
  const auto how = stress_of(s);
  FrameLoop loop(info, values, s.frames);
  if (default_in_annuli && loop.dimension() == 3) {  // spheres are not clipped at annuli
    chosen.area = GrainArea::centre;
    s.assignment.composition = word_of(chosen.area, grain_areas);
  }
  with_dimension(loop.dimension(), [&](auto d) { tabulate<d>(loop, s, chosen, how, command); });
}

}  // namespace

int main(int argc, char** argv)
{
  return tool_main<Settings>(argc, argv, info, options_into, tabulate);
}
