// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/stress/contact_sums.hpp"

#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

/// How the stress of contacts between a large and a small grain is shared between the species. The
/// rules are algebra on stored sums: changing one reads no contact again.
namespace grseg {

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

/// All there is to know about one kind of rule. Parsing, --help, "stock", used_by, the columns that
/// a table must have, the stresses and the neutral B follow from the table of these in
/// partition_rule.cpp.
struct RuleDefinition {
  PartitionRule::Kind kind;
  const char* word;     // as typed
  const char* meaning;  // the share, for --help
  /// The larger grain's share of a contact, `number` being what follows the word; null: the stress
  /// of mixed contacts belongs to nobody.
  double (*share)(const MixedContact& contact, double number);
  /// Where the share differs from contact to contact: the sum of the large grains' parts. Null: the
  /// share is the same for all contacts, and needs no sum but that of the whole branches.
  std::optional<PairSum> sum = {};
  /// That sum along layers: over the large grain's own stretch of the branch, beginning at its
  /// centre, or over all of the branch.
  bool along_own_stretch = false;
  const char* used_by = "";  // the codes that have this rule, "": none known
  bool stock = false;        // part of --partition stock
  const char* number = "";   // what follows the word, as --help calls it; "": nothing
  double least = -std::numeric_limits<double>::infinity();  // of that number
  double most = std::numeric_limits<double>::infinity();
};

/// In the order in which they are listed everywhere.
std::span<const RuleDefinition> rule_definitions();

/// "size, contact-point, ..., uniform:P and power:Q", with any other word for "and".
std::string list_of_rules(const std::string& conjunction = "and");

/// These words, of all rules or of those that are wanted; and with "stock", for parse_rules.
std::vector<std::string> words_of_rule(bool (*wanted)(const RuleDefinition&) = nullptr);
std::vector<std::string> words_of_rules();

/// UsageError, naming the rules, where `text` is none.
PartitionRule parse_rule(const std::string& text);
/// Several rules; each text may be a list "size,uniform:0.8", in which "stock" stands for all that
/// are marked so.
std::vector<PartitionRule> parse_rules(const std::vector<std::string>& texts);

}  // namespace grseg
