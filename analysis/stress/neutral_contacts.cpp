// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/stress/neutral_contacts.hpp"

#include <limits>

namespace grseg {

double neutral_ends_of_large(double phi_large, double size_ratio)
{
  return phi_large / (phi_large + size_ratio * (1 - phi_large));
}

double neutral_mixed_share(double phi_large, double size_ratio)
{
  const double x_large = neutral_ends_of_large(phi_large, size_ratio);
  return 2 * x_large * (1 - x_large);
}

double nominal_share(const PartitionRule& rule, double size_ratio)
{
  const auto share = rule.definition().share;
  if (share == nullptr) return std::numeric_limits<double>::quiet_NaN();
  return share({size_ratio, 1, neutral_zero_share(size_ratio)}, rule.value);
}

double neutral_zero_share(double size_ratio)
{
  return size_ratio / (1 + size_ratio);
}

double neutral_b(const PartitionRule& rule, double size_ratio, double phi_large)
{
  const double excess = nominal_share(rule, size_ratio) - neutral_zero_share(size_ratio);
  return excess * (1 + size_ratio) / (phi_large + size_ratio * (1 - phi_large));
}

}  // namespace grseg
