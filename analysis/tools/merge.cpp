// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/stress/merge_tables.hpp"
#include "analysis/tools/tool_main.hpp"
#include "formats/cli/output.hpp"
#include "formats/cli/provenance.hpp"

using namespace grseg;

namespace {

constexpr ToolInfo info{
    "grseg-merge", "merges tables of grseg-stress into one: per window, means weighted by frames.",
    "grseg-merge a.tsv b.tsv ... [options] > sums.tsv",
    "  grseg-merge seed1.tsv seed2.tsv -o sums.tsv      the sums of two runs as one table\n"
    "  grseg-merge sums.tsv --all-windows               all windows merged into one\n"};

const WantedTables wanted{
    {"grseg-stress", "grseg-merge"},
    "name tables of grseg-stress, the only ones that can be merged, since their columns are means per "
    "frame"};

struct Settings {
  TableOptions output;
  bool all_windows = false, json = false, quiet = false;
};

po::options_description options_into(Settings& s)
{
  po::options_description options("Options");
  auto add = options.add_options();
  add("all-windows", po::bool_switch(&s.all_windows), "merge all windows into one");
  add("json", po::bool_switch(&s.json), "print JSON instead of a table");
  add("quiet", po::bool_switch(&s.quiet), "no remarks");
  s.output.add_to(options);
  return options;
}

void merge(Settings& s, const po::variables_map& values, const std::string& command)
{
  s.output.check(values);
  const auto merged = merge_tables(read_tables(values, wanted), s.all_windows, info, command);
  write_table(s.output, s.json ? merged.to_json() : merged.to_text());
}

}  // namespace

int main(int argc, char** argv)
{
  return tool_main(argc, argv, info, options_into, merge);
}
