// SPDX-License-Identifier: GPL-3.0-or-later
// Mean motion over a map: planes through the motions of grains.
#include "analysis/stress/kinetic_stress.hpp"
#include "tests/analysis/contact_packings.hpp"

#include <gtest/gtest.h>

#include <random>

namespace grseg {
namespace {

Layers map_of(double side)
{
  return Layers::map({MapPlane::xy, {open_axis('x', side, 0, 10), open_axis('y', side, 0, 10)}, 1},
                     10, std::nullopt);
}

/// Grains of two species at random places with the velocities of a linear field, to which random
/// ones up to `noise` are added.
Packing sheared(const Tensor2& gradient, double noise, int grains = 4000)
{
  std::mt19937 random(3);
  std::uniform_real_distribution<double> place(0, 10), more(-noise, noise);
  Packing packing;
  for (int g = 0; g < grains; ++g) {
    const Vec2 at(place(random), place(random));
    packing.grain(g % 2 == 0 ? Species::small : Species::large, g % 2 == 0 ? 0.1 : 0.2, at,
                  Vec2(2, -1) + gradient * at + Vec2(more(random), more(random)));
  }
  return packing;
}

KineticStress<2> motion_in(const Layers& layers, const Packing& packing, MeanFlow flow,
                           double bin = 0.5)
{
  MeanVelocity<2> mean(layers, bin);
  mean.add(packing.grains, packing.frame);
  KineticStress<2> stress(layers, flow, mean);
  stress.add(packing.grains, packing.frame);
  return stress;
}

Tensor2 gradient_of(double du_dx, double du_dy, double dv_dx, double dv_dy)
{
  Tensor2 gradient;
  gradient << du_dx, du_dy, dv_dx, dv_dy;
  return gradient;
}

/// Sum of m dv.dv over all cells and both species.
double energy(const KineticStress<2>& stress)
{
  double sum = 0;
  for (std::size_t cell = 0; cell < stress.layers(); ++cell)
    for (const auto species : {Species::small, Species::large})
      sum += stress.mean(cell, species).about_mean.kinetic.trace();
  return sum;
}

TEST(MapFlow, AMeanFlowThatIsLinearHasNoFluctuationsInCellsOfAnySize)
{
  const auto packing = sheared(gradient_of(0.3, 1.7, -0.4, -0.3), 0);
  for (const double side : {1.0, 2.5, 5.0}) {
    const auto layers = map_of(side);
    EXPECT_LT(energy(motion_in(layers, packing, MeanFlow::profile)), 1e-10) << side;
    EXPECT_GT(energy(motion_in(layers, packing, MeanFlow::layer)), 1) << side;
  }
}

TEST(MapFlow, TheRateOfShearIsThatOfTheGradientWithoutItsRotation)
{
  const auto rate = [](const Tensor2& gradient) {
    return motion_in(map_of(5), sheared(gradient, 0, 400), MeanFlow::profile).shear_rate(1);
  };
  EXPECT_NEAR(rate(gradient_of(0, 3, 0, 0)), 3, 1e-12);
  EXPECT_NEAR(rate(gradient_of(2, 0, 0, -2)), 4, 1e-12);
  EXPECT_NEAR(rate(gradient_of(0, 5, -5, 0)), 0, 1e-12);
}

// A drum that turns as a rigid body round the axis of a map rz does not shear.
TEST(MapFlow, RigidRotationRoundTheAxisOfAMapDoesNotShear)
{
  const Vec2 axis(5, 5);
  const auto rz = Layers::map(
      {MapPlane::rz, {open_axis('r', 2.5, 0, 5), periodic_axis('z', 5, 10)}, 1, axis}, 10, 10);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> place(0, 10);
  for (const double shear : {0.0, 2.0}) {
    PackingOf<3> packing;
    for (int g = 0; g < 500; ++g) {
      const Vec3 at(place(random), place(random), place(random) / 2);
      const Vec2 arm = at.head<2>() - axis;
      packing.grain(Species::small, 0.1, at, {-1.5 * arm.y(), 1.5 * arm.x(), shear * at.z()});
    }
    MeanVelocity<3> mean(rz, 1);
    mean.add(packing.grains, packing.frame);
    KineticStress<3> motion(rz, MeanFlow::profile, mean);
    motion.add(packing.grains, packing.frame);
    // The only component of the gradient is dw/dz.
    EXPECT_NEAR(motion.shear_rate(0), shear * std::sqrt(2.0), 1e-9);
  }
}

// The shares of all grains of a patch in its plane add up to the plane's three numbers.
TEST(MapFlow, GrainsShareTheThreeNumbersOfTheirPlane)
{
  const auto packing = sheared(Tensor2::Zero(), 1);
  const auto stress = motion_in(map_of(5), packing, MeanFlow::profile, 1.25);
  double own = 0;
  for (std::size_t cell = 0; cell < 4; ++cell)
    for (const auto species : {Species::small, Species::large}) {
      const auto mean = stress.mean(cell, species);
      own += mean.own_part /
             (species == Species::small ? packing.grains.mass[0] : packing.grains.mass[1]);
    }
  EXPECT_NEAR(own, 16 * 3, 1e-9);  // patches of 2.5 by 2.5
}

TEST(MapFlow, FluctuationsAboutAllOtherGrainsAreAboutThePlaneWithoutTheGrain)
{
  const auto packing = sheared(gradient_of(0, 1, 0, 0), 1, 12);
  const auto& [grains, frame] = std::tie(packing.grains, packing.frame);
  const MapGrid cells = *map_of(10).map();
  const auto plane = [&](std::size_t without) {
    MapFlow<2> flow(cells, 10);
    for (std::size_t g = 0; g < grains.size(); ++g)
      if (g != without)
        flow.add(frame.position[g], grains.mass[g], motion_of<2>(map_of(10), frame, g));
    flow.finish();
    return flow;
  };
  const auto all = plane(grains.size());
  for (std::size_t g = 0; g < grains.size(); ++g) {
    const Motion<2> motion = motion_of<2>(map_of(10), frame, g);
    const Vec2& at = frame.position[g];
    const auto expected = symmetric_product<2>(1, motion - all.at(at), motion - plane(g).at(at));
    const auto found = all.about_others(at, grains.mass[g], motion);
    ASSERT_TRUE(found);
    EXPECT_LT((found->velocities - expected.velocities).norm(), 1e-11);
    EXPECT_NEAR(found->spins, expected.spins, 1e-11);
  }
}

// Uniform random numbers in [-1, 1] have the variance 1/3. Three of twelve degrees of freedom are
// lost to each plane.
TEST(MapFlow, FewGrainsLoseFluctuationsToTheirMeanButNotToThatOfOthers)
{
  const auto packing = sheared(gradient_of(0, 1, 0, 0), 1, 4800);
  const auto layers = map_of(0.5);  // twelve grains per cell
  double mass = 0;
  for (const double m : packing.grains.mass) mass += m;
  const double plain = energy(motion_in(layers, packing, MeanFlow::profile, 1)) / mass * 3 / 2;
  const auto unbiased = motion_in(layers, packing, MeanFlow::profile_unbiased, 1);
  const double others = energy(unbiased) / mass * 3 / 2;
  EXPECT_LT(plain, 0.8);
  EXPECT_NEAR(others, 1, 0.1);
}

}  // namespace
}  // namespace grseg
