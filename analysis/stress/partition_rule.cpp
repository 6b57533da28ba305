// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/stress/partition_rule.hpp"

#include "analysis/frames/sums.hpp"
#include "formats/cli/words.hpp"
#include "formats/core/errors.hpp"
#include "formats/core/species.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <sstream>

namespace grseg {
namespace {

using Kind = PartitionRule::Kind;

/// The rules. A new rule needs a Kind, a row here and, if its share differs from contact to
/// contact, a sum with its columns (contact_sums.hpp).
constexpr RuleDefinition definitions[] = {
    // Staron & Phillips (2015), prefactors d_L/(d_L + d_S) and d_S/(d_L + d_S) below eq. 1
    {.kind = Kind::size,
     .word = "size",
     .meaning = "r_L/(r_L + r_S) of the actual radii (for nominal radii 2:1, uniform:0.66667)",
     .share = [](const MixedContact& contact,
                 double) { return contact.r_large / (contact.r_large + contact.r_small); },
     .sum = PairSum::by_size,
     .along_own_stretch = true,
     .used_by = "grseg, Staron & Phillips 2015",
     .stock = true},
    // Weinhart, Thornton, Luding & Bokhove (2012), Granular Matter 14:289
    {.kind = Kind::contact_point,
     .word = "contact-point",
     .meaning = "the branch is cut where the grains touch",
     .share = [](const MixedContact& contact, double) { return contact.up_to_contact; },
     .sum = PairSum::up_to_contact,
     .along_own_stretch = true,
     .used_by = "MercuryDPM coarse graining; YADE, PFC stress per body",
     .stock = true},
    {.kind = Kind::half,
     .word = "half",
     .meaning = "1/2",
     .share = [](const MixedContact&, double) { return 0.5; },
     .used_by = "LAMMPS, LIGGGHTS compute stress/atom, also of a group",
     .stock = true},
    {.kind = Kind::drop,
     .word = "drop",
     .meaning = "mixed contacts belong to neither species",
     .share = nullptr,
     .used_by = "sums over pairs within one species (contact lists filtered by type)",
     .stock = true},
    {.kind = Kind::uniform,
     .word = "uniform",
     .meaning = "P for every contact",
     .share = [](const MixedContact&, double share) { return share; },
     .number = "P",
     .least = 0,
     .most = 1},
    {.kind = Kind::power,
     .word = "power",
     .meaning = "r_L^Q/(r_L^Q + r_S^Q)",
     .share =
         [](const MixedContact& contact, double exponent) {
           return 1 / (1 + std::pow(contact.r_small / contact.r_large, exponent));
         },
     .sum = PairSum::by_power,
     .number = "Q"},
};

constexpr const char* stock_word = "stock";

bool takes_number(const RuleDefinition& rule)
{
  return *rule.number != '\0';
}

std::string as_typed(const RuleDefinition& rule, const std::string& number)
{
  return takes_number(rule) ? fmt::format("{}:{}", rule.word, number) : rule.word;
}

double parse_number(const RuleDefinition& rule, const std::string& text, const std::string& whole)
{
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  if (text.empty() || *end != '\0' || !std::isfinite(value))
    throw UsageError(fmt::format(
        "--partition {}: '{}' is not a number; write e.g. uniform:0.8 or power:2", whole, text));
  if (value < rule.least || value > rule.most)
    throw UsageError(fmt::format("--partition {}: {} must lie between {:g} and {:g}", whole,
                                 rule.number, rule.least, rule.most));
  return value;
}

[[noreturn]] void refuse(const std::string& word)
{
  throw UsageError(unknown_word("--partition", word, words_of_rule()));
}

}  // namespace

std::span<const RuleDefinition> rule_definitions()
{
  return definitions;
}

const RuleDefinition& PartitionRule::definition() const
{
  return *std::ranges::find(definitions, kind, &RuleDefinition::kind);
}

std::string PartitionRule::name() const
{
  return as_typed(definition(), fmt::format("{}", value));
}

std::vector<std::string> words_of_rule(bool (*wanted)(const RuleDefinition&))
{
  std::vector<std::string> words;
  for (const auto& rule : definitions)
    if (wanted == nullptr || wanted(rule)) words.push_back(as_typed(rule, rule.number));
  return words;
}

std::vector<std::string> words_of_rules()
{
  auto words = words_of_rule();
  words.emplace_back(stock_word);
  return words;
}

std::string list_of_rules(const std::string& conjunction)
{
  const auto words = words_of_rule();
  return fmt::format("{} {} {}", fmt::join(words.begin(), words.end() - 1, ", "), conjunction,
                     words.back());
}

PartitionRule parse_rule(const std::string& text)
{
  const auto colon = text.find(':');
  const bool has_number = colon != std::string::npos;
  const std::string word = text.substr(0, colon);
  for (const auto& rule : definitions) {
    if (word != rule.word) continue;
    if (takes_number(rule) != has_number)
      throw UsageError(fmt::format("--partition {}: this rule takes {}; the rules are {}", text,
                                   has_number ? "no number" : "a number", list_of_rules()));
    if (!has_number) return {rule.kind};
    return {rule.kind, parse_number(rule, text.substr(colon + 1), text)};
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
      if (one != stock_word) {
        rules.push_back(parse_rule(one));
        continue;
      }
      for (const auto& rule : definitions)
        if (rule.stock) rules.push_back({rule.kind});
    }
  }
  return rules;
}

