// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/frames/layer_key.hpp"
#include "analysis/frames/presets.hpp"
#include "analysis/micro/sums_table.hpp"
#include "analysis/tools/tool_main.hpp"
#include "formats/cli/output.hpp"
#include "formats/cli/provenance.hpp"
#include "formats/core/errors.hpp"

using namespace grseg;

namespace {

constexpr ToolInfo info{
    "grseg-derive",
    "contacts per grain, mean forces, pressures, B, friction and fabric from sums of grseg-micro.",
    "grseg-derive micro.tsv ... [options] > derived.tsv    (-: standard input)",
    "  grseg-derive micro.tsv                           z, f, Pi, B, friction, fabric of each row\n"
    "  grseg-derive micro.tsv --force normal --average ends --pool composition\n"
    "  grseg-micro run.h5 | grseg-derive -              through a pipe, without a file\n",
    presets::derive};

const WantedTables wanted{
    {"", "grseg-micro"},
    "name tables of grseg-micro, such as micro.tsv of grseg-micro run.h5 -o micro.tsv, or - for "
    "standard input"};

struct Settings {
  DerivedOptions derivation;
  TableOptions output;
  bool json = false, quiet = false;
};

po::options_description options_into(Settings& s)
{
  po::options_description options("Options");
  s.derivation.add_to(options);
  auto add = options.add_options();
  add("json", po::bool_switch(&s.json), "print JSON instead of a table");
  add("quiet", po::bool_switch(&s.quiet), "no remarks");
  s.output.add_to(options);
  return options;
}

void derive(Settings& s, const po::variables_map& values, const std::string& command)
{
  s.derivation.check();
  s.output.check(values);
  const auto tables = read_tables(values, wanted);
  const auto table =
      derived_table(tables, s.derivation, provenance_of(tables, info, preset_of(values), command));
  write_table(s.output, s.json ? table.to_json() : table.to_text());
}

}  // namespace

int main(int argc, char** argv)
{
  return tool_main(argc, argv, info, options_into, derive);
}
