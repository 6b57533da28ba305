// SPDX-License-Identifier: GPL-3.0-or-later
// Walls: the force that is missing in a grain's balance is the wall's, by hand; and archives that
// LAMMPS and LIGGGHTS wrote, whose walls carry the weight.
#include "formats/trajectory/reader.hpp"
#include "tests/formats/import/lammps_text.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

namespace grseg {
namespace {

using namespace lammps_text;

const std::string inputs = GRSEG_TEST_INPUTS "/";

template <int D>
Frame<D> frame_of(const ImportSettings& s, std::size_t index)
{
  Frame<D> frame;
  TrajectoryReader(s.output).read(index, frame,
                                  {.velocity = true, .contacts = true, .force = true});
  return frame;
}

/// Sum of the forces of all walls.
template <int D>
Vector<D> force_of_walls(const Frame<D>& frame)
{
  Vector<D> sum = Vector<D>::Zero();
  for (std::size_t c = 0; c < frame.contacts.size(); ++c)
    if (frame.contacts.j[c] < 0) sum += frame.contacts.force[c];
  return sum;
}

/// Sum of m g of the present grains, and of m a.
template <int D>
std::pair<Vector<D>, Vector<D>> weight_and_force(const Grains& grains, const Frame<D>& frame,
                                                 const Vector<D>& gravity)
{
  Vector<D> weight = Vector<D>::Zero(), force = Vector<D>::Zero();
  for (std::size_t g = 0; g < grains.size(); ++g)
    if (is_present(frame, g)) {
      weight += grains.mass[g] * gravity;
      force += frame.force[g];
    }
  return {weight, force};
}

class Walls : public testing::Test {
 protected:
  Folder folder;

