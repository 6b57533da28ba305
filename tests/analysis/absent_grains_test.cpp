// SPDX-License-Identifier: GPL-3.0-or-later
// Absent grains have no effect: every result from frames with absent grains is equal, to the last
// bit, to the result from frames that contain only the present grains.
#include "analysis/balance/momentum_balance.hpp"
#include "analysis/check/laws_of_motion.hpp"
#include "analysis/check/weight_balance.hpp"
#include "analysis/frames/map_grid.hpp"
#include "analysis/micro/structure_sums.hpp"
#include "analysis/segregation/flux.hpp"
#include "analysis/stress/kinetic_stress.hpp"
#include "tests/analysis/contact_packings.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace grseg {
namespace {

constexpr double step = 1e-3;
const Vec2 gravity{3, -9};

/// A heap at time `t` in which grains turn, move and are pulled.
Packing heap_at(double t)
{
  auto packing = heap();
  auto& frame = packing.frame;
  frame.step = std::llround(t / step);
  frame.time = t;
  const auto n = packing.grains.size();
  frame.image.assign(n, {});
  frame.force.assign(n, Vec2::Zero());
  std::mt19937 random(static_cast<unsigned>(frame.step));
  std::uniform_real_distribution<double> number(-1, 1);
  for (std::size_t g = 0; g < n; ++g) {
    frame.position[g].y() += 0.1 * t * number(random);
    frame.velocity[g] = {1 + number(random), number(random)};
    frame.angular_velocity[g] = number(random);
    frame.force[g] = {number(random), number(random)};
  }
  return packing;
}

/// Removes the contacts of absent grains; rows of grains stay.
void remove_contacts_of_absent(Frame<2>& frame)
{
  const ContactList<2> all = std::exchange(frame.contacts, {});
  for (std::size_t k = 0; k < all.size(); ++k) {
    if (!is_present(frame, static_cast<std::size_t>(all.i[k])) ||
        !is_present(frame, static_cast<std::size_t>(all.j[k])))
      continue;
    frame.contacts.i.push_back(all.i[k]);
    frame.contacts.j.push_back(all.j[k]);
    frame.contacts.force.push_back(all.force[k]);
    frame.contacts.branch.push_back(all.branch[k]);
    frame.contacts.gap.push_back(all.gap[k]);
  }
}

Packing without(Packing packing, const std::vector<std::size_t>& rows)
{
  for (const auto g : rows) make_absent(packing.frame, g);
  remove_contacts_of_absent(packing.frame);
  return packing;
}

/// Grains as above, without rows for absent ones.
Packing compacted(const Packing& packing)
{
  Packing rest;
  const auto& [grains, frame] = packing;
  rest.frame.step = frame.step;
  rest.frame.time = frame.time;
  std::vector<std::int32_t> row(grains.size(), -1);
  for (std::size_t g = 0; g < grains.size(); ++g) {
    if (!is_present(frame, g)) continue;
    row[g] = static_cast<std::int32_t>(rest.grains.size());
    rest.grains.id.push_back(grains.id[g]);
    rest.grains.species.push_back(grains.species[g]);
    rest.grains.radius.push_back(grains.radius[g]);
    rest.grains.mass.push_back(grains.mass[g]);
    rest.grains.fixed.push_back(grains.fixed[g]);
    rest.frame.position.push_back(frame.position[g]);
    rest.frame.image.push_back(frame.image[g]);
    rest.frame.velocity.push_back(frame.velocity[g]);
    rest.frame.angular_velocity.push_back(frame.angular_velocity[g]);
    rest.frame.force.push_back(frame.force[g]);
  }
  rest.frame.contacts = frame.contacts;
  for (auto& i : rest.frame.contacts.i) i = row[static_cast<std::size_t>(i)];
  for (auto& j : rest.frame.contacts.j) j = row[static_cast<std::size_t>(j)];
  return rest;
}

/// Three frames: grains 0 (large), 2 and 5 (small) are absent in the second one, grains 5 and 11
/// (boundary) in the third one.
std::vector<Packing> with_absent_grains()
{
  return {heap_at(1), without(heap_at(1.5), {0, 2, 5}), without(heap_at(2), {5, 11})};
}

/// Sums of `quantity` over the frames, as numbers: with rows for absent grains, and without these rows.
template <class Quantity, class Numbers>
void expect_equal(const Quantity& nothing, const Numbers& numbers_of)
{
  auto with_rows = nothing, without_rows = nothing;
  for (const auto& packing : with_absent_grains()) {
    with_rows.add(packing.grains, packing.frame);
    const auto others = compacted(packing);
    without_rows.add(others.grains, others.frame);
  }
  const std::vector<double> a = numbers_of(with_rows), b = numbers_of(without_rows);
  ASSERT_EQ(a.size(), b.size());
  ASSERT_FALSE(a.empty());
  bool any = false;
  for (std::size_t k = 0; k < a.size(); ++k) {
    EXPECT_TRUE(a[k] == b[k] || (std::isnan(a[k]) && std::isnan(b[k])))
        << k << ": " << a[k] << " " << b[k];
    any = any || (a[k] != 0 && !std::isnan(a[k]));
  }
  EXPECT_TRUE(any) << "there is nothing to compare";
}

template <class Values>
void append(std::vector<double>& to, const Values& values)
{
  to.insert(to.end(), values.begin(), values.end());
}

/// Rows of all layers.
template <class Quantity>
std::vector<double> rows_of(const Quantity& quantity)
{
  std::vector<double> numbers;
  for (std::size_t n = 0; n < quantity.layers(); ++n) append(numbers, quantity.row(n));
  return numbers;
}

TEST(AbsentGrains, HaveNoPartInTheCompositionOfALayer)
{
  for (const auto rule : {GrainArea::clipped, GrainArea::centre, GrainArea::kernel})
    expect_equal(Composition<2>(unit_layers, rule, smooth), [](const Composition<2>& composition) {
      std::vector<double> numbers;
      for (std::size_t n = 0; n < composition.layers(); ++n) append(numbers, composition.mean(n));
      return numbers;
    });
}

TEST(AbsentGrains, HaveNoPartInTheContactStress)
{
  for (const auto assignment : all_assignments)
    expect_equal(PartialContactStress<2>(unit_layers, assignment, std::nullopt, smooth),
                 rows_of<PartialContactStress<2>>);
}

/// Quantities relative to the mean flow of the same frames.
template <class Frames>
MeanVelocity<2> mean_of(const Frames& frames)
{
  MeanVelocity<2> mean(unit_layers, 0.5, 2);
  for (const auto& packing : frames) mean.add(packing.grains, packing.frame);
  return mean;
}

TEST(AbsentGrains, HaveNoPartInTheMeanVelocityAndTheKineticStress)
{
  auto compact = with_absent_grains();
  for (auto& packing : compact) packing = compacted(packing);
  for (const auto flow :
       {MeanFlow::profile, MeanFlow::layer, MeanFlow::instant, MeanFlow::instant_unbiased,
        MeanFlow::profile_unbiased, MeanFlow::species}) {
    KineticStress<2> with_rows(unit_layers, flow, mean_of(with_absent_grains()));
    KineticStress<2> without_rows(unit_layers, flow, mean_of(compact));
    for (const auto& packing : with_absent_grains()) with_rows.add(packing.grains, packing.frame);
    for (const auto& packing : compact) without_rows.add(packing.grains, packing.frame);
    ASSERT_EQ(with_rows.layers(), without_rows.layers());
    for (std::size_t n = 0; n < with_rows.layers(); ++n) {
      const auto a = with_rows.cells(two_sizes(1, 2), n),
                 b = without_rows.cells(two_sizes(1, 2), n);
      for (std::size_t k = 0; k < a.size(); ++k)
        EXPECT_TRUE(a[k].value == b[k].value || (std::isnan(a[k].value) && std::isnan(b[k].value)))
            << a[k].column << " of layer " << n;
    }
  }
}

TEST(AbsentGrains, HaveNoPartInTheStructure)
{
  expect_equal(StructureByLayer<2>(unit_layers, GrainArea::clipped, 0.5),
               [](const StructureByLayer<2>& structure) {
                 auto numbers = rows_of(structure);
                 append(numbers, structure.bed_row());
                 return numbers;
               });
}

TEST(AbsentGrains, HaveNoPartInHeightsShearRateAndMixing)
{
  expect_equal(SegregationSeries<2>(unit_layers), [](const SegregationSeries<2>& series) {
    std::vector<double> numbers;
    for (const auto& now : series.states())
      append(numbers,
             std::vector{now.large, now.small, now.bed, now.shear_rate, now.mixing, now.strain});
    return numbers;
  });
}

TEST(AbsentGrains, HaveNoPartInTheMomentumOfALayer)
{
  expect_equal(MomentumBalance<2>(unit_layers, smooth, gravity, step),
               [](const MomentumBalance<2>& balance) {
                 std::vector<double> numbers;
                 for (std::size_t n = 0; n < balance.layers(); ++n)
                   for (const auto species : {Species::small, Species::large}) {
                     const auto mean = balance.mean(n, species);
                     for (const Vec2& of : {mean.momentum, mean.rate, mean.gravity, mean.contact,
                                            mean.kinetic, mean.interaction, mean.base, mean.force})
                       append(numbers, of);
                   }
                 return numbers;
               });
}

TEST(AbsentGrains, HaveNoPartInTheExtentOfAMap)
{
  expect_equal(GrainExtent<2>(Vec2(5, 2)), [](const GrainExtent<2>& extent) {
    std::vector<double> numbers{extent.distance(), extent.bed_height()};
    append(numbers, extent.low());
    append(numbers, extent.high());
    return numbers;
  });
}

TEST(AbsentGrains, HaveNoPartInTheBalanceOfForcesAndTorques)
{
  expect_equal(ForceBalance<2>(gravity, step), [](const ForceBalance<2>& balance) {
    return std::vector{balance.forces.largest, balance.forces.sum};
  });
}

TEST(AbsentGrains, HaveNoPartInTheWeightAbove)
{
  auto with_rows = WeightSums<2>(unit_layers, gravity, 0.5), without_rows = with_rows;
  for (const auto& packing : with_absent_grains()) {
    with_rows.add_to_mean(packing.grains, packing.frame);
    const auto others = compacted(packing);
    without_rows.add_to_mean(others.grains, others.frame);
  }
  for (const auto& packing : with_absent_grains()) {
    with_rows.add(packing.grains, packing.frame);
    const auto others = compacted(packing);
    without_rows.add(others.grains, others.frame);
  }
  EXPECT_EQ(with_rows.window().weight, without_rows.window().weight);
  EXPECT_EQ(with_rows.window().momentum, without_rows.window().momentum);
}

// A bed at rest loses a grain: its centre of mass jumps, although nothing has moved.
TEST(AbsentGrains, DoNotMoveTheCentreOfMass)
{
  const Box box{10, 10, true};
  auto before = heap_at(1), after = heap_at(1);
  after.frame.time = 2;
  after = without(after, {0, 3});
  for (auto* packing : {&before, &after})
    for (auto& velocity : packing->frame.velocity) velocity.setZero();
  MotionBalance<2> motion(gravity, step);
  for (const auto& packing : {before, after})
    motion.add(total_motion(packing.grains, packing.frame, box, step), std::nullopt);
  EXPECT_FALSE(motion.same_grains());
  EXPECT_EQ(motion.stray(0), 0);
  const auto total = total_motion(after.grains, after.frame, box, step);
  const auto others = compacted(after);
  EXPECT_EQ(total.mass, total_motion(others.grains, others.frame, box, step).mass);
  EXPECT_EQ(total.centre, total_motion(others.grains, others.frame, box, step).centre);
}

// The momentum of a grain that appears or disappears is not the work of forces.
TEST(AbsentGrains, LeaveTheChangeOfMomentumUndefined)
{
  MomentumBalance<2> balance(unit_layers, smooth, gravity, step);
  const auto whole = heap_at(1), later = heap_at(2);
  balance.add(whole.grains, whole.frame);
  auto with_others = balance;
  balance.add(later.grains, later.frame);
  EXPECT_TRUE(balance.change(1, Species::small).allFinite());
  const auto fewer = without(later, {2});
  with_others.add(fewer.grains, fewer.frame);
  EXPECT_TRUE(with_others.change(1, Species::small).array().isNaN().all());
}

TEST(AbsentGrains, HaveNoPartInTheFluxOfSegregation)
{
  const Window window{0, 8, {}};
  SegregationFlux<2> with_rows(unit_layers, window, 1, 2), without_rows = with_rows;
  Packing rest;
  for (int part = 0; part < 8; ++part) {
    auto packing = without(heap_at(1 + part), {0, 2, 5});
    packing.frame.time = part;
    rest = compacted(packing);
    with_rows.add(packing.grains, packing.frame);
    without_rows.add(rest.grains, rest.frame);
  }
  const auto a = with_rows.results(heap().grains, 5), b = without_rows.results(rest.grains, 5);
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t n = 0; n < a.size(); ++n) {
    const auto mine = a[n].cells(2), others = b[n].cells(2);
    for (std::size_t k = 0; k < mine.size(); ++k)
      EXPECT_TRUE(mine[k].value == others[k].value ||
                  (std::isnan(mine[k].value) && std::isnan(others[k].value)))
          << mine[k].column << " of layer " << n;
  }
  EXPECT_GT(a[1].value.D_small, 0);
}

