// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/stress/contact_sums.hpp"
#include "analysis/stress/partition_rule.hpp"
#include "formats/cli/table.hpp"

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

namespace grseg {

/// Reads the rows of a table of grseg-stress as ContactSums. FormatError, naming the column and
/// how to get it, where one is missing that `rules` need, where a number is not finite, or where an
/// area is negative. Components whose columns the table's line "not kept" names are NaN.
class ContactSumsReader {
 public:
  ContactSumsReader(const Table& table, const std::vector<PartitionRule>& rules);
  ContactSums read(std::size_t row) const;

 private:
  using Columns = std::array<std::optional<std::size_t>, tensor_components.size()>;
  struct Place {
    Tensor2 ContactSums::*sum;
    Columns columns;
  };

  const Table& table_;
  bool at_centres_ = false;
  std::size_t volume_;
  std::array<std::size_t, area_columns.size()> areas_{};
  std::vector<Place> places_;
};

}  // namespace grseg
