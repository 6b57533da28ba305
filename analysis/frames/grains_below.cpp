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

/// Removes contacts of absent grains.
template <int D>
void remove_contacts(const Grains& grains, Frame<D>& frame, ContactsAcross across)
{
  const auto is_absent = [&](std::int32_t grain) {
    return grain >= 0 && !is_present(frame, static_cast<std::size_t>(grain));
  };
  const auto is_of_bed = [&](std::int32_t grain) {
    return grain >= 0 && is_mobile(grains, frame, static_cast<std::size_t>(grain));
  };
  const auto all = std::exchange(frame.contacts, {});
  for (std::size_t k = 0; k < all.size(); ++k) {
    const auto i = all.i[k], j = all.j[k];
    const bool left = is_absent(i);
    if ((left || is_absent(j)) && across == ContactsAcross::removed) continue;
    if (left && !is_of_bed(j)) continue;
    frame.contacts.i.push_back(left ? j : i);
    frame.contacts.j.push_back(left ? i : j);
    frame.contacts.force.push_back(left ? -all.force[k] : all.force[k]);
    frame.contacts.branch.push_back(left ? -all.branch[k] : all.branch[k]);
    frame.contacts.gap.push_back(all.gap[k]);
  }
}

}  // namespace

template <int D>
std::size_t remove_grains_below(const Grains& grains, Frame<D>& frame, ContactsAcross across)
{
  const double bottom = bottom_of_bed(grains, frame);
  std::size_t removed = 0;
  for (std::size_t g = 0; g < grains.size(); ++g) {
    if (!is_mobile(grains, g) || !(frame.position[g].y() < bottom)) continue;
    make_absent(frame, g);
    ++removed;
  }
  if (removed > 0) remove_contacts(grains, frame, across);
  return removed;
}

template std::size_t remove_grains_below(const Grains&, Frame<2>&, ContactsAcross);
template std::size_t remove_grains_below(const Grains&, Frame<3>&, ContactsAcross);

}  // namespace grseg
