// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <unordered_map>
#include <vector>

namespace grseg {

/// Rows of the trajectory by ids of the archive.
class RowsById {
 public:
  RowsById() = default;
  explicit RowsById(const std::vector<std::int64_t>& sorted_ids);
  /// -1 where no grain has this id.
  std::int32_t find(std::int64_t id) const;

 private:
  std::int64_t first_ = 0;
  std::vector<std::int32_t> dense_;  // used where ids are close together
  std::unordered_map<std::int64_t, std::int32_t> sparse_;
};

}  // namespace grseg
