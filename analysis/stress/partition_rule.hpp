// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/stress/contact_sums.hpp"
#include "formats/core/frame.hpp"

#include <cstddef>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace grseg {

/// Partition rules: how the stress of contacts between a large and a small grain is shared between
/// the species. They are algebra on stored sums, so no contact is read again for another rule.

struct RuleDefinition;

/// Rule for the large grain's share of a mixed contact's stress; the small grain has the rest.
struct PartitionRule {
  enum class Kind { size, contact_point, half, drop, uniform, power };
  Kind kind = Kind::size;
  double value = 0;  // P of uniform:P, Q of power:Q

  const RuleDefinition& definition() const;
  /// Name as in --partition: "size", "uniform:0.8".
  std::string name() const;
  /// The programs that use this rule; "" if none is known.
  std::string used_by() const;
  /// True if the species' stresses add up to the total: for all rules but `drop`.
  bool adds_up() const;
  bool operator==(const PartitionRule&) const = default;
};

/// Properties of a contact between a large and a small grain that rules use.
struct MixedContact {
  double r_large, r_small;  // radii, in m or any common unit
  double up_to_contact;     // share of the branch from the large grain's centre to the contact
};
/// The contact between grains i and j of different species. `share_i` is the share of the branch
/// from the centre of i to the contact point.
MixedContact mixed_contact(const Grains& grains, std::size_t i, std::size_t j, double share_i);

/// Definition of one kind of rule. Parsing, --help, "stock", used_by, the columns that a table must
/// have, the stresses and the neutral B all use the list of definitions in partition_rule.cpp.
struct RuleDefinition {
  PartitionRule::Kind kind;
  const char* word;     // name of the rule in --partition
  const char* meaning;  // share of the large grain, for --help
  /// The larger grain's share of a contact; `number` is the P or Q after the word. Null: the stress
  /// of mixed contacts belongs to no species.
  double (*share)(const MixedContact& contact, double number);
  /// Sum of the large grains' parts, if the share differs from contact to contact. Nothing if the
  /// share is the same for all contacts, so that the sum over whole branches suffices.
  std::optional<PairSum> sum = {};
  /// True if this sum is spread over layers along the large grain's own stretch of the branch,
  /// which begins at its centre; false if it is spread along the whole branch.
  bool along_own_stretch = false;
  const char* used_by = "";  // programs that use this rule; "": none known
  bool stock = false;        // true if --partition stock includes the rule
  const char* number = "";   // letter of the number after the word in --help; "": no number
  double least = -std::numeric_limits<double>::infinity();  // least value of this number
  double most = std::numeric_limits<double>::infinity();    // largest value of this number
};

inline std::string PartitionRule::used_by() const
{
  return definition().used_by;
}
inline bool PartitionRule::adds_up() const
{
  return definition().share != nullptr;
}

/// All rules, in the order of every list.
std::span<const RuleDefinition> rule_definitions();

/// "size, contact-point, ..., uniform:P and power:Q"; `conjunction` replaces "and".
std::string list_of_rules(const std::string& conjunction = "and");

/// Names of all rules, or of the `wanted` ones. words_of_rules() also has "stock".
std::vector<std::string> words_of_rule(bool (*wanted)(const RuleDefinition&) = nullptr);
std::vector<std::string> words_of_rules();

/// The rule with the name `text`. Throws UsageError, with a list of rules, if there is none.
PartitionRule parse_rule(const std::string& text);
/// Several rules. Each text may be a list, "size,uniform:0.8"; "stock" includes all stock rules.
std::vector<PartitionRule> parse_rules(const std::vector<std::string>& texts);
/// Each rule once, in the order of first appearance.
std::vector<PartitionRule> without_repeats(const std::vector<PartitionRule>& rules);
/// Names of rules, separated by commas: "size,uniform:0.8".
std::string names_of(const std::vector<PartitionRule>& rules);

/// Shares of a contact's force (x) branch that belong to its grains i and j. They add up to 1,
/// except for a mixed contact under `drop`, and at the base, whose share belongs to no grain.
struct ContactShares {
  double i = 0, j = 0;
};

/// Shares of a contact's grains. `rule` divides a mixed contact. A contact of two grains of one
/// species is cut at the contact point. At the base (boundary grains and straight walls) the grain
/// has the share up to the contact point. Throws FormatError if the first grain is not mobile.
template <int D>
ContactShares contact_shares(const Grains& grains, const Frame<D>& frame, std::size_t contact,
                             const PartitionRule& rule);

/// The neutral model: contacts that do not depend on grain size. Contact ends are in proportion to
/// the grains' perimeter and pair at random, and the mean force is the same for all pairs. Results
/// of the model are due to geometry; a measured difference from them is due to something else.
/// Grains have their nominal sizes, with the ratio r = d_L/d_S.

/// Fraction of contact ends on large grains: x_L = phi_L/(phi_L + r phi_S).
double neutral_ends_of_large(double phi_large, double size_ratio);

/// Fraction of mixed contacts: 2 x_L x_S. For r = 2 it is 4 phi_L phi_S/(1 + phi_S)^2, with a
/// maximum of 1/2 at phi_L = 2/3 (to compare with Staron & Phillips 2015, figure 2c).
double neutral_mixed_share(double phi_large, double size_ratio);

/// The share of the larger grain of a mixed contact with nominal sizes; NaN for `drop`.
double nominal_share(const PartitionRule& rule, double size_ratio);

/// The share p* at which B = 0 for neutral contacts: r/(1 + r), 2/3 for r = 2.
double neutral_zero_share(double size_ratio);

/// B of Staron & Phillips (2015), eqs. (3) and (4), for neutral contacts of nominal sizes under a
/// rule with the share P of large grains; NaN for `drop`:
///   B(phi_L) = (P - r/(1+r)) (1+r)/(phi_L + r phi_S).
double neutral_b(const PartitionRule& rule, double size_ratio, double phi_large);

}  // namespace grseg