  /// The large disc of lammps_text.hpp at (x, 0.005), with the small one on it and no base.
  ImportSettings two_discs(double x = 0.05, const std::string& boundary = "pp ff pp",
                           const std::string& columns = grain_columns, const std::string& more = "")
  {
    auto rows = grain_rows(x);
    rows.erase(rows.begin());
    rows[0] += more.empty() ? "" : " 0 0 0 0 0 0 0 0";
    rows[1] += more;
    auto s = settings(
        folder, block("ATOMS", 0, columns, rows, boundary),
        block("ENTRIES", 0, contact_columns, {contact_row(4, 7, 0.0075, small_mass)}, boundary));
    s.species.boundary.reset();
    return s;
  }
};

TEST_F(Walls, AFloorThatIsNamedCarriesTheWeightOfWhatLiesOnIt)
{
  auto s = two_discs();
  s.walls = {"floor=y:0"};
  const auto report = import_archive(s, "");
  EXPECT_EQ(report.parameters.text("import_base"), "walls floor (y = 0)");
  EXPECT_TRUE(mentions(to_text(report),
                       "forces of floor (y = 0) are inferred from the force "
                       "balance"));
  const auto frame = frame_of<2>(s, 0);
  ASSERT_EQ(frame.contacts.size(), 2u);
  EXPECT_EQ(frame.contacts.i[1], 1);
  EXPECT_EQ(frame.contacts.j[1], -1);
  const double mass = small_mass + large_mass;
  EXPECT_NEAR(frame.contacts.force[1].x(), -mass * gx, 1e-15);
  EXPECT_NEAR(frame.contacts.force[1].y(), -mass * gy, 1e-15);
  EXPECT_NEAR(frame.contacts.branch[1].x(), 0, 1e-18);
  EXPECT_NEAR(frame.contacts.branch[1].y(), 0.005, 1e-17);
  EXPECT_NEAR(frame.contacts.gap[1], 0, 1e-17);
  EXPECT_NEAR(frame.position[1].y(), 0.005, 1e-17);  // y = 0 is at the floor
}

TEST_F(Walls, HeightsAreAboveTheFloorWhereverItIs)
{
  auto s = two_discs();
  s.walls = {"floor=y:-0.00001", "lid=y:0.09"};
  const auto refused = refusal(s);  // wall 0.01 mm below the disc: no contact
  EXPECT_EQ(refused.code, exit_check);
  EXPECT_TRUE(mentions(refused.sentence, "the forces on grain 7 do not add up"));
  s.walls = {"floor=y:0.0001", "lid=y:0.09"};
  const auto report = import_archive(s, "");
  EXPECT_NEAR(frame_of<2>(s, 0).position[1].y(), 0.0049, 1e-17);
  EXPECT_NEAR(frame_of<2>(s, 0).contacts.gap[1], -0.0001, 1e-17);
  EXPECT_TRUE(mentions(to_text(report), "no grain ever touches the wall lid (y = 0.09)"));
}

TEST_F(Walls, InACornerEachWallPushesAlongItsNormal)
{
  auto s = two_discs(0.095, "ff ff pp");
  s.walls = {"floor=y:0", "right=x:0.1"};
  s.cells = {"x:0:0.1"};
  const auto report = import_archive(s, "");
  const auto frame = frame_of<2>(s, 0);
  ASSERT_EQ(frame.contacts.size(), 3u);
  const double mass = small_mass + large_mass;
  std::map<int, Vec2> force;
  for (const std::size_t c : {1U, 2U}) force[frame.contacts.j[c]] = frame.contacts.force[c];
  EXPECT_NEAR((force[-1] - Vec2(0, -mass * gy)).norm(), 0, 1e-15);
  EXPECT_NEAR((force[-2] - Vec2(-mass * gx, 0)).norm(), 0, 1e-15);
  EXPECT_TRUE(mentions(to_text(report), "1 times a grain touches more than one of these walls"));
}

TEST_F(Walls, OneThatWouldPullGetsNothingBesideOneThatPushes)
{
  auto s = two_discs(0.005, "ff ff pp");
  s.cells = {"x:0:0.1"};
  s.walls = {"floor=y:0", "left=x:0"};  // this wall is down the slope, away from the discs
  import_archive(s, "");
  const auto frame = frame_of<2>(s, 0);
  ASSERT_EQ(frame.contacts.size(), 2u);
  EXPECT_EQ(frame.contacts.j[1], -1);
  EXPECT_NEAR(frame.contacts.force[1].x(), -(small_mass + large_mass) * gx, 1e-15);
}

TEST_F(Walls, ThoseInTheColumnsOfGrainsAreReadAndNotInferredOnceMore)
{
  const double mass = small_mass + large_mass;
  const auto eight = fmt::format(" 1 {} {} 0 0.05 0 0 0.005", -mass * gx, -mass * gy);
  auto columns = grain_columns;
  for (int k = 1; k <= 8; ++k) columns += fmt::format(" f_floor[{}]", k);
  auto s = two_discs(0.05, "pp ff pp", columns, eight);
  s.origin = "0";
  EXPECT_EQ(import_archive(s, "").parameters.text("import_base"), "walls floor");
  for (const bool named : {false, true}) {
    if (named) s.walls = {"ground=y:0"};
    s.overwrite = true;
    import_archive(s, "");
    const auto frame = frame_of<2>(s, 0);
    ASSERT_EQ(frame.contacts.size(), 2u);
    EXPECT_EQ(frame.contacts.j[1], named ? -2 : -1);
    EXPECT_NEAR(frame.contacts.force[1].y(), -mass * gy, 1e-15);
    EXPECT_NEAR(frame.contacts.branch[1].y(), 0.005, 1e-17);
  }
  s.walls.clear();
  s.files.wall_columns = "none";
  s.species.boundary = "none";
  EXPECT_EQ(refusal(s).code, exit_check);
}

TEST_F(Walls, AFileOfTheirContactsIsAnInputAndNeverReplaced)
{
  auto s = two_discs();
  s.files.wall_contacts = {folder.write("walls.dump", "kept")};
  s.output = s.files.wall_contacts[0];
  s.overwrite = true;
  EXPECT_TRUE(mentions(refusal(s).sentence, "is an input and cannot be the output"));
  EXPECT_EQ(lammps_text::read(s.output), "kept");
}

TEST_F(Walls, ColumnsOfTheSameNamesThatHoldSomethingElseAreRefused)
{
  auto columns = grain_columns;
  for (int k = 1; k <= 8; ++k) columns += fmt::format(" f_mean[{}]", k);
  auto s = two_discs(0.05, "pp ff pp", columns, " 0.3 1 1 1 1 1 1 1");
  s.origin = "0";
  const auto refused = refusal(s);
  EXPECT_EQ(refused.code, exit_content);
  EXPECT_TRUE(mentions(refused.sentence, "the eight columns of wall mean are 0.3 1 1"));
  EXPECT_TRUE(mentions(refused.sentence, "pass --wall-columns none"));
}

TEST_F(Walls, AreRefusedWithASentenceWhereTheyCannotBe)
{
  const auto sentence = [&](const std::vector<std::string>& walls) {
    auto s = two_discs();
    s.walls = walls;
    return refusal(s).sentence;
  };
  EXPECT_TRUE(mentions(sentence({"floor"}), "this is not a name, an axis and a position"));
  EXPECT_TRUE(mentions(sentence({"drum=cylinder:3"}), "the axis is not x, y or z"));
  EXPECT_TRUE(mentions(sentence({"drum=cylinder:3"}), "Cylinders, cones and inclined planes"));
  EXPECT_TRUE(mentions(sentence({"floor=y:low"}), "the position is not a number"));
  EXPECT_TRUE(mentions(sentence({"a=y:0", "a=y:1"}), "a (y = 0) and a (y = 1)"));
  EXPECT_TRUE(mentions(sentence({"floor=y:0", "left=x:0"}),
                       "--wall left (x = 0): the cell is periodic along x"));
  auto s = two_discs(0.05, "pp ff pp", "id type mass radius x y vx vy omegaz v_ax v_ay");
  s.files.columns = "i=2,j=3,dist=4,force=5,tangential=8";
  s.walls = {"floor=y:0"};
  EXPECT_TRUE(mentions(refusal(s).sentence, "the archive has no forces on grains"));
}

/// Archives that the programs wrote (tests/inputs/README.md).
class WallsOfTrueArchives : public testing::Test {
 protected:
  Folder folder;

