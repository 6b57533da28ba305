// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/trajectory/reader.hpp"
#include "tests/formats/import/lammps_text.hpp"

#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace grseg {
namespace {

using namespace lammps_text;

constexpr const char* recipe = "i=2,j=3,dist=4,force=5,tangential=8";

constexpr const char* without_forces = "id type mass radius x y vx vy omegaz";

std::vector<std::string> rows_without_forces()
{
  auto rows = grain_rows();
  for (auto& row : rows)
    for (int k = 0; k < 2; ++k) row.resize(row.rfind(' '));
  return rows;
}

class Lammps : public testing::Test {
 protected:
  Folder folder;

  Frame<2> frame_of(const ImportSettings& s, std::size_t index = 0)
  {
    import_archive(s, "grseg-import");
    const TrajectoryReader run(s.output);
    Frame<2> frame;
    run.read(index, frame, {.velocity = true, .contacts = true, .force = true});
    return frame;
  }
  ImportSettings at_rest()
  {
    return settings(folder, grains_at(0) + grains_at(100), contacts_at(0) + contacts_at(100));
  }
};

TEST_F(Lammps, ForceOnTheFirstGrainIsTheNormalPlusTheTangentialPart)
{
  const auto frame = frame_of(at_rest());
  const auto& contacts = frame.contacts;  // rows: 0 small (id 4), 1 large (7), 2 base (9)
  ASSERT_EQ(contacts.i, (std::vector<std::int32_t>{0, 1}));
  ASSERT_EQ(contacts.j, (std::vector<std::int32_t>{1, 2}));
  EXPECT_TRUE(contacts.force[0].isApprox(small_mass * Vec2(-gx, -gy)));
  EXPECT_TRUE(contacts.force[1].isApprox((small_mass + large_mass) * Vec2(-gx, -gy)));
  EXPECT_NEAR(contacts.gap[0], 0, 1e-17);
}

// property/local lists the grains of a pair in any order; the force is on the one named patom1, and
// the sign of dx depends on tags.
TEST_F(Lammps, BranchPointsFromTheSecondGrainToTheFirstWhateverDxSays)
{
  auto rows = contact_rows();
  rows[0] = contact_row(4, 7, 0.0075, small_mass, true) + " 0 0.0075 0";
  rows[1] += " 0 -0.01 0";
  auto s = settings(folder, grains_at(0),
                    block("ENTRIES", 0, contact_columns + " c_dx[1] c_dx[2] c_dx[3]", rows));
  s.files.columns = recipe;
  const auto frame = frame_of(s);
  EXPECT_TRUE(frame.contacts.branch[0].isApprox(Vec2(0, -0.0075)));
  EXPECT_TRUE(frame.contacts.force[0].isApprox(small_mass * Vec2(gx, gy)));
  EXPECT_EQ(frame.contacts.i[0], 1);
  EXPECT_TRUE(frame.contacts.branch[1].isApprox(Vec2(0, 0.01))) << "i is the mobile one";
  EXPECT_EQ(frame.contacts.i[1], 1);
}

TEST_F(Lammps, NormalForcesAloneAreRefusedAndTheColumnsThatFitAreNamed)
{
  auto s = at_rest();
  s.files.columns = "i=2,j=3,dist=4,force=5";
  const auto refused = refusal(s);
  EXPECT_EQ(refused.code, exit_check);
  EXPECT_TRUE(mentions(refused.sentence, "the forces on grain 7 do not add up"));
  EXPECT_TRUE(
      mentions(refused.sentence, "with --columns i=2,j=3,force=5,tangential=8 they balance"));
  EXPECT_EQ(folder.files(), 2u) << "nothing is written";
}

// Headers are c_pl[3]: thirteen columns may be the ten of the recipe with others between them.
TEST_F(Lammps, TheRecipeIsAcceptedOnlyWhereGrainsBalance)
{
  EXPECT_EQ(import_archive(at_rest(), "").parameters.text("import_columns"), recipe);
  std::vector<std::string> rows;
  for (auto row : contact_rows()) rows.push_back(row.insert(row.find(" 0.0"), " 2 3"));
  auto s = settings(folder, grains_at(0),
                    block("ENTRIES", 0, contact_columns + " c_pl[8] c_pl[9]", rows));
  s.overwrite = true;
  const auto refused = refusal(s);
  EXPECT_EQ(refused.code, exit_check);
  EXPECT_TRUE(mentions(refused.sentence, "with --columns i=2,j=3,force=7,tangential=10 they"));
  s.files.columns = "i=2,j=3,dist=6,force=7,tangential=10";
  EXPECT_EQ(refusal(s).code, 0) << refusal(s).sentence;
}

TEST_F(Lammps, FewerThanTheTenColumnsNeedAMapping)
{
  auto s = settings(folder, grains_at(0),
                    block("ENTRIES", 0, "index a b c d", {"1 4 7 0 0", "2 7 9 0 0"}));
  EXPECT_EQ(refusal(s).code, exit_usage);
  EXPECT_TRUE(mentions(refusal(s).sentence,
                       "--columns MAP  (they are index a b c d; as in i=2,j=3,dist=4"));
}

TEST_F(Lammps, ColumnsMayBeGivenByNameAndOneByOne)
{
  auto s = at_rest();
  s.files.columns = "i=c_pr[1],j=c_pr[2],fx=c_pl[2],fy=c_pl[3],tx=8,ty=9";
  EXPECT_EQ(refusal(s).code, 0) << refusal(s).sentence;
  s.overwrite = true;
  s.files.columns = "i=c_pr[1],j=c_pr[7],force=5";
  EXPECT_TRUE(mentions(refusal(s).sentence, "j=c_pr[7], but"));
}

TEST_F(Lammps, ColumnsNamedByTheirMeaningNeedNoMapping)
{
  auto s = settings(folder, grains_at(0),
                    block("ENTRIES", 0, "index i j dist fx fy fz tx ty tz", contact_rows()));
  EXPECT_EQ(import_archive(s, "").parameters.text("import_columns"),
            "i=i,j=j,fx=fx,fy=fy,fz=fz,tx=tx,ty=ty,tz=tz,dist=dist");
}

TEST_F(Lammps, ForceOnTheOtherGrainIsDetected)
{
  auto s = at_rest();
  s.files.columns = "i=3,j=2,dist=4,force=5,tangential=8";
  const auto refused = refusal(s);
  EXPECT_EQ(refused.code, exit_check);
  EXPECT_TRUE(mentions(refused.sentence, "contacts pull: 100 %"));
  EXPECT_TRUE(mentions(refused.sentence,
                       "with the opposite sign: the force seems to be that on "
                       "j"));
}

TEST_F(Lammps, ContactsInTwoRowsAreDetected)
{
  auto rows = contact_rows();
  rows.push_back(contact_row(4, 7, 0.0075, small_mass, true));
  const auto s = settings(folder, grains_at(0), block("ENTRIES", 0, contact_columns, rows));
  EXPECT_TRUE(mentions(refusal(s).sentence, "the contact of grains 4 and 7 appears twice"));
}

TEST_F(Lammps, ContactsOfBaseGrainsAmongThemselvesAreLeftOut)
{
  auto grains = grain_rows();
  grains.push_back(fmt::format("2 3 {} 0.005 0.06 -0.005 0 0 0 0 0", large_mass));
  auto contacts = contact_rows();
  contacts.emplace_back("3 2 9 0.01 0 0 0 0 0 0");
  const auto frame = frame_of(settings(folder, block("ATOMS", 0, grain_columns, grains),
                                       block("ENTRIES", 0, contact_columns, contacts)));
  EXPECT_EQ(frame.contacts.size(), 2u);
  EXPECT_EQ(frame.position.size(), 4u);
}

// If `fix freeze` is before `fix gravity`, the force m g remains on frozen grains, otherwise zero.
TEST_F(Lammps, ForcesOnFrozenGrainsCountForNothing)
{
  const auto frame = frame_of(at_rest());
  EXPECT_EQ(frame.force[2], Vec2(0, 0));
}

// Contacts of fix wall/gran are in no dump local.
TEST_F(Lammps, AGrainOnAWallThatIsNotInTheDumpDoesNotBalance)
{
  auto grains = grain_rows();
  grains.push_back(fmt::format("2 2 {} 0.005 0.08 0.005 0 0 0 0 0", large_mass));
  const auto s = settings(folder, block("ATOMS", 0, grain_columns, grains), contacts_at(0));
  EXPECT_EQ(refusal(s).code, exit_check);
  EXPECT_TRUE(mentions(refusal(s).sentence, "the forces on grain 2 do not add up"));
}

TEST_F(Lammps, ABalanceToFivePercentIsAcceptedAndMoreOnlyOnRequest)
{
  const auto missing = [&](double part) {
    auto contacts = contact_rows();
    contacts[1] = contact_row(7, 9, 0.01, (1 - part) * (small_mass + large_mass));
    return settings(folder, grains_at(0), block("ENTRIES", 0, contact_columns, contacts));
  };
  const auto report = import_archive(missing(0.04), "");
  EXPECT_NEAR(report.parameters.number("import_residual_largest", ""), 0.04 / (1 - 0.04), 1e-12);
  EXPECT_EQ(report.parameters.number("import_residual_median", ""),
            report.parameters.number("import_residual_largest", ""))
      << "of two grains the upper";
  auto s = missing(0.06);
  s.overwrite = true;
  EXPECT_EQ(refusal(s).code, exit_check);
  EXPECT_TRUE(mentions(refusal(s).sentence, "--accept-residual balance=R"));
  s.accept_residual = {"0.07"};
  EXPECT_EQ(refusal(s).code, 0);
}

// Discs need density/disc in LAMMPS, otherwise they get the mass of spheres.
TEST_F(Lammps, MassesDistinguishDiscsFromSpheres)
{
  auto s = at_rest();
  s.grains = "spheres";
  s.strict = true;
  EXPECT_TRUE(mentions(refusal(s).sentence, "masses grow as the square of the radius"));
  import_archive(at_rest(), "");
  const TrajectoryReader run(s.output);
  EXPECT_EQ(run.parameters().text("import_grains"), "discs");
  EXPECT_NEAR(run.parameters().number("density", ""), 1, 1e-12);
}

TEST_F(Lammps, AnArchiveWithoutForcesOnGrainsMakesATrajectoryWithoutThem)
{
  auto s = at_rest();
  std::string grains;
  for (const int step : {0, 100})
    grains += block("ATOMS", step, without_forces, rows_without_forces());
  s.files.grains = {folder.write("atoms.dump", grains)};
  EXPECT_EQ(refusal(s).code, exit_usage) << "nothing to hold the ten columns against";
  s.files.columns = recipe;
  const auto report = import_archive(s, "");
  EXPECT_LT(report.parameters.number("import_residual_largest", ""), 1e-15)
      << "grains stay at rest";
  EXPECT_FALSE(TrajectoryReader(s.output).has_force());
  s.overwrite = true;
  s.files.columns = "i=2,j=3,dist=4,force=5";
  EXPECT_TRUE(mentions(refusal(s).sentence, "difference of velocities between two frames"));
}

// The columns of a dump may change from job to job.
TEST_F(Lammps, AngularVelocitiesAreMissingIfTheFirstFrameLacksThem)
{
  const auto without = [](int step) {
    auto rows = grain_rows();
    for (auto& row : rows) row.erase(row.find(" 0 0 0 "), 2);
    return block("ATOMS", step, "id type mass radius x y vx vy fx fy", rows);
  };
  const auto text_of = [&](const std::string& first, const std::string& last) {
    auto s = at_rest();
    s.files.grains = {folder.write("atoms.0.dump", first), folder.write("atoms.100.dump", last)};
    s.overwrite = true;
    return to_text(import_archive(s, ""));
  };
  const std::string remark = "the archive has no angular velocities; they are written as 0";
  EXPECT_TRUE(mentions(text_of(without(0), grains_at(100)), remark));
  EXPECT_FALSE(mentions(text_of(grains_at(0), without(100)), remark));
}

TEST_F(Lammps, TimesThatGoBackAreRefused)
{
  const auto at = [](const char* time, int step) {
    return fmt::format("ITEM: TIME\n{}\n", time) + grains_at(step);
  };
  const auto s = settings(folder, at("0", 0) + at("0.001", 100) + at("0.0005", 200),
                          contacts_at(0) + contacts_at(100) + contacts_at(200));
  EXPECT_EQ(refusal(s).code, exit_content);
  EXPECT_TRUE(mentions(refusal(s).sentence, "step 200 at 0.0005 comes after step 100 at 0.001"));
  EXPECT_EQ(folder.files(), 2u);
}

TEST_F(Lammps, FramesAreMatchedByStepAndTimedByIt)
{
  const auto s = settings(folder, grains_at(0) + grains_at(100) + grains_at(300),
                          contacts_at(50) + contacts_at(100) + contacts_at(200) + contacts_at(300));
  const auto report = import_archive(s, "");
  EXPECT_EQ(report.frames, 2u);
  EXPECT_EQ(report.remarks.size(), 3u);  // a frame of grains alone, two of contacts; few digits
  const TrajectoryReader run(s.output);
  EXPECT_EQ(run.steps(), (std::vector<std::int64_t>{100, 300}));
  EXPECT_EQ(run.times(), (std::vector<double>{100 * 1e-5, 300 * 1e-5}));
  EXPECT_NEAR(run.parameters().number("frame_interval", ""), 0.002, 1e-15);
}

TEST_F(Lammps, RowsStandInAnyOrder)
{
  auto rows = grain_rows();
  std::string grains = block("ATOMS", 0, grain_columns, rows);
  std::reverse(rows.begin(), rows.end());
  grains += block("ATOMS", 100, grain_columns, rows);
  const auto s = settings(folder, grains, contacts_at(0) + contacts_at(100));
  import_archive(s, "");
  const TrajectoryReader run(s.output);
  EXPECT_EQ(run.grains().id, (std::vector<std::int32_t>{4, 7, 9}));
  EXPECT_EQ(run.grains().species, (std::vector{Species::small, Species::large, Species::boundary}));
  Frame<2> first, second;
  run.read(0, first);
  run.read(1, second);
  EXPECT_EQ(first.position, second.position);
}

TEST_F(Lammps, APairAcrossThePeriodicBoundaryIsCloseTogether)
{
  auto grains = grain_rows();
  grains[1] = fmt::format("4 1 {} 0.0025 0.0995 0.012433034373659253 0 0 0 0 0", small_mass);
  grains[2] = fmt::format("7 2 {} 0.005 0.0005 0.005 0 0 0 0 0", large_mass);
  grains[0] = fmt::format("9 3 {} 0.005 0.0005 -0.005 0 0 0 0 0", large_mass);
  auto s = settings(folder, block("ATOMS", 0, grain_columns, grains), contacts_at(0));
  s.files.columns = recipe;
  auto frame = frame_of(s);
  EXPECT_TRUE(frame.contacts.branch[0].isApprox(Vec2(-0.001, 0.007433034373659253)));

  s = settings(folder, block("ATOMS", 0, grain_columns, grains, "ff ff pp"), contacts_at(0));
  s.overwrite = true;
  EXPECT_TRUE(mentions(refusal(s).sentence, "is the cell periodic"));
}

TEST_F(Lammps, UnwrappedPositionsAreWrappedAndTheirPeriodsCounted)
{
  auto rows = grain_rows(0.05 - 0.1 * 3);
  const auto s =
      settings(folder, block("ATOMS", 0, "id type mass radius xu yu vx vy omegaz fx fy", rows),
               contacts_at(0));
  const auto frame = frame_of(s);
  EXPECT_NEAR(frame.position[0].x(), 0.05, 1e-15);
  EXPECT_EQ(frame.image[0][0], -3);
}

TEST_F(Lammps, GivenPeriodsAreKept)
{
  auto rows = grain_rows();
  for (auto& row : rows) row += " -2";
  const auto frame =
      frame_of(settings(folder, block("ATOMS", 0, grain_columns + " ix", rows), contacts_at(0)));
  EXPECT_NEAR(frame.position[0].x(), 0.05, 1e-17);
  EXPECT_EQ(frame.image[0][0], -2);
}

TEST_F(Lammps, HeightsCountFromTheTopOfTheBaseItsCentresOrAGivenPlace)
{
  auto s = at_rest();
  s.overwrite = true;
  EXPECT_NEAR(frame_of(s).position[1].y(), 0.005, 1e-17);
  s.origin = "centre";
  EXPECT_NEAR(frame_of(s).position[1].y(), 0.010, 1e-17);
  s.origin = "0.001";
  EXPECT_NEAR(frame_of(s).position[1].y(), 0.004, 1e-17);
}

TEST_F(Lammps, AllThatIsMissingIsNamedInOneSentence)
{
  auto s = at_rest();
  s.units.reset();
  s.step.reset();
  s.gravity.reset();
  s.species.boundary.reset();
  const auto refused = refusal(s);
  EXPECT_EQ(refused.code, exit_usage);
  for (const char* option : {"--units", "--step", "--gravity", "--boundary"})
    EXPECT_TRUE(mentions(refused.sentence, option));
  EXPECT_FALSE(mentions(refused.sentence, "--density")) << "masses are in the archive";
}

TEST_F(Lammps, MassesThatAreNotThereAreAskedFor)
{
  auto s = settings(folder,
                    block("ATOMS", 0, "id type diameter x y vx vy omegaz fx fy",
                          {"9 3 0.01 0.05 -0.005 0 0 0 0 0", "4 1 0.005 0.05 0.0125 0 0 0 0 0",
                           "7 2 0.01 0.05 0.005 0 0 0 0 0"}),
                    contacts_at(0));
  s.grains = "discs";
  EXPECT_EQ(refusal(s).code, exit_usage);
  EXPECT_TRUE(mentions(refusal(s).sentence, "the masses of the grains: --density RHO"));
  s.density = 1;
  EXPECT_EQ(refusal(s).code, 0) << refusal(s).sentence;
}

TEST_F(Lammps, ADensityBesideMassesHasToBeTheirs)
{
  auto s = settings(folder, grains_at(0), contacts_at(0));
  s.density = 2;
  EXPECT_TRUE(mentions(refusal(s).sentence,
                       "--density is 2, but the masses in the archive correspond to 1 "
                       ""));
  s.density = 1;
  EXPECT_EQ(refusal(s).code, 0) << refusal(s).sentence;
}

TEST_F(Lammps, TheBaseIsAskedForAlsoBesideWallsWhereGrainsNeverMove)
{
  auto moving = grain_rows();
  for (const std::size_t g : {1U, 2U})
    moving[g].replace(moving[g].find(" 0 0 0 0 0"), 10, " 1 0 0 0 0");
  auto s = settings(folder, block("ATOMS", 0, grain_columns, moving), contacts_at(0));
  s.species.boundary.reset();
  s.walls = {"lid=y:0.09"};
  EXPECT_TRUE(mentions(refusal(s).sentence, "which grains are the base: --boundary 3"));
  s.species.boundary = "3";
  EXPECT_EQ(refusal(s).code, 0) << refusal(s).sentence;
}

TEST_F(Lammps, DimensionlessUnitsMustBeGiven)
{
  auto s = settings(folder, "ITEM: UNITS\nlj\n" + grains_at(0), contacts_at(0));
  s.units.reset();
  EXPECT_TRUE(
      mentions(refusal(s).sentence, "the size of its units 'lj': --units LENGTH:TIME:MASS"));
  s.units = "0.5:0.1:2";
  const auto frame = frame_of(s);
  EXPECT_NEAR(frame.position[1].y(), 0.005 * 0.5, 1e-17);
  EXPECT_NEAR(frame.contacts.force[0].y(), -small_mass * gy * 2 * 0.5 / 0.01, 1e-12);
  const TrajectoryReader run(s.output);
  EXPECT_NEAR(run.gravity<2>().start.x(), gx * 0.5 / 0.01, 1e-10);
  EXPECT_NEAR(run.step(), 1e-6, 1e-20);
  EXPECT_NEAR(run.small_diameter(), 0.0025, 1e-17);
}

// An archive that Debian's lammps wrote for chute.in, whose gran/hooke has gamma_n = 100 and
// gamma_t = 50, and one without damping.
TEST_F(Lammps, TheMissingForceOfARealArchiveIsTheDampingOfItsInput)
{
  ImportSettings s;
  s.format = "lammps";
  const std::string at = GRSEG_TEST_INPUTS "/lammps/";
  s.files.grains = {at + "atoms.dump"};
  s.files.contacts = {at + "contacts.dump"};
  s.files.columns = "i=2,j=3,dist=6,force=7,tangential=10";
  s.units = "si";
  s.step = 1e-5;
  s.gravity = "3.8291634756966717,-9.020948235988865,0";
  s.species.boundary = "3";
  s.output = folder / "run.h5";
  const auto damped = import_archive(s, "");
  EXPECT_EQ(damped.frames, 7u);
  EXPECT_LT(damped.parameters.number("import_residual_largest", ""), 2e-3);
  EXPECT_LT(damped.parameters.number("import_residual_unexplained", ""),
            damped.parameters.number("import_residual_largest", "") / 3);
  EXPECT_NEAR(damped.parameters.numbers.at("import_late_damping")[0], 100, 1);
  EXPECT_NEAR(damped.parameters.numbers.at("import_late_damping")[1], 50, 10);

  s.files.grains = {at + "elastic-atoms.dump.gz"};
  s.files.contacts = {at + "elastic-contacts.dump.zst"};
  s.overwrite = true;
  const auto elastic = import_archive(s, "");
  EXPECT_EQ(elastic.frames, 4u);
  EXPECT_LT(elastic.parameters.number("import_residual_largest", ""), 1e-13);
}

// With `dump_modify colname`, or a script, columns have names: fn and ft are the parts of the force,
// t1 and t2 something else.
TEST_F(Lammps, ColumnsMayBeNamedAsPeopleNameThem)
{
  for (const char* names : {"n id1 id2 distance fnx fny fnz ftx fty ftz",
                            "Index iD_1 ID_2 dist Fn_x Fn_y Fn_z Ft_x Ft_y Ft_z",
                            "index patom1 patom2 dist fx fy fz p1 p2 p3",
                            "t1 particle1 particle2 t2 fx fy fz ftx fty ftz"}) {
    auto s = settings(folder, grains_at(0), block("ENTRIES", 0, names, contact_rows()));
    s.overwrite = true;
    EXPECT_EQ(refusal(s).code, 0) << names << ": " << refusal(s).sentence;
  }
  auto s = settings(folder, grains_at(0),
                    block("ENTRIES", 0, "n id1 id2 dist fnx fny fnz ftx fty ftz", contact_rows()));
  s.overwrite = true;
  EXPECT_EQ(import_archive(s, "").parameters.text("import_columns"),
            "i=id1,j=id2,fx=fnx,fy=fny,fz=fnz,tx=ftx,ty=fty,tz=ftz,dist=dist");
}

TEST_F(Lammps, IdsThatATrajectoryCannotHoldAreNumberedAndKeptBeside)
{
  std::vector<std::string> grains, contacts;
  for (const auto& row : grain_rows()) grains.push_back("400000000" + row);
  contacts.push_back("1 4000000004 4000000007" + contact_rows()[0].substr(5));
  contacts.push_back("1 4000000009 4000000007" + contact_rows()[1].substr(5));
  auto s = settings(folder, block("ATOMS", 0, grain_columns, grains),
                    block("ENTRIES", 0, contact_columns, contacts));
  const auto report = import_archive(s, "");
  EXPECT_TRUE(
      mentions(fmt::format("{}", fmt::join(report.remarks, " ")), "/parameters/import_ids"));
  const TrajectoryReader run(s.output);
  EXPECT_EQ(run.grains().id, (std::vector<std::int32_t>{1, 2, 3}));
  EXPECT_EQ(run.parameters().numbers.at("import_ids"),
            (std::vector<double>{4000000004, 4000000007, 4000000009}));
  EXPECT_EQ(run.grains().radius[0], 0.0025);
  s.overwrite = true;
  s.species.boundary.reset();
  s.species.boundary_ids = "4000000009";
  EXPECT_EQ(refusal(s).code, 0) << refusal(s).sentence;
}

TEST_F(Lammps, TypesThatAreWordsNameSpeciesAndBase)
{
  const auto typed = [](std::string text) {
    for (const auto& [number, word] :
         {std::pair{"9 3 ", "9 base "}, {"4 1 ", "4 fine "}, {"7 2 ", "7 coarse "}})
      text.replace(text.find(number), 4, word);
    return text;
  };
  auto s = settings(folder, typed(grains_at(0)), contacts_at(0));
  s.overwrite = true;
  s.species.boundary = "base";
  s.species.named = {"c=coarse", "f=fine"};
  EXPECT_EQ(refusal(s).code, 0) << refusal(s).sentence;
  const TrajectoryReader run(s.output);
  EXPECT_EQ(run.species()[0].name + run.species()[1].name, "fc");
  EXPECT_EQ(run.parameters().text("import_base"), "types base");
  s.species.boundary = "bsae";
  EXPECT_TRUE(mentions(refusal(s).sentence, "'bsae'"));
  s.species.boundary.reset();
  EXPECT_TRUE(mentions(refusal(s).sentence, "type base: 1 grain"));
  s.species.boundary = "base";
  s.species.named = {"f=fine"};
  EXPECT_TRUE(mentions(refusal(s).sentence, "type coarse of grain 7 is in no --species"));
}

}  // namespace
}  // namespace grseg
