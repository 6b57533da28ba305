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

/// How the stress of contacts between a large and a small grain is shared between the species. The
/// rules are algebra on stored sums: changing one reads no contact again.

struct RuleDefinition;

/// The share of a mixed contact that goes to its large grain; the small one gets the rest.
struct PartitionRule {
  enum class Kind { size, contact_point, half, drop, uniform, power };
  Kind kind = Kind::size;
  double value = 0;  // P of uniform:P, Q of power:Q

  const RuleDefinition& definition() const;
  /// As it is typed: "size", "uniform:0.8".
  std::string name() const;
  /// The codes that share mixed contacts so; "" where none is known.
  std::string used_by() const;
  /// Species stresses add up to the whole: false for `drop` alone.
  bool adds_up() const;
  bool operator==(const PartitionRule&) const = default;
};

/// A contact between a large and a small grain, as rules see it.
struct MixedContact {
  double r_large, r_small;  // m, or in any common unit
  double up_to_contact;     // share of the branch between the large grain's centre and the contact
};
/// The contact between grains i and j of different species, of which i has `share_i` of the branch.
MixedContact mixed_contact(const Grains& grains, std::size_t i, std::size_t j, double share_i);

/// Definition of one kind of rule. Parsing, --help, "stock", used_by, the columns that a table must
/// have, the stresses and the neutral B follow from the table of these in partition_rule.cpp.
struct RuleDefinition {
  PartitionRule::Kind kind;
  const char* word;     // as typed
  const char* meaning;  // the share, for --help
  /// The larger grain's share of a contact, `number` being what follows the word; null: the stress
  /// of mixed contacts belongs to nobody.
  double (*share)(const MixedContact& contact, double number);
  /// Sum of the large grains' parts, where the share differs from contact to contact. Null: the
  /// share is the same for all contacts, and needs only the sum of the whole branches.
  std::optional<PairSum> sum = {};
  /// True where this sum is spread over layers along the large grain's own stretch of the branch,
  /// which begins at its centre; else it is spread along the whole branch.
  bool along_own_stretch = false;
  const char* used_by = "";  // the codes that have this rule, "": none known
  bool stock = false;        // part of --partition stock
  const char* number = "";   // what follows the word, as --help calls it; "": nothing
  double least = -std::numeric_limits<double>::infinity();  // of that number
  double most = std::numeric_limits<double>::infinity();
};

inline std::string PartitionRule::used_by() const
{
  return definition().used_by;
}
inline bool PartitionRule::adds_up() const
{
  return definition().share != nullptr;
}

/// In the order in which they are listed everywhere.
std::span<const RuleDefinition> rule_definitions();

/// "size, contact-point, ..., uniform:P and power:Q", with any other word for "and".
std::string list_of_rules(const std::string& conjunction = "and");

/// Words of all rules, or of the `wanted` ones; words_of_rules() adds "stock", for parse_rules.
std::vector<std::string> words_of_rule(bool (*wanted)(const RuleDefinition&) = nullptr);
std::vector<std::string> words_of_rules();

/// UsageError, naming the rules, where `text` is none.
PartitionRule parse_rule(const std::string& text);
/// Several rules; each text may be a list "size,uniform:0.8", in which "stock" stands for all that
/// are marked so.
std::vector<PartitionRule> parse_rules(const std::vector<std::string>& texts);
/// Each rule once, in order.
std::vector<PartitionRule> without_repeats(const std::vector<PartitionRule>& rules);
/// "size,uniform:0.8".
std::string names_of(const std::vector<PartitionRule>& rules);

/// The parts of a contact's force (x) branch that belong to its grains i and j. They add up to 1,
/// but where `drop` leaves a mixed contact out, and at the base, whose part is nobody's.
struct ContactShares {
  double i = 0, j = 0;
};

/// A mixed contact is shared by `rule`; one of two grains of a species is cut where they touch; at
/// the base (boundary grains and straight walls) the grain has the part up to the contact point.
/// FormatError where the contact's first grain is not mobile.
template <int D>
ContactShares contact_shares(const Grains& grains, const Frame<D>& frame, std::size_t contact,
                             const PartitionRule& rule);

/// The neutral model: contacts that ignore grain size. Contact ends are in proportion to the
/// grains' perimeter, they pair at random, and the mean force is the same for all pairs. Whatever
/// it gives is geometry; a measured departure from it is not. Grains have their nominal sizes, r =
/// d_L/d_S.

/// Share of the contact ends that large grains have: x_L = phi_L/(phi_L + r phi_S).
double neutral_ends_of_large(double phi_large, double size_ratio);

/// Share of mixed contacts: 2 x_L x_S. For r = 2 it is 4 phi_L phi_S/(1 + phi_S)^2, at most 1/2, at
/// phi_L = 2/3 (beside Staron & Phillips 2015, figure 2c).
double neutral_mixed_share(double phi_large, double size_ratio);

/// The share that goes to the larger of two grains of nominal sizes; NaN for `drop`.
double nominal_share(const PartitionRule& rule, double size_ratio);

/// p* of neutral contacts, the share at which B = 0: r/(1 + r), 2/3 for r = 2.
double neutral_zero_share(double size_ratio);

/// B of Staron & Phillips (2015), eqs. (3) and (4), for neutral contacts under a rule that gives
/// all mixed contacts of nominal sizes the share P; NaN for `drop`:
///   B(phi_L) = (P - r/(1+r)) (1+r)/(phi_L + r phi_S).
double neutral_b(const PartitionRule& rule, double size_ratio, double phi_large);

}  // namespace grseg