  ImportSettings archive(const std::string& format, const std::string& name) const
  {
    ImportSettings s;
    s.format = format;
    s.files.grains = {inputs + format + "/" + name + "-atoms.dump.zst"};
    s.files.contacts = {inputs + format + "/" + name + "-contacts.dump.zst"};
    s.units = "si";
    s.step = 1e-5;
    s.gravity = "9.81";
    s.slope = 0;
    s.axes = "xz";
    s.output = folder / "run.h5";
    return s;
  }
};

TEST_F(WallsOfTrueArchives, ThatArePlanesCarryTheWeightOfDiscsPouredInBySixDigitsOfTheirForces)
{
  auto s = archive("lammps", "pour2d");
  s.gravity = "9.8";
  s.axes = "xy";
  s.walls = {"floor=y:0", "left=x:-0.04", "right=x:0.04"};
  EXPECT_EQ(import_archive(s, "").frames, 20u);
  const TrajectoryReader run(s.output);
  for (const std::size_t at_rest : {15U, 19U}) {
    const auto frame = frame_of<2>(s, at_rest);
    const auto [weight, force] = weight_and_force<2>(run.grains(), frame, {0, -9.8});
    // The components of a force have a relative error of at most 5e-6: 200 contacts of two rows each.
    EXPECT_NEAR((force_of_walls(frame) + weight - force).norm() / weight.norm(), 0, 400 * 5e-6);
    EXPECT_NEAR(force.norm() / weight.norm(), 0, 0.01);
  }
}

TEST_F(WallsOfTrueArchives, OfSpheresAreReadFromTheColumnsThatLammpsWroteAndBalanceExactly)
{
  auto s = archive("lammps", "pour3d");
  s.origin = "0";
  const auto report = import_archive(s, "");
  EXPECT_EQ(report.parameters.text("import_base"), "walls floor, sides");
  EXPECT_LT(report.parameters.number("import_residual_largest", ""), 1e-11);  // undamped: round-off
  const TrajectoryReader run(s.output);
  for (std::size_t k = 1; k < run.size(); ++k) {
    const auto frame = frame_of<3>(s, k);
    const auto [weight, force] = weight_and_force<3>(run.grains(), frame, {0, -9.81, 0});
    EXPECT_NEAR((force_of_walls(frame) + weight - force).norm() / weight.norm(), 0, 1e-10);
  }
}

TEST_F(WallsOfTrueArchives, AreInferredAsLammpsHadThemWhereAGrainTouchesOneAlone)
{
  auto s = archive("lammps", "pour3d");
  s.origin = "0";
  import_archive(s, "");
  const auto rows = frame_of<3>(s, 6);
  s.files.wall_columns = "none";
  s.walls = {"floor=z:0", "left=x:-0.02", "right=x:0.02"};
  s.overwrite = true;
  import_archive(s, "");
  const auto inferred = frame_of<3>(s, 6);
  const auto by_grain = [](const Frame<3>& frame) {
    std::map<int, std::vector<Vec3>> forces;
    for (std::size_t c = 0; c < frame.contacts.size(); ++c)
      if (frame.contacts.j[c] < 0) forces[frame.contacts.i[c]].push_back(frame.contacts.force[c]);
    return forces;
  };
  const auto expected = by_grain(rows), found = by_grain(inferred);
  EXPECT_EQ(expected.size(), found.size());
  std::size_t alone = 0;
  for (const auto& [grain, forces] : expected) {
    ASSERT_EQ(found.count(grain), 1u);
    if (forces.size() != 1) continue;
    ++alone;
    EXPECT_NEAR((forces[0] - found.at(grain)[0]).norm() / forces[0].norm(), 0, 1e-9);
  }
  EXPECT_GT(alone, 40u);
}

TEST_F(WallsOfTrueArchives, OfAHopperAreRowsThatCarryTheWeightWhileTheLidIsClosed)
{
  auto s = archive("liggghts", "hopper");
  s.files.columns = "pos,id,force,delta";
  s.files.wall_contacts = {inputs + "liggghts/hopper-walls.dump.zst"};
  s.origin = "0";
  s.cells = {"x:-0.03:0.03"};
  import_archive(s, "");
  const TrajectoryReader run(s.output);
  const auto at_rest = frame_of<3>(s, 10);  // step 80000
  const auto [weight, force] = weight_and_force<3>(run.grains(), at_rest, {0, -9.81, 0});
  EXPECT_NEAR((force_of_walls(at_rest) + weight).norm() / weight.norm(), 0, 0.01);
  const auto outflow = frame_of<3>(s, 12);
  const auto [less, falling] = weight_and_force<3>(run.grains(), outflow, {0, -9.81, 0});
  EXPECT_LT(less.norm(), 0.9 * weight.norm());
  EXPECT_LT(force_of_walls(outflow).y(), less.norm());
}

TEST_F(WallsOfTrueArchives, OfPrimitivesOfLiggghtsAreInferredOnceTheyAreNamed)
{
  auto s = archive("liggghts", "packing");
  s.files.columns = "id,force,delta";
  s.species.boundary = "none";
  s.origin = "0";
  EXPECT_EQ(refusal(s).code, exit_check);
  s.species.boundary.reset();
  s.origin = "top";
  s.walls = {"floor=z:0", "left=x:-0.02", "right=x:0.02"};
  import_archive(s, "");
  const TrajectoryReader run(s.output);
  const auto frame = frame_of<3>(s, run.size() - 1);
  const auto [weight, force] = weight_and_force<3>(run.grains(), frame, {0, -9.81, 0});
  EXPECT_NEAR((force_of_walls(frame) + weight).norm() / weight.norm(), 0, 0.01);
}

}  // namespace
}  // namespace grseg
