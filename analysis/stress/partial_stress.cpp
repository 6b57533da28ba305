// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/stress/partial_stress.hpp"

namespace grseg {
namespace {

/// What contacts between mobile grains give to the species, N m, and what they give to nobody.
struct Shares {
  Tensor2 small, large, dropped = Tensor2::Zero();
};

/// Every mixed contact's share `p` goes to its large grain.
Shares same_for_all(const ContactSums& sums, double p)
{
  if (!sums.at_centres) return {sums.ss + (sums.mixed - p * sums.mixed), sums.ll + p * sums.mixed};
  return {sums.halves_ss + (1 - p) * sums.mixed_at_small, sums.halves_ll + p * sums.mixed_at_large};
}

Shares shares(const ContactSums& sums, const PartitionRule& rule)
{
  const auto& definition = rule.definition();
  if (definition.share == nullptr) return {sums.ss, sums.ll, sums.mixed};
  if (definition.sum == nullptr) return same_for_all(sums, definition.share({}, rule.value));
  const Tensor2& of_large = sums.*definition.sum;
  return {sums.ss + (sums.mixed - of_large), sums.ll + of_large};
}

}  // namespace

PartialStress partial_stress(const ContactSums& sums, const PartitionRule& rule, BasePart base,
                             StressVolume volume)
{
  Tensor2 base_small = Tensor2::Zero(), base_large = Tensor2::Zero();
  if (base == BasePart::contact_point) {
    base_small = sums.base_small;
    base_large = sums.base_large;
  } else if (base == BasePart::half) {
    base_small = 0.5 * sums.whole_small;
    base_large = 0.5 * sums.whole_large;
  }
  const auto [small, large, dropped] = shares(sums, rule);
  const double v = volume == StressVolume::bulk ? sums.volume : sums.area_small + sums.area_large;
  return {.small = (small + base_small) / v,
          .large = (large + base_large) / v,
          .total = (small + large + dropped + base_small + base_large) / v};
}

}  // namespace grseg