// Displacements are computed for grains that are present at both ends; all rise by 0.1 per part.
TEST(AbsentGrains, AreNotDisplaced)
{
  const Window window{0, 8, {}};
  SegregationFlux<2> flux(unit_layers, window, 1, 2);
  Packing packing = heap();
  for (int part = 0; part < 8; ++part) {
    packing.frame.time = part;
    for (auto& position : packing.frame.position) position.y() += 1e-3;
    auto now = packing;
    now.frame.image.assign(now.grains.size(), {});
    if (part == 7) make_absent(now.frame, 0);
    flux.add(now.grains, now.frame);
  }
  double displaced = 0, species_in_layers = 0;
  const auto all = flux.results(packing.grains, 5);
  for (const auto& layer : all)
    for (const double number : layer.displacements) displaced += number;
  SegregationFlux<2> whole(unit_layers, window, 1, 2);
  packing = heap();
  for (int part = 0; part < 8; ++part) {
    packing.frame.time = part;
    for (auto& position : packing.frame.position) position.y() += 1e-3;
    whole.add(packing.grains, packing.frame);
  }
  for (const auto& layer : whole.results(packing.grains, 5))
    for (const double number : layer.displacements) species_in_layers += number;
  EXPECT_EQ(displaced, species_in_layers - 1)
      << "one displacement of seven of one grain is missing";
  for (const auto& layer : all) EXPECT_FALSE(layer.value.D_small > 1e-20);
}

}  // namespace
}  // namespace grseg