std::vector<PartitionRule> without_repeats(const std::vector<PartitionRule>& rules)
{
  std::vector<PartitionRule> once;
  for (const auto& rule : rules)
    if (std::ranges::find(once, rule) == once.end()) once.push_back(rule);
  return once;
}

std::string names_of(const std::vector<PartitionRule>& rules)
{
  return fmt::format("{}", fmt::join(listed(rules, &PartitionRule::name), ","));
}

MixedContact mixed_contact(const Grains& grains, std::size_t i, std::size_t j, double share_i)
{
  const double r_i = grains.radius[i], r_j = grains.radius[j];
  if (grains.species[i] > grains.species[j]) return {r_i, r_j, share_i};
  return {r_j, r_i, 1 - share_i};
}

template <int D>
ContactShares contact_shares(const Grains& grains, const Frame<D>& frame, std::size_t contact,
                             const PartitionRule& rule)
{
  const auto [i, j] = partners(grains, frame, contact);
  const double up_to_contact = share_of_first(grains, frame.contacts, contact);
  if (!j) return {up_to_contact, 0};
  const auto a = grains.species[i], b = grains.species[*j];
  if (a == b) return {up_to_contact, 1 - up_to_contact};
  const auto& definition = rule.definition();
  if (definition.share == nullptr) return {0, 0};
  const double to_large = definition.share(mixed_contact(grains, i, *j, up_to_contact), rule.value);
  return a > b ? ContactShares{to_large, 1 - to_large} : ContactShares{1 - to_large, to_large};
}

template ContactShares contact_shares(const Grains&, const Frame<2>&, std::size_t,
                                      const PartitionRule&);
template ContactShares contact_shares(const Grains&, const Frame<3>&, std::size_t,
                                      const PartitionRule&);

double neutral_ends_of_large(double phi_large, double size_ratio)
{
  return phi_large / (phi_large + size_ratio * (1 - phi_large));
}

double neutral_mixed_share(double phi_large, double size_ratio)
{
  const double x_large = neutral_ends_of_large(phi_large, size_ratio);
  return 2 * x_large * (1 - x_large);
}

double nominal_share(const PartitionRule& rule, double size_ratio)
{
  const auto share = rule.definition().share;
  if (share == nullptr) return no_number;
  return share({size_ratio, 1, neutral_zero_share(size_ratio)}, rule.value);
}

double neutral_zero_share(double size_ratio)
{
  return size_ratio / (1 + size_ratio);
}

double neutral_b(const PartitionRule& rule, double size_ratio, double phi_large)
{
  const double excess = nominal_share(rule, size_ratio) - neutral_zero_share(size_ratio);
  return excess * (1 + size_ratio) / (phi_large + size_ratio * (1 - phi_large));
}

}  // namespace grseg
