// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/stress/contact_shares.hpp"

#include "formats/core/pair_type.hpp"

namespace grseg {

template <int D>
ContactShares contact_shares(const Grains& grains, const Frame<D>& frame, std::size_t contact,
                             const PartitionRule& rule)
{
  const auto [i, j] = partners(grains, frame, contact);
  const double up_to_contact = share_of_first(grains, frame.contacts, contact);
  if (!j) return {up_to_contact, 0};
  const auto a = grains.species[i], b = grains.species[*j];
  if (a == b) return {up_to_contact, 1 - up_to_contact};
  const auto& definition = rule.definition();
  if (definition.share == nullptr) return {0, 0};
  const bool i_large = a > b;
  const double r_i = grains.radius[i], r_j = grains.radius[*j];
  const MixedContact mixed{i_large ? r_i : r_j, i_large ? r_j : r_i,
                           i_large ? up_to_contact : 1 - up_to_contact};
  const double to_large = definition.share(mixed, rule.value);
  return i_large ? ContactShares{to_large, 1 - to_large} : ContactShares{1 - to_large, to_large};
}

template ContactShares contact_shares(const Grains&, const Frame<2>&, std::size_t,
                                      const PartitionRule&);
template ContactShares contact_shares(const Grains&, const Frame<3>&, std::size_t,
                                      const PartitionRule&);

}  // namespace grseg
