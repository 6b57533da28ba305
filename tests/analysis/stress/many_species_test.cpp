// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/frames/layer_key.hpp"
#include "analysis/stress/partial_contact_stress.hpp"
#include "analysis/stress/partial_stress.hpp"
#include "tests/analysis/grain_builder.hpp"

#include <gtest/gtest.h>

#include <random>
#include <utility>
#include <vector>

/// Stress of any number of species in two and three dimensions.
namespace grseg {
namespace {

constexpr Assignment assignments[] = {Assignment::contact_point, Assignment::branch,
                                      Assignment::kernel, Assignment::grain};
const Kernel smooth(3);

template <class Dimension>
class ManySpecies : public testing::Test {
};
using Dimensions = testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;
TYPED_TEST_SUITE(ManySpecies, Dimensions);

template <int D>
Layers layers_of(double thickness)
{
  return D == 2 ? Layers(thickness, 10) : Layers(thickness, 10, 7);
}

template <int D>
ContactSums<D> sums_of(const PackingOf<D>& packing, Assignment assignment, std::size_t species)
{
  const auto layers = layers_of<D>(1000);
  PartialContactStress<D> stress(layers, assignment, 2, smooth, species);
  stress.add(packing.grains, packing.frame);
  auto sums = stress.mean(0).sums;
  sums.volume = layers.volume(0);
  return sums;
}

/// Unit vectors, along the axes and oblique.
template <int D>
std::vector<Vector<D>> directions()
{
  if constexpr (D == 2)
    return {{1, 0}, {0, 1}, {0.6, 0.8}, {-0.28, 0.96}};
  else
    return {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0.6, 0.64, 0.48}, {-0.36, 0.48, 0.8}};
}

/// Contacts that ignore size: `ends` of each species pair at random, all with the same forces. The
/// number of ends is proportional to phi/d, for discs and for spheres.
template <int D>
PackingOf<D> neutral(const std::vector<int>& ends, const std::vector<double>& diameters)
{
  PackingOf<D> packing;
  const Vector<D> middle = Vector<D>::Constant(100);
  for (std::size_t a = 0; a < ends.size(); ++a)
    for (std::size_t b = a; b < ends.size(); ++b)
      for (int k = 0; k < (a == b ? 1 : 2) * ends[a] * ends[b]; ++k)
        for (const auto& n : directions<D>()) {
          const double reach = (diameters[a] + diameters[b]) / 2;
          const auto i = packing.grain(static_cast<Species>(a), diameters[a] / 2, middle);
          const auto j =
              packing.grain(static_cast<Species>(b), diameters[b] / 2, middle - reach * n);
          Vector<D> force = n;
          force[0] += 0.3;
          force[D - 1] -= 0.2;
          if (k % 2 == 0)
            packing.contact(i, j, force);
          else
            packing.contact(j, i, -force);
        }
  return packing;
}

// Staron & Phillips (2015): B = 0 for any sizes and any number of species.
TYPED_TEST(ManySpecies, OfNeutralContactsCarryTheirVolumeShareBySize)
{
  constexpr int D = TypeParam::value;
  const std::pair<std::vector<int>, std::vector<double>> mixtures[] = {
      {{1, 3}, {1, 2}}, {{3, 1, 4, 2, 5}, {1, 1.4, 2, 3.5, 6}}};
  for (const auto& [ends, diameters] : mixtures) {
    const auto packing = neutral<D>(ends, diameters);
    double all = 0;
    for (std::size_t s = 0; s < ends.size(); ++s) all += ends[s] * diameters[s];
    for (const auto assignment : assignments)
      for (const char* rule : {"size", "contact-point"}) {
        const auto stress =
            partial_stress(sums_of<D>(packing, assignment, ends.size()), parse_rule(rule));
        for (std::size_t s = 0; s < ends.size(); ++s) {
          const double phi = ends[s] * diameters[s] / all;
          const Tensor<D> excess = stress.of_species[s] - phi * stress.total;
          EXPECT_LT(excess.cwiseAbs().maxCoeff(), 1e-12 * stress.total.cwiseAbs().maxCoeff())
              << rule << ", species " << s;
        }
      }
    // Under half, larger species carry less than their volume share.
    const auto half = partial_stress(sums_of<D>(packing, Assignment::contact_point, ends.size()),
                                     parse_rule("half"));
    EXPECT_LT(half.of_species.back()(1, 1) / half.total(1, 1),
              ends.back() * diameters.back() / all - 0.01);
  }
}

/// Grains of five species at random positions with radii near the species' size; contacts with
/// random forces between them and with the base.
template <int D>
PackingOf<D> random_packing(unsigned seed)
{
  std::mt19937 random(seed);
  std::uniform_real_distribution<> number(-1, 1);
  PackingOf<D> packing;
  const auto vector = [&] {
    return Vector<D>(Vector<D>::NullaryExpr([&] { return number(random); }));
  };
  for (int k = 0; k < 300; ++k) {
    const int a = k % 5, b = (k / 5) % 6;
    const double r_a = (a + 1) * (1 + 0.1 * number(random)) / 2;
    const double r_b = (b + 1) * (1 + 0.1 * number(random)) / 2;
    const Vector<D> n = vector().normalized();
    Vector<D> position = Vector<D>::Constant(20) + 10 * vector();
    const auto i = packing.grain(static_cast<Species>(a), r_a, position);
    position -= (r_a + r_b) * 0.99 * n;
    const auto j =
        packing.grain(b == 5 ? Species::boundary : static_cast<Species>(b), r_b, position);
    packing.contact(i, j, 3 * n + vector());
  }
  return packing;
}

TYPED_TEST(ManySpecies, TogetherCarryTheWholeStressByEveryRuleButDrop)
{
  constexpr int D = TypeParam::value;
  const auto packing = random_packing<D>(1);
  Tensor<D> whole = Tensor<D>::Zero(), inside = whole;
  const auto& list = packing.frame.contacts;
  for (std::size_t k = 0; k < list.size(); ++k) {
    const Tensor<D> of_it = list.force[k] * list.branch[k].transpose();
    const bool at_base = !is_mobile(packing.grains, static_cast<std::size_t>(list.j[k]));
    whole += at_base ? 0 * of_it : of_it;
    const auto i = static_cast<std::size_t>(list.i[k]), j = static_cast<std::size_t>(list.j[k]);
    if (packing.grains.species[i] == packing.grains.species[j]) inside += of_it;
  }
  const double volume = layers_of<D>(1000).volume(0);
  for (const auto assignment : assignments)
    for (const char* rule : {"size", "contact-point", "half", "uniform:0.7", "power:2", "drop"}) {
      const auto stress =
          partial_stress(sums_of<D>(packing, assignment, 5), parse_rule(rule), BasePart::none);
      Tensor<D> sum = Tensor<D>::Zero();
      for (const auto& own : stress.of_species) sum += own;
      EXPECT_TRUE(same(stress.total, whole / volume, 1e-12)) << rule;
      EXPECT_TRUE(same(sum, (std::string(rule) == "drop" ? inside : whole) / volume, 1e-12))
          << rule;
    }
}

TYPED_TEST(ManySpecies, MadeOneGroupCarryWhatTheyCarriedApart)
{
  constexpr int D = TypeParam::value;
  const auto packing = random_packing<D>(2);
  auto grouped = packing;
  const std::size_t group_of[] = {0, 0, 1, 1, 1};
  for (auto& species : grouped.grains.species)
    if (species != Species::boundary)
      species = static_cast<Species>(group_of[static_cast<std::size_t>(species)]);
  for (const auto assignment : assignments)
    for (const char* word : {"size", "contact-point", "half", "power:2", "uniform:0.9"}) {
      const auto five = partial_stress(sums_of<D>(packing, assignment, 5), parse_rule(word));
      const auto two = partial_stress(sums_of<D>(grouped, assignment, 2), parse_rule(word));
      const Tensor<D> small = five.of_species[0] + five.of_species[1];
      EXPECT_TRUE(same(small, two.small(), 1e-12)) << word;
      EXPECT_GT(small.norm(), 1e-3);
    }
}

TYPED_TEST(ManySpecies, SumsComeBackFromTheirTable)
{
  constexpr int D = TypeParam::value;
  const SpeciesList species{{"fine", 1}, {"AM", 2}, {"SE-2", 3}, {"x.y", 4}, {"L", 5}};
  for (const auto assignment : {Assignment::branch, Assignment::grain}) {
    PartialContactStress<D> stress(layers_of<D>(1000), assignment, 2, smooth, 5);
    const auto packing = random_packing<D>(3);
    stress.add(packing.grains, packing.frame);
    auto sums = stress.mean(0).sums;
    sums.volume = 3;
    sums.content = {0.1, 0.2, 0.3, 0.4, 0.5};
    Table table;
    table.header = {
        {"program", "grseg-stress"}, {"species", species_text(species)}, {"power", "2"}};
    if (D == 3) table.header.insert(table.header.begin() + 1, {"dimension", "3"});
    auto names = content_columns(species, D);
    for (const auto& name : stress.columns(species)) names.push_back(name);
    table.columns = with_key_columns(D, names);
    auto cells = sums.content;
    for (const double cell : stress.row(0)) cells.push_back(cell);
    table.rows = {with_key({0, 1, 0, 1, 1, sums.volume}, cells)};
    const auto read = Table::parse(table.to_text(), "sums.tsv");
    for (const char* word : {"size", "contact-point", "half", "drop", "uniform:0.3", "power:2"}) {
      const auto rule = parse_rule(word);
      const auto back = partial_stress(ContactSumsReader(read, {rule}).read(0), rule);
      const auto here = partial_stress(sums, rule);
      for (std::size_t s = 0; s < 5; ++s)
        EXPECT_EQ(Tensor<D>(back.of_species[s].template topLeftCorner<D, D>()), here.of_species[s])
            << word << ", species " << s;
    }
  }
}

}  // namespace
}  // namespace grseg
