// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/fit/fit_options.hpp"

#include "analysis/fit/over.hpp"
#include "analysis/fit/partition_scan.hpp"
#include "analysis/frames/layer_key.hpp"
#include "analysis/stress/partial_stress.hpp"
#include "formats/cli/word_option.hpp"
#include "formats/cli/words.hpp"
#include "formats/core/errors.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdio>

namespace grseg {
namespace {

const std::vector<std::string> fit_words{"paper"};

std::string rules_help()
{
  std::string text = "the large grain's share of a mixed contact; several rules give a row each.";
  for (const auto& rule : rule_definitions())
    text += fmt::format("\n{}{}{}{}: {}{}", rule.word, *rule.number == '\0' ? "" : ":", rule.number,
                        rule.kind == PartitionRule{}.kind ? " (default)" : "", rule.meaning,
                        *rule.used_by == '\0' ? "" : fmt::format(" [{}]", rule.used_by));
  text += "\nstock:";
  for (const auto& rule : parse_rules({"stock"})) text += fmt::format(" {}", rule.name());
  return text;
}

void parse_ratio_range(const std::string& text, FitFilters& filters)
{
  int used = 0;
  if (std::sscanf(text.c_str(), "%lf:%lf%n", &filters.ratio_low, &filters.ratio_high, &used) != 2 ||
      static_cast<std::size_t>(used) != text.size() ||
      !(filters.ratio_low > 0 && filters.ratio_low <= filters.ratio_high))
    throw UsageError(
        fmt::format("--ratio-range {}: write low:high, 0 < low <= high, e.g. 0.01:100", text));
}

}  // namespace

po::options_description FitOptions::description()
{
  po::options_description options("Options");
  const auto text = [](std::string& place, const char* name) {
    return po::value(&place)->value_name(name);
  };
  const auto number = [](auto& place, const char* name) {
    return po::value(&place)->value_name(name);
  };
  auto add = options.add_options();
  add("partition", words_option(partition, words_of_rules()), rules_help().c_str());
  add("component", word_option(&component, words_of(components)), list_of(components).c_str());
  add("quantity", word_option(&quantity, words_of(quantities)),
      (list_of(quantities) + " stress").c_str());
  add("fit", word_option(&fit, fit_words),
      "also what Staron & Phillips (2015) fit: the slope s of sigma^S/sigma^L over phi_S/phi_L, B of "
      "it, and k (phi_S/phi_L)^a");
  add("base-part", word_option(&base, words_of(base_parts)),
      ("part of contacts with base and walls: " + list_of(base_parts) +
       " (default: as in the table)")
          .c_str());
  add("pair", text(pair, "A,B"), "two of the species, by name or number (default: all pairs)");
  add("exponent", po::bool_switch(&exponent),
      "also a of sigma^nu/sigma = phi^nu s^a/sum(phi s^a), s the diameters; of more than two "
      "species always");
  add("scan", text(scan, "p0:p1:dp"), "print B over the share p instead of the rules");
  add("over", word_option(&over, words_of(overs)),
      ("what intervals are over, in one row per rule: " + list_of(overs) +
       " (default: windows of one run, runs of one flow; of several flows each over its runs, then "
       "all over flows)")
          .c_str());
  add("flows", text(flows, "N,N,...")->default_value("auto"),
      "how many of the tables, in their order, are runs of each flow; auto: those that agree in "
      "what they record of the flow and in overall composition");
  add("bootstrap", number(bootstrap, "N")->default_value(1000),
      "samples for the 95 % intervals; 0: no intervals");
  add("seed", number(seed, "N")->default_value(1), "seed of the samples");
  add("ratio-range", text(ratio_range, "a:b")->default_value("0.01:100"),
      "phi_S/phi_L of the layers that take part");
  add("heights", text(filters.heights, "y0:y1")->default_value(inside_the_bed),
      fmt::format("layers that take part: {}", heights_help).c_str());
  add("min-solid", number(filters.min_solid, "X")->default_value(0.5, "0.5"),
      "least solid fraction of a layer, in units of the run's median");
  add("begin", number(filters.begin, "s"), "first time of the windows that take part");
  add("end", number(filters.end, "s"), "last time of the windows that take part");
  add("json", po::bool_switch(&json), "print JSON instead of a table");
  add("quiet", po::bool_switch(&quiet), "no remarks on standard error");
  output.add_to(options);
  return options;
}

void FitOptions::check(const po::variables_map& values)
{
  if (!values.contains("input"))
    throw UsageError("no table given; name tables of grseg-stress, or - for standard input");
  if (bootstrap != 0 && (bootstrap < 100 || bootstrap > 100000))
    throw UsageError(fmt::format("--bootstrap {}: 0, or 100 to 100000 samples", bootstrap));
  if (seed < 0) throw UsageError("--seed must not be negative");
  output.check(values);
  if (std::isnan(filters.begin) || std::isnan(filters.end))
    throw UsageError("--begin and --end are times in seconds");
  if (!(filters.min_solid >= 0)) throw UsageError("--min-solid must not be negative");
  if (!over.empty()) choose(over, "--over", overs);
  if (!fit.empty() && fit != fit_words[0]) throw UsageError(unknown_word("--fit", fit, fit_words));
  parse_rules(partition);
  check_heights(filters.heights);
  if (!scan.empty()) parse_scan(scan);
  if (quantity == "kinetic")
    for (const char* option : {"partition", "scan", "base-part"})
      if (values.contains(option) && !values[option].defaulted())
        throw UsageError(
            fmt::format("--{} concerns contacts; leave it out with --quantity kinetic", option));
  parse_ratio_range(ratio_range, filters);
}

}  // namespace grseg
