// SPDX-License-Identifier: GPL-3.0-or-later
// Parses values of options that have a grammar of their own. The first letter of an input selects
// the option.
#include "analysis/fit/fit_pairs.hpp"
#include "analysis/frames/layer_key.hpp"
#include "analysis/stress/partition_rule.hpp"
#include "formats/core/length.hpp"
#include "formats/import/dump/contact_columns.hpp"
#include "formats/import/facts/axes.hpp"
#include "formats/import/facts/species.hpp"
#include "formats/import/facts/units.hpp"
#include "formats/import/liggghts/liggghts_columns.hpp"
#include "tests/fuzz/fuzz.hpp"

#include <cmath>

namespace {

using namespace grseg;

constexpr LengthUnits units{0.005, 0.01};

void read(char kind, const std::string& text)
{
  switch (kind) {
    case 'l':
      fuzz::require(std::isfinite(parse_length(text, "--layer", units)), "a length is finite");
      break;
    case 'h':
      parse_heights(text, units, {}).holds(0, 1);
      break;
    case 's':
      fuzz::require(!parse_scan(text).shares().empty(), "a scan has a share");
      break;
    case 'r':
      for (const auto& rule : parse_rules({text}))
        fuzz::require(parse_rule(rule.name()) == rule, "a rule is read as it is named");
      break;
    case 'n':
      NumberList(text, "--small").contains(7);
      break;
    case 'u':
      parse_units(text);
      break;
    case 'g':
      orientation_of("xz", parse_gravity(text), 23, 3);
      break;
    case 'a':
      orientation_of(text, parse_gravity("3.8,0,-9"), {}, 2);
      break;
    case 'c':
      ContactColumns(text).look_up({"i", "j", "fx", "fy", "fz", "dist"}, "dump");
      break;
    default: {
      DumpHeader header;
      header.columns.resize(text.size() % 40, "c_cp[13]");
      liggghts_mapping(text, header);
    }
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  if (size > 0)
    fuzz::try_to(
        [&] { read(static_cast<char>(data[0]), std::string(fuzz::text_of(data + 1, size - 1))); });
  return 0;
}
