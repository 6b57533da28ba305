// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/formats/import/flow_in_space.hpp"

#include "formats/trajectory/reader.hpp"

#include <gtest/gtest.h>

namespace grseg {
namespace {

using namespace flow_in_space;
using lammps_text::mentions;
using lammps_text::refusal;

constexpr double round_off = 1e-13;

void expect_near(const Vec3& found, const Vec3& expected, const std::string& what)
{
  EXPECT_LT((found - expected).norm(), round_off)
      << what << ": " << found.transpose() << " instead of " << expected.transpose();
}

class FlowInSpace : public testing::Test {
 protected:
  lammps_text::Folder folder;

  Frame<3> frame_of(const ImportSettings& settings) const
  {
    import_archive(settings, "grseg-import");
    const TrajectoryReader run(settings.output);
    Frame<3> frame;
    run.read(0, frame, {.velocity = true, .contacts = true, .force = true});
    return frame;
  }
  /// Replaces text in both files, if it occurs.
  static void replace(const ImportSettings& settings, const std::string& what,
                      const std::string& by)
  {
    for (const auto& file : {settings.files.grains[0], settings.files.contacts[0]}) {
      auto archive = lammps_text::read(file);
      const auto at = archive.find(what);
      if (at != std::string::npos) archive.replace(at, what.size(), by);
      std::ofstream(file, std::ios::binary) << archive;
    }
  }
  /// Checks the run in the file just written.
  void expect_run(const Flow& flow, const std::string& what) const;
  void expect_frame(const Frame<3>& found, const Frame<3>& expected, const std::string& what) const;
};

void FlowInSpace::expect_run(const Flow& flow, const std::string& what) const
{
  const TrajectoryReader run(folder / "run.h5");
  EXPECT_EQ(run.dimension(), 3);
  EXPECT_EQ(run.grains().id, flow.grains.id) << what;
  EXPECT_EQ(run.grains().species, flow.grains.species) << what;
  EXPECT_NEAR(run.box().length_x, 7, round_off) << what;
  EXPECT_NEAR(run.box().length_z, 5, round_off) << what;
  EXPECT_TRUE(run.box().periodic_x && run.box().periodic_z) << what;
  expect_near(run.gravity<3>().start, flow.gravity, "gravity, " + what);
  EXPECT_NEAR(run.parameters().number("density", ""), 1, round_off) << "of matter, kg/m^3";
}

void FlowInSpace::expect_frame(const Frame<3>& found, const Frame<3>& expected,
                               const std::string& what) const
{
  for (std::size_t g = 0; g < expected.position.size(); ++g) {
    const auto of = fmt::format(" of grain {}, {}", g, what);
    expect_near(found.position[g], expected.position[g], "position" + of);
    expect_near(found.velocity[g], expected.velocity[g], "velocity" + of);
    expect_near(found.angular_velocity[g], expected.angular_velocity[g], "spin" + of);
    expect_near(found.force[g], expected.force[g], "force" + of);
  }
  const auto &contacts = found.contacts, &of_all = expected.contacts;
  ASSERT_EQ(contacts.size(), of_all.size()) << what;
  for (std::size_t c = 0; c < of_all.size(); ++c) {
    const auto of = fmt::format(" of contact {}, {}", c, what);
    const double side =
        contacts.i[c] == of_all.i[c] ? 1 : -1;  // i may be either of two mobile grains
    EXPECT_EQ(contacts.j[c], side > 0 ? of_all.j[c] : of_all.i[c]) << of;
    expect_near(side * contacts.force[c], of_all.force[c], "force" + of);
    expect_near(side * contacts.branch[c], of_all.branch[c], "branch" + of);
    EXPECT_NEAR(contacts.gap[c], of_all.gap[c], round_off) << of;
  }
}

TEST_F(FlowInSpace, ViewsOfTheTestsAreTurnedAndNotMirrored)
{
  for (const auto& view : views()) EXPECT_EQ(view.turn.determinant(), 1) << view.axes;
}

TEST_F(FlowInSpace, OfLammpsIsTheSameInWhateverAxes)
{
  const Flow flow;
  for (const auto& view : views()) {
    const auto frame = frame_of(lammps(folder, view));
    expect_run(flow, view.axes);
    expect_frame(frame, flow.frame, view.axes);
    EXPECT_EQ(frame.image, flow.frame.image) << view.axes;
  }
}

TEST_F(FlowInSpace, OfTablesIsTheSameInWhateverAxesWithAWall)
{
  Flow flow;
  flow.add_wall();
  for (const auto& view : views()) {
    const auto frame = frame_of(csv(folder, view, flow));
    expect_run(flow, view.axes);
    expect_frame(frame, flow.frame, view.axes);
  }
}

// A mirror image would change the sign of branch x force . spin.
TEST_F(FlowInSpace, KeepsTheSenseOfAnObliqueContact)
{
  const Flow flow;
  const double sense = flow.frame.contacts.branch[0]
                           .cross(flow.frame.contacts.force[0])
                           .dot(flow.frame.angular_velocity[1]);
  ASSERT_GT(std::abs(sense), 1);
  for (const auto& view : views()) {
    const auto frame = frame_of(lammps(folder, view));
    ASSERT_EQ(frame.contacts.i[0], 1);
    EXPECT_NEAR(
        frame.contacts.branch[0].cross(frame.contacts.force[0]).dot(frame.angular_velocity[1]),
        sense, 1e-11)
        << view.axes;
  }
}

// In the archive gravity is vertical; the base lies in its x-z plane and is inclined by 30 degrees.
TEST_F(FlowInSpace, AVerticalGravityIsTurnedToTheSlopeAboutTheAxisAcross)
{
  Flow flow;
  flow.box.periodic_x = false;
  flow.gravity = Vec3(5, -10 * std::sqrt(0.75), 0);
  flow.frame.position[0].x() -= 7;  // at the side of the other grains
  for (auto& image : flow.frame.image) image[0] = 0;
  flow.balance();
  const double c = std::sqrt(0.75), s = 0.5;
  const View view{"xz", columns({c, 0, -s}, {s, 0, c}, {0, -1, 0})};
  auto settings = lammps(folder, view, flow);
  settings.slope = 30;
  settings.gravity = "0,0,-10";
  const auto frame = frame_of(settings);
  for (std::size_t g = 0; g < 4; ++g) {
    expect_near(frame.velocity[g], flow.frame.velocity[g], "velocity");
    expect_near(frame.angular_velocity[g], flow.frame.angular_velocity[g], "spin");
    expect_near(frame.force[g], flow.frame.force[g], "force");
    expect_near(frame.position[g] - frame.position[1],
                flow.frame.position[g] - flow.frame.position[1], "distance");
  }
  expect_near(TrajectoryReader(settings.output).gravity<3>().start, flow.gravity, "gravity");
}

TEST_F(FlowInSpace, AContactAcrossNeedsThePeriodAcross)
{
  auto settings = lammps(folder, views()[1]);
  replace(settings, "pp pp ff", "pp ff ff");
  EXPECT_EQ(refusal(settings).code, exit_check);
  EXPECT_TRUE(mentions(refusal(settings).sentence, "grains 5 and 3 are listed as touching"));
  EXPECT_TRUE(mentions(refusal(settings).sentence, "is the cell periodic as the archive states?"));
}

TEST_F(FlowInSpace, APeriodAlongTheNormalIsRefusedAtOnce)
{
  auto settings = lammps(folder, views()[1]);
  replace(settings, "pp pp ff", "pp pp pp");
  EXPECT_EQ(refusal(settings).code, exit_usage);
  EXPECT_TRUE(mentions(refusal(settings).sentence,
                       "the cell is periodic along z, the normal of the base, but a bed ends"));
  settings.axes = "xy";
  EXPECT_TRUE(mentions(refusal(settings).sentence, "periodic along y, the normal of the base"));
}

TEST_F(FlowInSpace, ATiltedCellIsRefused)
{
  auto settings = lammps(folder, views()[0]);
  replace(settings, "BOX BOUNDS", "BOX BOUNDS xy xz yz");
  replace(settings, "-3.25 3.75", "-3.25 3.75 0.5");
  EXPECT_TRUE(mentions(refusal(settings).sentence, "the cell is tilted; only rectangular cells"));
}

TEST_F(FlowInSpace, ACellThatChangesAcrossIsRefused)
{
  const Flow flow;
  Flow later;
  later.frame.step = 80;
  auto settings = lammps(folder, views()[1]);
  auto grains = lammps_grains(later, views()[1]);
  grains.replace(grains.find("-4.25 0.75"), 10, "-4.25 0.76");
  folder.write("grains", lammps_grains(flow, views()[1]) + grains);
  folder.write("contacts", lammps_contacts(flow, views()[1]) + lammps_contacts(later, views()[1]));
  EXPECT_EQ(refusal(settings).code, exit_content);
  EXPECT_TRUE(mentions(refusal(settings).sentence,
                       "the periodic length is 5.01, but 5 in the first frame"));
}

// If missing components were read as 0, results would be slightly wrong without any message.
TEST_F(FlowInSpace, MissingComponentsAreNamed)
{
  const auto lammps_without = [&](const char* from, const char* to) {
    auto settings = lammps(folder, views()[1]);
    replace(settings, from, to);
    return refusal(settings).sentence;
  };
  for (const char* column : {"vy", "omegax", "fz", "iy"})
    EXPECT_TRUE(mentions(lammps_without(fmt::format(" {} ", column).c_str(), " v_other "),
                         fmt::format("needs all components, but there is no {};", column)));
  EXPECT_TRUE(mentions(lammps_without(" tz\n", " v_other\n"), "there is no tz; write"));
  auto settings = csv(folder, views()[0]);
  replace(settings, ",vz,wx,wy,wz,", ",a,b,c,wz,");
  settings.files.map = {"a=,b=,c="};
  replace(settings, "bx;by;bz", "bx;by;other");
  EXPECT_TRUE(
      mentions(refusal(settings).sentence, "there is no vz, nor wx, nor wy, nor bz; write"));
  EXPECT_EQ(refusal(settings).code, exit_content);
}

TEST_F(FlowInSpace, WithoutSpinsIsImportedWithoutThem)
{
  auto settings = lammps(folder, views()[0]);
  replace(settings, "omegax omegay omegaz", "v_a v_b v_c");
  EXPECT_EQ(frame_of(settings).angular_velocity[1], Vec3(0, 0, 0));
}

TEST_F(FlowInSpace, UnitsAreConvertedComponentByComponent)
{
  auto settings = lammps(folder, views()[0]);
  settings.units = "0.5:0.1:2";
  const auto frame = frame_of(settings);
  const Flow flow;
  expect_near(frame.velocity[2], 5 * flow.frame.velocity[2], "velocity");
  expect_near(frame.angular_velocity[2], 10 * flow.frame.angular_velocity[2], "spin");
  EXPECT_TRUE(frame.contacts.force[1].isApprox(-100 * flow.frame.contacts.force[1]) ||
              frame.contacts.force[1].isApprox(100 * flow.frame.contacts.force[1]));
  const TrajectoryReader run(settings.output);
  EXPECT_NEAR(run.box().length_z, 2.5, round_off);
  EXPECT_NEAR(run.parameters().number("density", ""), 2 / 0.125, 1e-12);
}

// The large sphere is alone on the base, where m a = F + m g + c (m a + ...) h/2 as in
// verification_test.cpp; a small one slides there without acceleration along the normal.
TEST_F(FlowInSpace, LateDampingRollsSpheresAndNotDiscs)
{
  Flow flow;
  auto& contacts = flow.frame.contacts;
  const double half_step = 5e-4, c_n = 300, c_t = 200, small_mass = flow.grains.mass[3];
  const Vec3 aside(-0.6, 0.8, 0);
  flow.frame.position[2] = flow.frame.position[3];  // the third grain does not touch others
  flow.frame.position[3] = flow.frame.position[0] + 1.495 * aside;
  contacts.i[1] = 3;
  contacts.j[1] = 0;
  contacts.branch[1] = 1.495 * aside;
  contacts.force[1] = small_mass * (-flow.gravity.dot(aside) * aside + Vec3(0, 0, 5));
  flow.balance();
  const Vec3 n = contacts.branch[0].normalized(), force = contacts.force[0];
  const Vec3 total = force + flow.grains.mass[1] * flow.gravity;
  const Vec3 along_n = total.dot(n) * n, friction = force - force.dot(n) * n;
  flow.frame.force[1] =
      along_n / (1 - c_n * half_step) +
      (total - along_n + c_t * half_step * friction / 0.4) / (1 - c_t * half_step);
  auto settings = lammps(folder, views()[1], flow);
  settings.accept_residual = {"1e-9"};
  const auto report = import_archive(settings, "");
  EXPECT_NEAR(report.parameters.numbers.at("import_late_damping")[0], c_n, 1e-7);
  EXPECT_NEAR(report.parameters.numbers.at("import_late_damping")[1], c_t, 1e-7);
  EXPECT_GT(report.parameters.number("import_residual_largest", ""), 0.01);
}

// Output of Debian's lammps for scripts/archives/chute3d.lammps: 12 spheres of base and 48 above, undamped.
TEST_F(FlowInSpace, OfLammpsItselfBalancesToRoundOff)
{
  ImportSettings s;
  s.format = "lammps";
  const std::string at = GRSEG_TEST_INPUTS "/lammps3d/";
  s.files.grains = {at + "atoms.dump.gz"};
  s.files.contacts = {at + "contacts.dump.gz"};
  s.units = "1:1:1";
  s.step = 8.8e-4;
  s.gravity = "0.5299192642332049,0,-0.848048096156426";
  s.axes = "xz";
  s.species.boundary = "1";
  s.output = folder / "run.h5";
  const auto report = import_archive(s, "");
  EXPECT_EQ(report.dimension, 3);
  EXPECT_EQ(report.frames, 3u);
  EXPECT_EQ(report.contacts, 169u);
  EXPECT_LT(report.parameters.number("import_residual_largest", ""), 1e-13);
  const TrajectoryReader run(s.output);
  EXPECT_EQ(run.box().length_x, 8);
  EXPECT_EQ(run.box().length_z, 6);
  std::size_t across_x = 0, across_z = 0;
  Vec3 least_force = Vec3::Constant(INFINITY);
  for (std::size_t k = 0; k < run.size(); ++k) {
    Frame<3> frame;
    run.read(k, frame);
    for (std::size_t c = 0; c < frame.contacts.size(); ++c) {
      const auto i = static_cast<std::size_t>(frame.contacts.i[c]);
      const auto j = static_cast<std::size_t>(frame.contacts.j[c]);
      const Vec3 direct = frame.position[i] - frame.position[j];
      across_x += std::abs(direct.x() - frame.contacts.branch[c].x()) > 1;
      across_z += std::abs(direct.z() - frame.contacts.branch[c].z()) > 1;
      least_force = least_force.cwiseMin(frame.contacts.force[c].cwiseAbs());
      EXPECT_NEAR(frame.contacts.branch[c].norm(),
                  run.grains().radius[i] + run.grains().radius[j] + frame.contacts.gap[c], 1e-12);
    }
  }
  EXPECT_GT(across_x, 10u);
  EXPECT_GT(across_z, 10u);
  EXPECT_GT(least_force.minCoeff(), 0) << "every contact is oblique";
}

}  // namespace
}  // namespace grseg
