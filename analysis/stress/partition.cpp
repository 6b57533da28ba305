// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/stress/partition.hpp"

#include "formats/cli/words.hpp"
#include "formats/core/errors.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <limits>
#include <sstream>
#include <utility>

namespace grseg {
namespace {

using Kind = PartitionRule::Kind;

constexpr std::pair<Kind, const char*> rule_names[] = {
    {Kind::size, "size"},       {Kind::contact_point, "contact-point"},
    {Kind::half, "half"},       {Kind::drop, "drop"},
    {Kind::uniform, "uniform"}, {Kind::power, "power"}};

constexpr const char* all_rules = "size, contact-point, half, drop, uniform:P and power:Q";

bool takes_number(Kind kind)
{
  return kind == Kind::uniform || kind == Kind::power;
}

double parse_value(const std::string& text, const std::string& rule)
{
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  if (text.empty() || *end != '\0' || !std::isfinite(value))
    throw UsageError(
        fmt::format("--partition {}: '{}' is no number; write e.g. uniform:0.8 or "
                    "power:2",
                    rule, text));
  return value;
}

[[noreturn]] void refuse(const std::string& word)
{
  throw UsageError(unknown_word("--partition", word,
                                {"size", "contact-point", "half", "drop", "uniform:P", "power:Q"}));
}

/// What contacts between mobile grains give to the species, N m, and what they give to nobody.
struct Shares {
  Tensor2 small, large, dropped = Tensor2::Zero();
};

/// Every mixed contact's share `p` goes to its large grain.
Shares shares(const ContactSums& sums, double p)
{
  if (!sums.booked_at_centres)
    return {sums.ss + (sums.mixed - p * sums.mixed), sums.ll + p * sums.mixed};
  const auto& centres = sums.at_centres;
  return {centres.ss + (1 - p) * centres.mixed_small, centres.ll + p * centres.mixed_large};
}

Shares shares(const ContactSums& sums, const Tensor2& of_large)
{
  return {sums.ss + (sums.mixed - of_large), sums.ll + of_large};
}

Shares shares(const ContactSums& sums, const PartitionRule& rule)
{
  switch (rule.kind) {
    case Kind::size:
      return shares(sums, sums.mixed_size);
    case Kind::contact_point:
      return shares(sums, sums.mixed_contact);
    case Kind::half:
      return shares(sums, 0.5);
    case Kind::uniform:
      return shares(sums, rule.value);
    case Kind::power:
      return shares(sums, sums.mixed_power);
    case Kind::drop:
      break;
  }
  return {sums.ss, sums.ll, sums.mixed};
}

}  // namespace

std::string PartitionRule::name() const
{
  for (const auto& [known, word] : rule_names)
    if (known == kind) return takes_number(kind) ? fmt::format("{}:{}", word, value) : word;
  return "";
}

std::string PartitionRule::used_by() const
{
  switch (kind) {
    case Kind::size:
      return "grseg, Staron & Phillips 2015";
    case Kind::contact_point:
      return "MercuryDPM MercuryCG";
    case Kind::half:
      return "LAMMPS, LIGGGHTS compute stress/atom";
    case Kind::drop:
      return "LAMMPS compute continuum/chunk of a group";
    case Kind::uniform:
    case Kind::power:
      break;
  }
  return "";
}

PartitionRule parse_rule(const std::string& text)
{
  const auto colon = text.find(':');
  const std::string word = text.substr(0, colon);
  for (const auto& [kind, known] : rule_names) {
    if (word != known) continue;
    const bool has_number = colon != std::string::npos;
    if (takes_number(kind) != has_number)
      throw UsageError(fmt::format("--partition {}: this rule takes {}; the rules are {}", text,
                                   has_number ? "no number" : "a number", all_rules));
    if (!has_number) return {kind};
    const double value = parse_value(text.substr(colon + 1), text);
    if (kind == Kind::uniform && (value < 0 || value > 1))
      throw UsageError(
          fmt::format("--partition {}: the large grain's share lies between 0 and 1", text));
    return {kind, value};
  }
  refuse(word);
}

std::vector<PartitionRule> parse_rules(const std::vector<std::string>& texts)
{
  std::vector<PartitionRule> rules;
  for (const auto& text : texts) {
    std::istringstream list(text);
    if (text.empty()) refuse("");
    for (std::string one; std::getline(list, one, ',');) {
      if (one == "stock")
        rules.insert(rules.end(),
                     {{Kind::size}, {Kind::contact_point}, {Kind::half}, {Kind::drop}});
      else
        rules.push_back(parse_rule(one));
    }
  }
  return rules;
}

BasePart parse_base(const std::string& text)
{
  return choose<BasePart>(text, "--base",
                          {{"contact-point", BasePart::contact_point},
                           {"half", BasePart::half},
                           {"none", BasePart::none}});
}

PartialStress partial_stress(const ContactSums& sums, const PartitionRule& rule, BasePart base,
                             StressVolume volume)
{
  Tensor2 base_small = Tensor2::Zero(), base_large = Tensor2::Zero();
  if (base == BasePart::contact_point) {
    base_small = sums.base_small;
    base_large = sums.base_large;
  } else if (base == BasePart::half) {
    base_small = 0.5 * sums.whole_small;
    base_large = 0.5 * sums.whole_large;
  }
  const auto [small, large, dropped] = shares(sums, rule);
  const double v = volume == StressVolume::bulk ? sums.volume : sums.area_small + sums.area_large;
  return {.small = (small + base_small) / v,
          .large = (large + base_large) / v,
          .total = (small + large + dropped + base_small + base_large) / v};
}

double neutral_b(const PartitionRule& rule, double size_ratio, double phi_large)
{
  const double by_size = size_ratio / (1 + size_ratio);
  double share = by_size;  // size and contact-point
  if (rule.kind == Kind::half) share = 0.5;
  if (rule.kind == Kind::uniform) share = rule.value;
  if (rule.kind == Kind::power) share = 1 / (1 + std::pow(size_ratio, -rule.value));
  if (rule.kind == Kind::drop) return std::numeric_limits<double>::quiet_NaN();
  return (share - by_size) * (1 + size_ratio) / (phi_large + size_ratio * (1 - phi_large));
}

std::size_t find_column(const Table& table, const std::string& name, const std::string& remedy)
{
  if (!table.has_column(name))
    throw FormatError(fmt::format("{}: there is no column '{}'; {}", table.name, name, remedy));
  return table.column(name);
}

double finite_cell(const Table& table, std::size_t row, std::size_t column)
{
  const double value = table.rows[row][column];
  if (!std::isfinite(value))
    throw FormatError(fmt::format("{}: row {}, column {}: {} is no finite number", table.name,
                                  row + 1, table.columns[column], format_number(value)));
  return value;
}

ContactSumsReader::ContactSumsReader(const Table& table, const std::vector<PartitionRule>& rules)
    : table_(table)
{
  const std::string remedy = "a table of grseg-stress has it";
  volume_ = find_column(table, "V", remedy);
  area_small_ = find_column(table, "area_S", remedy);
  area_large_ = find_column(table, "area_L", remedy);
  ss_ = find("A_SS", remedy);
  ll_ = find("A_LL", remedy);
  mixed_ = find("M", remedy);
  mixed_size_ = find("Msize", remedy);
  mixed_contact_ = find("Mcp", remedy);
  base_small_ = find("A_Sb", remedy);
  base_large_ = find("A_Lb", remedy);
  whole_small_ = find("F_Sb", remedy);
  whole_large_ = find("F_Lb", remedy);
  for (const auto& rule : rules) {
    const bool same_for_all = rule.kind == Kind::half || rule.kind == Kind::uniform;
    if (same_for_all && table.has_column("ML_xx")) {
      const std::string how = "make the table anew with grseg-stress --assign grain";
      at_centres_ = {find("HSS", how), find("HLL", how), find("ML", how), find("MS", how)};
    }
    if (rule.kind != Kind::power) continue;
    const auto how = fmt::format("make the table with grseg-stress --partition {}", rule.name());
    mixed_power_ = find("Mpower", how);
    if (table.header_number("power") != rule.value)
      throw FormatError(fmt::format("{}: its column Mpower_* was made with power:{}; {}",
                                    table.name, table.header_text("power"), how));
  }
}

ContactSumsReader::TensorColumns ContactSumsReader::find(const std::string& name,
                                                         const std::string& remedy) const
{
  const auto component = [&](const char* end) { return find_column(table_, name + end, remedy); };
  return {component("_xx"), component("_xy"), component("_yx"), component("_yy")};
}

Tensor2 ContactSumsReader::tensor(std::size_t row, const TensorColumns& columns) const
{
  const auto cell = [&](std::size_t column) { return finite_cell(table_, row, column); };
  Tensor2 value;  // entry by entry: a comma list of Eigen's must not be left by an exception
  value(0, 0) = cell(columns.xx);
  value(0, 1) = cell(columns.xy);
  value(1, 0) = cell(columns.yx);
  value(1, 1) = cell(columns.yy);
  return value;
}

ContactSums ContactSumsReader::read(std::size_t row) const
{
  ContactSums sums;
  sums.volume = finite_cell(table_, row, volume_);
  sums.area_small = finite_cell(table_, row, area_small_);
  sums.area_large = finite_cell(table_, row, area_large_);
  sums.ss = tensor(row, ss_);
  sums.ll = tensor(row, ll_);
  sums.mixed = tensor(row, mixed_);
  sums.mixed_size = tensor(row, mixed_size_);
  sums.mixed_contact = tensor(row, mixed_contact_);
  if (mixed_power_) sums.mixed_power = tensor(row, *mixed_power_);
  sums.base_small = tensor(row, base_small_);
  sums.base_large = tensor(row, base_large_);
  sums.whole_small = tensor(row, whole_small_);
  sums.whole_large = tensor(row, whole_large_);
  sums.booked_at_centres = at_centres_.has_value();
  if (at_centres_)
    sums.at_centres = {.ss = tensor(row, at_centres_->ss),
                       .ll = tensor(row, at_centres_->ll),
                       .mixed_large = tensor(row, at_centres_->mixed_large),
                       .mixed_small = tensor(row, at_centres_->mixed_small)};
  return sums;
}

}  // namespace grseg
