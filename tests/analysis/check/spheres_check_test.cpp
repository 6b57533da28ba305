// SPDX-License-Identifier: GPL-3.0-or-later
// Measurements of grseg-check on a column of spheres at rest, and the damage that it finds.
#include "tests/analysis/check/checked_column.hpp"

namespace grseg {
namespace {

const Vec3 oblique{3, -weight, 1};

TEST_F(CheckedColumn, OfSpheresOnASlopeAlongBothAxesPassesEveryCheck)
{
  const auto lines = lines_of(ColumnOf<3>(oblique));
  EXPECT_EQ(with(Verdict::failed, lines), Names{});
  EXPECT_EQ(with(Verdict::skipped, lines), Names{"torque_balance"});
  for (const auto& line : lines) {
    if (line.verdict == Verdict::skipped) continue;
    EXPECT_LE(line.measured, 1e-12) << line.quantity;
  }
}

// Checks of discs hold for spheres, too; for spheres also components along z are checked.
TEST_F(CheckedColumn, OfSpheresFailsTheForceBalanceIfAForceAlongZIsChanged)
{
  ColumnOf<3> column(oblique);
  column.frames[7].contacts.force[2].z() *= 1.01;
  EXPECT_EQ(failed(column), Names{"force_balance"});
}

// Friction has components along x and z: with (0.3, 0.1) of the normal force its magnitude is
// 0.316; with (0.4, 0.4) it exceeds 1/2 although neither component does.
TEST_F(CheckedColumn, OfSpheresFailsCoulombsLawByTheModulusOfFriction)
{
  ColumnOf<3> column(oblique);
  auto& frame = column.frames[7];
  const double normal = frame.contacts.force[2].y();
  const Vec3 friction = frame.contacts.force[2] - normal * Vec3::UnitY();
  ColumnOf<3>::push(frame, 2, Vec3(-0.4, 0, -0.2) * normal - friction);
  EXPECT_EQ(failed(column), Names{});
  ColumnOf<3>::push(frame, 2, Vec3(0, 0, -0.2) * normal);
  EXPECT_EQ(failed(column), (Names{"coulomb_largest", "coulomb_mean"}));
}

TEST_F(CheckedColumn, OfSpheresFailsTheSumOfPartialsIfABranchIsAskewAlongZ)
{
  ColumnOf<3> column(oblique);
  column.frames[7].contacts.branch[2].z() += 1e-8 * radius;
  EXPECT_EQ(failed(column), Names{"sum_of_partials"});
}

// The upper four spheres are just inside the edge z = width, the others just inside z = 0.
TEST_F(CheckedColumn, OfSpheresMayTouchAcrossTheEdgeAlongZ)
{
  ColumnOf<3> column(oblique);
  const double way = 1e-9 * radius;
  for (auto& frame : column.frames) {
    for (std::size_t g = 3; g <= discs; ++g) frame.position[g].z() = width - way;
    frame.contacts.branch[2].z() = -way;
  }
  EXPECT_EQ(failed(column), Names{});
  column.description.box.periodic_z = false;
  EXPECT_EQ(failed(column), Names{"sum_of_partials"});
}

TEST_F(CheckedColumn, OfSpheresFailsTotalMomentumIfTheBasePushesAlongZ)
{
  ColumnOf<3> column(oblique);
  column.observables[7][2] += 1e-6 * column.observables[7][1];
  EXPECT_EQ(failed(column), Names{"total_momentum"});
}

// Stress is per volume Lx Lz h, and all three species count.
TEST_F(CheckedColumn, OfSpheresCarriesInEachLayerTheWeightAboveAlongAllAxes)
{
  const ColumnOf<3> column(oblique);
  const Layers layers(2 * radius, length, width);
  WeightSums<3> sums(layers, oblique, small / 2, 3);
  const auto& grains = column.description.grains;
  for (const auto& frame : column.frames) sums.add_to_mean(grains, frame);
  for (const auto& frame : column.frames) sums.add(grains, frame);
  const auto window = sums.window();
  ASSERT_EQ(window.stress.size(), discs);
  for (std::size_t n = 1; n < discs; ++n) {
    const double load = (static_cast<double>(discs - n) - 0.5) * grains.mass[1] / (length * width);
    EXPECT_LT((window.stress[n] + load * oblique).norm(), 1e-12 * load);
    EXPECT_LT((window.weight[n] + load * oblique).norm(), 1e-12 * load);
  }
}

TEST_F(CheckedColumn, OfSpheresFailsTheWeightIfLayersCarryTooLittleAlthoughForcesBalance)
{
  ColumnOf<3> column(oblique);
  for (auto& frame : column.frames)
    for (std::size_t c = 0; c < discs; ++c)
      ColumnOf<3>::push(frame, c, -0.02 * frame.contacts.force[c]);
  EXPECT_EQ(failed(column), Names{"weight"});
}

TEST_F(CheckedColumn, OfSpheresFailsTheSlopeOfTheAxisAlongWhichTheStressRatioDiffers)
{
  for (const int axis : {0, 2}) {
    ColumnOf<3> column(oblique);
    for (auto& frame : column.frames)
      for (std::size_t c = 0; c < discs; ++c)
        ColumnOf<3>::push(frame, c, -0.1 * frame.contacts.force[c][axis] * Vec3::Unit(axis));
    EXPECT_EQ(failed(column), Names{axis == 0 ? "slope" : "slope_across"});
  }
}

TEST_F(CheckedColumn, OfSpheresFailsTheDriftOfTheAxisAlongWhichGrainsMoveWithoutVelocity)
{
  for (const std::size_t axis : {0u, 2u}) {
    ColumnOf<3> column(oblique);
    for (std::size_t k = 0; k < column.frames.size(); ++k)
      column.frames[k].image[1][axis] = static_cast<std::int32_t>(k);
    EXPECT_EQ(failed(column), Names{axis == 0 ? "x_drift" : "z_drift"});
  }
}

// Friction (f_x, 0, f_z) at the contact under a sphere, at -r along y, turns it by (-r e_y) x f = r
// (-f_z, 0, f_x) over the inertia 2/5 m r^2; so does friction from the sphere above.
TEST_F(CheckedColumn, OfSpheresHasTorquesAboutAllAxes)
{
  const auto turning = [&](double inertia) {
    ColumnOf<3> column(oblique, 0, 1);
    const double mass = column.description.grains.mass[1];
    for (std::size_t k = 0; k < column.frames.size(); ++k) {
      for (std::size_t g = 1; g <= discs; ++g) {
        const auto& force = column.frames[k].contacts.force;
        const Vec3 sum = force[g - 1] + (g < discs ? force[g] : Vec3(Vec3::Zero()));
        column.frames[k].angular_velocity[g] = Vec3(-sum.z(), 0, sum.x()) * radius /
                                               (inertia * mass * radius * radius) * h *
                                               static_cast<double>(k);
      }
    }
    return column;
  };
  const auto lines = lines_of(turning(0.4));
  EXPECT_EQ(with(Verdict::failed, lines), Names{});
  EXPECT_EQ(with(Verdict::skipped, lines), Names{});
  EXPECT_EQ(failed(turning(0.5)), Names{"torque_balance"});
  auto column = turning(0.4);
  column.frames[7].angular_velocity[3].x() *= 1 + 1e-6;
  EXPECT_EQ(failed(column), Names{"torque_balance"});
}

}  // namespace
}  // namespace grseg
