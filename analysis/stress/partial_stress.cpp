// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/stress/partial_stress.hpp"

#include "analysis/frames/sums.hpp"

#include <numeric>

namespace grseg {
namespace {

/// What contacts between mobile grains give to the species, N m, and what they give to nobody.
template <int D>
struct Shares {
  std::vector<Tensor<D>> of_species;
  Tensor<D> dropped = Tensor<D>::Zero();
};

/// Calls share(a, b, pair) for all pairs of species a < b.
template <class Share>
void for_each_pair(std::size_t species, const Share& share)
{
  for (std::size_t b = 1; b < species; ++b)
    for (std::size_t a = 0; a < b; ++a) share(a, b, pair_index(a, b));
}

template <int D>
Shares<D> without_mixed(const ContactSums<D>& sums, OwnSum own)
{
  Shares<D> shares;
  for (std::size_t k = 0; k < sums.species(); ++k) shares.of_species.push_back(sums.of(own, k));
  return shares;
}

/// Every mixed contact's share `p` goes to its larger grain.
template <int D>
Shares<D> same_for_all(const ContactSums<D>& sums, double p)
{
  auto shares = without_mixed(sums, sums.at_centres ? OwnSum::halves : OwnSum::inside);
  for_each_pair(sums.species(), [&](std::size_t a, std::size_t b, std::size_t pair) {
    auto &smaller = shares.of_species[a], &larger = shares.of_species[b];
    if (sums.at_centres) {
      smaller += (1 - p) * sums.of(PairSum::at_smaller, pair);
      larger += p * sums.of(PairSum::at_larger, pair);
    } else {
      const auto& whole = sums.of(PairSum::whole, pair);
      smaller += whole - p * whole;
      larger += p * whole;
    }
  });
  return shares;
}

template <int D>
Shares<D> shares_of(const ContactSums<D>& sums, const PartitionRule& rule)
{
  const auto& definition = rule.definition();
  if (definition.share != nullptr && !definition.sum)
    return same_for_all(sums, definition.share({}, rule.value));
  auto shares = without_mixed(sums, OwnSum::inside);
  for_each_pair(sums.species(), [&](std::size_t a, std::size_t b, std::size_t pair) {
    const auto& whole = sums.of(PairSum::whole, pair);
    if (definition.share == nullptr) {
      shares.dropped += whole;
    } else {
      const auto& of_larger = sums.of(*definition.sum, pair);
      shares.of_species[a] += whole - of_larger;
      shares.of_species[b] += of_larger;
    }
  });
  return shares;
}

template <int D>
Tensor<D> base_part(const ContactSums<D>& sums, std::size_t species, BasePart base)
{
  if (base == BasePart::contact_point) return sums.of(OwnSum::base, species);
  if (base == BasePart::half) return 0.5 * sums.of(OwnSum::whole_base, species);
  return Tensor<D>::Zero();
}

}  // namespace

template <int D>
PartialStress<D> partial_stress(const ContactSums<D>& sums, const PartitionRule& rule,
                                BasePart base, StressVolume volume)
{
  const auto shares = shares_of(sums, rule);
  const double v = volume == StressVolume::bulk
                       ? sums.volume
                       : std::accumulate(sums.content.begin(), sums.content.end(), 0.0);
  PartialStress<D> stress{{}, Tensor<D>::Zero()};
  for (const auto& own : shares.of_species) stress.total += own;
  stress.total += shares.dropped;
  for (std::size_t k = 0; k < sums.species(); ++k) {
    const Tensor<D> at_base = base_part(sums, k, base);
    stress.of_species.push_back((shares.of_species[k] + at_base) / v);
    stress.total += at_base;
  }
  stress.total /= v;
  return stress;
}

template PartialStress<2> partial_stress(const ContactSums<2>&, const PartitionRule&, BasePart,
                                         StressVolume);
template PartialStress<3> partial_stress(const ContactSums<3>&, const PartitionRule&, BasePart,
                                         StressVolume);

template <int D>
std::vector<Cell> stress_fields(const ContactSums<D>& sums, const SpeciesList& species,
                                const MapStress& how)
{
  const char* unit = D == 3 ? "[Pa]" : "[N/m]";
  const double solid = std::accumulate(sums.content.begin(), sums.content.end(), 0.0);
  std::vector<Cell> fields{{"nu", solid / sums.volume}};
  const auto words = column_words(species);
  for (std::size_t k = words.size() == 2 ? 1 : 0; k < words.size(); ++k)
    fields.push_back({"phi_" + words[k], ratio(sums.content[k], solid)});
  const Tensor<D> stress = partial_stress(sums, how.rule, how.base, how.volume).total;
  fields.push_back({std::string("pressure") + unit, stress.trace() / D});
  fields.push_back({std::string("sigma_yy") + unit, stress(1, 1)});
  fields.push_back({"stress_ratio", ratio(-stress(0, 1), stress(1, 1))});
  return fields;
}

template std::vector<Cell> stress_fields(const ContactSums<2>&, const SpeciesList&,
                                         const MapStress&);
template std::vector<Cell> stress_fields(const ContactSums<3>&, const SpeciesList&,
                                         const MapStress&);

}  // namespace grseg
