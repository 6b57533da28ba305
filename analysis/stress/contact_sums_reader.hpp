// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/stress/contact_sums.hpp"
#include "analysis/stress/partition_rule.hpp"
#include "formats/cli/table.hpp"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace grseg {

/// Reads the rows of a table of grseg-stress as ContactSums of its species; those of a table in two
/// dimensions have zeros in z. FormatError, naming the column and how to get it, where one is missing
/// that `rules` need, where a number is not finite, or where an area or volume of grains is negative.
/// Components whose columns the table's line "not kept" names are NaN.
class ContactSumsReader {
 public:
  ContactSumsReader(const Table& table, const std::vector<PartitionRule>& rules);
  ContactSums<3> read(std::size_t row) const;
  const SpeciesList& species() const { return species_; }

 private:
  struct Place {
    NamedSum sum;
    std::vector<std::optional<std::size_t>> columns;  // by component; nothing: not kept
  };
  bool is_at_centres() const;
  void add_columns(InTables in, const std::vector<PartitionRule>& rules, const std::string& remedy);

  const Table& table_;
  SpeciesList species_;
  std::vector<TensorComponent> components_;
  bool at_centres_ = false;
  std::size_t volume_;
  std::vector<std::size_t> contents_;
  std::vector<Place> places_;
};

}  // namespace grseg
