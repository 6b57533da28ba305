// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/import/verify/listed_pairs.hpp"

#include <algorithm>

namespace grseg {

template <int D>
ListedPairs::ListedPairs(const ContactList<D>& contacts, bool pushing_only)
{
  const auto for_each = [&](const auto& use) {
    for (std::size_t c = 0; c < contacts.size(); ++c) {
      if (pushing_only && contacts.force[c].isZero(0)) continue;
      const auto [low, high] = std::minmax(contacts.i[c], contacts.j[c]);
      use(low, static_cast<std::size_t>(high));
    }
  };
  begins_.push_back(0);
  for_each([&](std::int32_t, std::size_t high) {
    if (begins_.size() < high + 2) begins_.resize(high + 2);
    ++begins_[high + 1];
  });
  for (std::size_t g = 1; g < begins_.size(); ++g) begins_[g] += begins_[g - 1];
  lower_.resize(begins_.back());
  auto next = begins_;
  for_each([&](std::int32_t low, std::size_t high) { lower_[next[high]++] = low; });
  for (std::size_t g = 1; g < begins_.size(); ++g)
    std::sort(lower_.data() + begins_[g - 1], lower_.data() + begins_[g]);
}

bool ListedPairs::contains(std::int32_t i, std::int32_t j) const
{
  const auto [low, high] = std::minmax(i, j);
  const auto g = static_cast<std::size_t>(high);
  if (g + 1 >= begins_.size()) return false;
  return std::binary_search(lower_.data() + begins_[g], lower_.data() + begins_[g + 1], low);
}

std::optional<ListedPairs::Pair> ListedPairs::twice() const
{
  for (std::size_t g = 1; g < begins_.size(); ++g) {
    const auto* end = lower_.data() + begins_[g];
    const auto* found = std::adjacent_find(lower_.data() + begins_[g - 1], end);
    if (found != end) return Pair(*found, static_cast<std::int32_t>(g - 1));
  }
  return std::nullopt;
}

template ListedPairs::ListedPairs(const ContactList<2>&, bool);
template ListedPairs::ListedPairs(const ContactList<3>&, bool);

}  // namespace grseg
