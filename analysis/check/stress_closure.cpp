// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/check/stress_closure.hpp"

#include "analysis/frames/layers.hpp"
#include "analysis/stress/partial_contact_stress.hpp"
#include "analysis/stress/partial_stress.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace grseg {
namespace {

double largest_component(const Tensor2& t)
{
  return t.cwiseAbs().maxCoeff();
}

/// x_i - x_j of the nearest image, m; at a straight wall the branch.
Vec2 between_centres(const Frame<2>& frame, const Box& box, std::size_t contact)
{
  const auto j = frame.contacts.j[contact];
  if (j < 0) return frame.contacts.branch[contact];
  Vec2 apart = frame.position[static_cast<std::size_t>(frame.contacts.i[contact])] -
               frame.position[static_cast<std::size_t>(j)];
  if (box.periodic_x) apart.x() -= box.length_x * std::round(apart.x() / box.length_x);
  return apart;
}

/// Sums over the contact ends on small and on large grains, N m.
std::array<Tensor2, 2> sums_of_ends(const Grains& grains, const Frame<2>& frame, const Box& box)
{
  std::array<Tensor2, 2> sums{Tensor2::Zero(), Tensor2::Zero()};
  const auto& contacts = frame.contacts;
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    const Tensor2 whole = contacts.force[c] * between_centres(frame, box, c).transpose();
    const double share = share_of_first(grains, contacts, c);
    const auto add_end = [&](std::int32_t grain, double part) {
      const auto g = static_cast<std::size_t>(grain);
      if (grain >= 0 && is_mobile(grains, g))
        sums[static_cast<std::size_t>(grains.species[g])] += part * whole;
    };
    add_end(contacts.i[c], share);
    add_end(contacts.j[c], 1 - share);
  }
  return sums;
}

}  // namespace

void StressClosure::add(const Grains& grains, const Frame<2>& frame)
{
  // One layer that holds the whole bed.
  constexpr double higher_than_any_bed = 1e6;  // m
  PartialContactStress<2> stress(Layers(higher_than_any_bed, 1), Assignment::contact_point);
  stress.add(grains, frame);
  auto sums = stress.mean(0).sums;
  sums.volume = 1;
  const auto by_contact = partial_stress(sums, {PartitionRule::Kind::contact_point});
  const auto by_size = partial_stress(sums, {PartitionRule::Kind::size});
  const auto [small, large] = sums_of_ends(grains, frame, box_);

  const double scale = largest_component(by_contact.total);
  const double defect = std::max(
      {largest_component(small + large - by_contact.total),
       largest_component(small - by_contact.small()), largest_component(large - by_contact.large()),
       largest_component(by_size.small() + by_size.large() - by_size.total)});
  defect_.add(scale > 0 ? defect / scale : defect, frame.time, 0);
}

}  // namespace grseg
