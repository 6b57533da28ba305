// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/maps/fields.hpp"

#include "analysis/frames/sums.hpp"

#include <numeric>

namespace grseg {

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

template <int D>
std::vector<Cell> flow_fields(const Vector<D>& velocity,
                              const typename KineticStress<D>::Mean& all_species)
{
  std::vector<Cell> fields;
  if (D == 3) fields.push_back({"w[m/s]", velocity[D - 1]});
  const double energy = all_species.about_mean.kinetic.trace();
  fields.push_back({"T[m^2/s^2]", ratio(energy, D * all_species.mass)});
  return fields;
}

template std::vector<Cell> flow_fields<2>(const Vec2&, const KineticStress<2>::Mean&);
template std::vector<Cell> flow_fields<3>(const Vec3&, const KineticStress<3>::Mean&);

}  // namespace grseg
