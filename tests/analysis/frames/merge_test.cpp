// SPDX-License-Identifier: GPL-3.0-or-later
// Sums over parts of the frames, merged afterwards, for every accumulator.
#include "analysis/frames/composition.hpp"
#include "analysis/micro/structure_sums.hpp"
#include "analysis/stress/kinetic_stress.hpp"
#include "analysis/stress/partial_contact_stress.hpp"
#include "tests/analysis/grain_builder.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace grseg {
namespace {

const Layers layers(1, 10);

/// 60 grains, one of them boundary, up to a height that differs between frames, and contacts
/// between arbitrary pairs, some with the base.
std::vector<Packing> frames(int count)
{
  std::mt19937 random(3);
  std::uniform_real_distribution<double> any(0, 1);
  std::vector<Packing> all;
  for (int k = 0; k < count; ++k) {
    Packing packing;
    const double height = 1.5 + (k * 7 % 5);
    for (int g = 0; g < 60; ++g)
      packing.grain(g == 0       ? Species::boundary
                    : g % 3 == 0 ? Species::large
                                 : Species::small,
                    g % 3 == 0 ? 0.2 : 0.1, {10 * any(random), height * any(random)},
                    {any(random), any(random)}, any(random));
    for (int c = 1; c < 59; ++c)
      packing.contact(c, (c * 5 + 7) % 60 == c ? 0 : (c * 5 + 7) % 60, {any(random), any(random)});
    all.push_back(packing);
  }
  return all;
}

/// All results of an accumulator, as numbers.
std::vector<double> numbers(const Composition<2>& areas)
{
  std::vector<double> all;
  for (std::size_t n = 0; n < areas.layers(); ++n)
    all.insert(all.end(), {areas.mean(n)[0], areas.mean(n)[1]});
  return all;
}
std::vector<double> row_of(const KineticStress<2>& sums, std::size_t layer)
{
  return values_of(sums.cells(two_sizes(1, 2), layer));
}
template <class Sums>
std::vector<double> row_of(const Sums& sums, std::size_t layer)
{
  return sums.row(layer);
}

template <class Sums>
std::vector<double> numbers(const Sums& sums)
{
  std::vector<double> all;
  for (std::size_t n = 0; n < sums.layers(); ++n) {
    const auto row = row_of(sums, n);
    all.insert(all.end(), row.begin(), row.end());
  }
  if constexpr (requires { sums.bed_row(); }) {
    const auto row = sums.bed_row();
    all.insert(all.end(), row.begin(), row.end());
  }
  return all;
}

template <class Sums>
Sums sum(Sums sums, const std::vector<Packing>& scenes, std::size_t begin, std::size_t end)
{
  for (std::size_t k = begin; k < end; ++k) sums.add(scenes[k].grains, scenes[k].frame);
  return sums;
}

template <class Sums>
void expect_parts_make_the_whole(const Sums& empty)
{
  const auto scenes = frames(7);
  auto parts = empty;  // blocks of 2, 4 and 1 frames; the first has fewer layers than the second
  parts.merge(sum(empty, scenes, 0, 2));
  parts.merge(sum(empty, scenes, 2, 6));
  parts.merge(sum(empty, scenes, 6, 7));
  const auto expected = numbers(sum(empty, scenes, 0, 7)), found = numbers(parts);
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t k = 0; k < found.size(); ++k) {
    if (std::isnan(expected[k]))
      EXPECT_TRUE(std::isnan(found[k])) << k;
    else
      EXPECT_NEAR(found[k], expected[k], 1e-13 * (1 + std::abs(expected[k]))) << k;
  }
}

TEST(Merge, PartsOfTheContactStressMakeTheWhole)
{
  for (const auto assignment : {Assignment::contact_point, Assignment::branch, Assignment::grain})
    expect_parts_make_the_whole(PartialContactStress<2>(layers, assignment, 2.0));
}

TEST(Merge, PartsOfTheCompositionMakeTheWhole)
{
  for (const auto area : {GrainArea::clipped, GrainArea::centre})
    expect_parts_make_the_whole(Composition<2>(layers, area));
}

TEST(Merge, PartsOfTheMicrostructureMakeTheWhole)
{
  expect_parts_make_the_whole(StructureByLayer<2>(layers, GrainArea::clipped, 0.5));
}

TEST(Merge, PartsOfTheKineticStressAndItsMeanMakeTheWhole)
{
  const auto scenes = frames(7);
  const MeanVelocity<2> empty(layers, 0.25);
  const auto whole = sum(empty, scenes, 0, 7);
  auto parts = sum(empty, scenes, 0, 3);
  parts.merge(sum(empty, scenes, 3, 7));
  for (const auto flow :
       {MeanFlow::profile, MeanFlow::layer, MeanFlow::instant, MeanFlow::instant_unbiased,
        MeanFlow::profile_unbiased, MeanFlow::species}) {
    expect_parts_make_the_whole(KineticStress<2>(layers, flow, whole));
    const auto about_whole = numbers(sum(KineticStress<2>(layers, flow, whole), scenes, 0, 7));
    const auto about_parts = numbers(sum(KineticStress<2>(layers, flow, parts), scenes, 0, 7));
    ASSERT_EQ(about_parts.size(), about_whole.size());
    for (std::size_t k = 0; k < about_whole.size(); ++k)
      EXPECT_NEAR(about_parts[k], about_whole[k], 1e-13) << k;
  }
}

}  // namespace
}  // namespace grseg
