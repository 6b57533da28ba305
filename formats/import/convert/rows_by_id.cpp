// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/import/convert/rows_by_id.hpp"

namespace grseg {

RowsById::RowsById(const std::vector<std::int64_t>& ids)
{
  first_ = ids.front();
  const auto span = static_cast<std::uint64_t>(ids.back() - ids.front()) + 1;
  if (span <= 8 * ids.size() + 1024) dense_.assign(span, -1);
  for (std::size_t row = 0; row < ids.size(); ++row) {
    if (dense_.empty())
      sparse_[ids[row]] = static_cast<std::int32_t>(row);
    else
      dense_[static_cast<std::size_t>(ids[row] - first_)] = static_cast<std::int32_t>(row);
  }
}

std::int32_t RowsById::find(std::int64_t id) const
{
  if (dense_.empty()) {
    const auto found = sparse_.find(id);
    return found == sparse_.end() ? -1 : found->second;
  }
  const auto place = static_cast<std::uint64_t>(id - first_);
  return id < first_ || place >= dense_.size() ? -1 : dense_[place];
}

}  // namespace grseg
