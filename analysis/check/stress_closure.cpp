// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/check/stress_closure.hpp"

#include "analysis/frames/layers.hpp"
#include "analysis/stress/partial_contact_stress.hpp"
#include "analysis/stress/partial_stress.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace grseg {
namespace {

template <int D>
double largest_component(const Tensor<D>& t)
{
  return t.cwiseAbs().maxCoeff();
}

/// x_i - x_j of the nearest image, m; at a straight wall the branch.
template <int D>
Vector<D> between_centres(const Frame<D>& frame, const Box& box, std::size_t contact)
{
  const auto j = frame.contacts.j[contact];
  if (j < 0) return frame.contacts.branch[contact];
  Vector<D> apart = frame.position[static_cast<std::size_t>(frame.contacts.i[contact])] -
                    frame.position[static_cast<std::size_t>(j)];
  const auto wrap = [](double& along, double length) {
    along -= length * std::round(along / length);
  };
  if (box.periodic_x) wrap(apart.x(), box.length_x);
  if constexpr (D == 3)
    if (box.periodic_z) wrap(apart.z(), box.length_z);
  return apart;
}

/// Sums over the contact ends on the grains of each species, N m.
template <int D>
std::vector<Tensor<D>> sums_of_ends(const Grains& grains, const Frame<D>& frame, const Box& box,
                                    std::size_t species)
{
  std::vector<Tensor<D>> sums(species, Tensor<D>::Zero());
  const auto& contacts = frame.contacts;
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    const Tensor<D> whole = contacts.force[c] * between_centres(frame, box, c).transpose();
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

template <int D>
Tensor<D> sum_of(const std::vector<Tensor<D>>& tensors)
{
  Tensor<D> sum = Tensor<D>::Zero();
  for (const auto& tensor : tensors) sum += tensor;
  return sum;
}

}  // namespace

template <int D>
void StressClosure<D>::add(const Grains& grains, const Frame<D>& frame)
{
  // One layer that holds the whole bed.
  constexpr double higher_than_any_bed = 1e6;  // m
  PartialContactStress<D> stress(Layers(higher_than_any_bed, 1), Assignment::contact_point, {}, {},
                                 species_);
  stress.add(grains, frame);
  auto sums = stress.mean(0).sums;
  sums.volume = 1;
  const auto by_contact = partial_stress(sums, {PartitionRule::Kind::contact_point});
  const auto by_size = partial_stress(sums, {PartitionRule::Kind::size});
  const auto ends = sums_of_ends(grains, frame, box_, species_);

  const double scale = largest_component<D>(by_contact.total);
  double defect = std::max(largest_component<D>(sum_of<D>(ends) - by_contact.total),
                           largest_component<D>(sum_of<D>(by_size.of_species) - by_size.total));
  for (std::size_t s = 0; s < species_; ++s)
    defect = std::max(defect, largest_component<D>(ends[s] - by_contact.of_species[s]));
  defect_.add(scale > 0 ? defect / scale : defect, frame.time, 0);
}

template class StressClosure<2>;
template class StressClosure<3>;

}  // namespace grseg
