// SPDX-License-Identifier: GPL-3.0-or-later
// The neutral contact model as lists of contacts: stresses that large and small grains carry if
// nothing but their size distinguishes them.
#include "analysis/frames/composition.hpp"
#include "analysis/stress/partial_contact_stress.hpp"
#include "analysis/stress/partial_stress.hpp"
#include "analysis/stress/partition_rule.hpp"
#include "tests/analysis/grain_builder.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace grseg {
namespace {

const Layers thick_layers(100, 10);
constexpr double small_radius = 0.5;

/// Adds pairs as in random pairing, where of a + b contact ends a belong to large grains. All have
/// the same forces, in every direction, about the middle of a thick layer.
void add_layer(Packing& packing, int layer, int a, int b, int r)
{
  constexpr int directions = 7;
  const double y = 100 * layer + 50;
  const double radius[] = {small_radius, r * small_radius};
  const Species species[] = {Species::small, Species::large};
  const int pairs[][3] = {{1, 1, a * a}, {1, 0, a * b}, {0, 1, a * b}, {0, 0, b * b}};
  for (const auto& [first, second, number] : pairs)
    for (int k = 0; k < number * directions; ++k) {
      const double angle = 2 * std::numbers::pi * (k % directions) / directions + 0.1;
      const Vec2 normal{std::cos(angle), std::sin(angle)}, tangent{-normal.y(), normal.x()};
      const auto j = packing.grain(species[second], radius[second], {5, y});
      const auto i = packing.grain(species[first], radius[first],
                                   Vec2(5, y) + (radius[first] + radius[second]) * normal);
      packing.contact(i, j, (1 + 0.3 * std::sin(angle)) * normal + 0.2 * tangent);
    }
  // A large grain has r times the contact ends of a small one. Here each grain with ends has one,
  // so (r - 1)/r of the small grains have none.
  for (int k = 0; k < (r - 1) * 2 * b * (a + b) * directions; ++k)
    packing.grain(Species::small, small_radius, {5, y});
}

/// B of one layer: psi_L = phi_L (1 + B phi_S).
double b_of(const PartialStress<2>& stress, const std::vector<double>& areas)
{
  const double phi = phi_large(areas);
  return (stress.large()(1, 1) / stress.total(1, 1) - phi) / (phi * (1 - phi));
}

TEST(NeutralContacts, LargeGrainsCarryTheirShareBySizeAndByOtherRulesWhatTheFormulaSays)
{
  const int ends[][2] = {{1, 3}, {1, 1}, {2, 1}};
  for (const int r : {2, 3}) {
    Packing packing;
    for (int layer = 0; layer < 3; ++layer)
      add_layer(packing, layer, ends[layer][0], ends[layer][1], r);
    for (const auto assignment :
         {Assignment::contact_point, Assignment::branch, Assignment::grain, Assignment::kernel}) {
      const bool by_kernel = assignment == Assignment::kernel;
      const Kernel kernel(4);
      Composition<2> composition(thick_layers, by_kernel ? GrainArea::kernel : GrainArea::clipped,
                                 kernel);
      PartialContactStress<2> stress(thick_layers, assignment, 2, kernel);
      composition.add(packing.grains, packing.frame);
      stress.add(packing.grains, packing.frame);
      for (std::size_t n = 0; n < 3; ++n) {
        const auto areas = composition.mean(n);
        // phi_L/phi_S = r x_L/x_S, as ends are in proportion to perimeter.
        EXPECT_NEAR(areas[1] / areas[0], static_cast<double>(r * ends[n][0]) / ends[n][1], 1e-12);
        auto sums = stress.mean(n).sums;
        sums.volume = thick_layers.volume(0);
        for (const auto& rule : parse_rules(
                 {"size", "contact-point", "half", "uniform:0.8", "uniform:0.6", "power:2"})) {
          const double b = b_of(partial_stress(sums, rule), areas);
          EXPECT_NEAR(b, neutral_b(rule, r, phi_large(areas)), 1e-12) << rule.name();
          if (rule.kind == PartitionRule::Kind::size) {
            EXPECT_NEAR(b, 0, 1e-12);
          }
          if (rule.kind == PartitionRule::Kind::uniform && r == 2) {
            EXPECT_NEAR(b, (rule.value - 2.0 / 3) * 3 / (2 - phi_large(areas)), 1e-12);
          }
        }
      }
    }
  }
}

}  // namespace
}  // namespace grseg
