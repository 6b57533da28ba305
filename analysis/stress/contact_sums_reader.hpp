// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/stress/contact_sums.hpp"
#include "analysis/stress/partition_rule.hpp"
#include "formats/cli/table.hpp"

#include <array>
#include <cstddef>
#include <vector>

namespace grseg {

/// Reads the rows of a table of grseg-stress as ContactSums. FormatError, naming the column and
/// how to get it, where one is missing that `rules` need, or where a number is not finite.
class ContactSumsReader {
 public:
  ContactSumsReader(const Table& table, const std::vector<PartitionRule>& rules);
  ContactSums read(std::size_t row) const;

 private:
  struct Place {
    Tensor2 ContactSums::*sum;
    std::array<std::size_t, tensor_components.size()> columns;
  };

  const Table& table_;
  bool at_centres_ = false;
  std::size_t volume_;
  std::array<std::size_t, area_columns.size()> areas_{};
  std::vector<Place> places_;
};

}  // namespace grseg
