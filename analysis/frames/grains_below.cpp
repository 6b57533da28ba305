// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/frames/grains_below.hpp"

#include <algorithm>
#include <utility>

namespace grseg {
namespace {

/// Height below which grains have left the bed, m.
template <int D>
double bottom_of_bed(const Grains& grains, const Frame<D>& frame)
{
  double largest = 0, bottom = 0;
  for (std::size_t g = 0; g < grains.size(); ++g) {
    if (is_mobile(grains, g))
      largest = std::max(largest, 2 * grains.radius[g]);
    else if (is_present(frame, g))
      bottom = std::min(bottom, frame.position[g].y());
  }
  return std::min(bottom, -largest);
}

/// Removes the contacts for which `counts` returns false of one of their grains.
template <int D, class Counts>
void keep_contacts(ContactList<D>& contacts, const Counts& counts)
{
  const auto all = std::exchange(contacts, {});
  for (std::size_t k = 0; k < all.size(); ++k) {
    if (!counts(all.i[k]) || (all.j[k] >= 0 && !counts(all.j[k]))) continue;
    contacts.i.push_back(all.i[k]);
    contacts.j.push_back(all.j[k]);
    contacts.force.push_back(all.force[k]);
    contacts.branch.push_back(all.branch[k]);
    contacts.gap.push_back(all.gap[k]);
  }
}

}  // namespace

template <int D>
std::size_t remove_grains_below(const Grains& grains, Frame<D>& frame)
{
  const double bottom = bottom_of_bed(grains, frame);
  std::size_t removed = 0;
  for (std::size_t g = 0; g < grains.size(); ++g) {
    if (!is_mobile(grains, g) || !(frame.position[g].y() < bottom)) continue;
    make_absent(frame, g);
    ++removed;
  }
  if (removed > 0)
    keep_contacts(frame.contacts, [&](std::int32_t grain) {
      return is_present(frame, static_cast<std::size_t>(grain));
    });
  return removed;
}

template std::size_t remove_grains_below(const Grains&, Frame<2>&);
template std::size_t remove_grains_below(const Grains&, Frame<3>&);

}  // namespace grseg
