// SPDX-License-Identifier: GPL-3.0-or-later
// Fields: values of grains that set their colours.
#include "analysis/render/grain_field.hpp"

#include "formats/core/errors.hpp"
#include "tests/analysis/grain_builder.hpp"
#include "tests/folder.hpp"
#include "tests/three_grains.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace grseg {
namespace {

using std::numbers::pi;
using Kind = PartitionRule::Kind;

/// The run of three grains: a large one (row 0) on a boundary grain (row 2), a small one (row 1) on
/// the large one. Frame k is shifted by k mm along x; frames are 0.05 s apart.
class GrainFields : public TestInFolder {
 protected:
  void SetUp() override
  {
    TestInFolder::SetUp();
    three_grains::write(path("run.h5"), 3);
  }

  std::vector<double> values(const std::string& field, const PartitionRule& rule = {}) const
  {
    const TrajectoryReader run(path("run.h5"));
    const GrainField<2> of(parse_field(field), run, run.grains(), run.species(), rule);
    Frame<2> frame;
    run.read(2, frame, {.velocity = true, .contacts = true, .force = true});
    return of.values(frame);
  }
  std::string complaint(const std::string& field) const
  {
    return complaint_of<UsageError>([&] { values(field); });
  }
};

TEST_F(GrainFields, BoundaryGrainsHaveNoNumber)
{
  for (const auto& field : field_definitions()) {
    const auto all = values(std::string(field.word) + (field.needs_argument() ? ":0" : ""));
    ASSERT_EQ(all.size(), 3u);
    EXPECT_TRUE(std::isnan(all[2])) << field.word;
    EXPECT_FALSE(std::isnan(all[0])) << field.word;
  }
}

TEST_F(GrainFields, MotionIsThatOfTheFrame)
{
  EXPECT_DOUBLE_EQ(values("speed")[1], 0.5);  // (0.3, -0.4)
  EXPECT_DOUBLE_EQ(values("velocity")[1], 0.3);
  EXPECT_DOUBLE_EQ(values("velocity:y")[1], -0.4);
  EXPECT_DOUBLE_EQ(values("spin")[1], -2);
  EXPECT_DOUBLE_EQ(values("radius")[1], 0.0025);
}

// Traces of force (x) branch: 1.5e-6 N m between large and small, 1e-5 on the boundary grain, half
// of which is on the large grain's side of the contact point.
TEST_F(GrainFields, PressureIsHalfTheTraceOfTheGrainsShareOverItsArea)
{
  const double large = pi * 0.005 * 0.005, small = pi * 0.0025 * 0.0025;
  const auto by_size = values("pressure", {Kind::size});
  EXPECT_NEAR(by_size[0], (1e-6 + 5e-6) / (2 * large), 1e-14);
  EXPECT_NEAR(by_size[1], 0.5e-6 / (2 * small), 1e-14);
  const auto by_halves = values("pressure", {Kind::half});
  EXPECT_NEAR(by_halves[0], (0.75e-6 + 5e-6) / (2 * large), 1e-14);
  EXPECT_NEAR(by_halves[1], 0.75e-6 / (2 * small), 1e-14);
  EXPECT_EQ(values("pressure", {Kind::drop})[1], 0);
}

TEST_F(GrainFields, ContactsAreThoseThatBearAForce)
{
  EXPECT_EQ(values("contacts")[0], 2);
  EXPECT_EQ(values("contacts")[1], 1);
}

// The order of the grains of a pair without a force does not matter.
TEST_F(GrainFields, APairWithoutAForceMayNameTheBoundaryGrainFirst)
{
  const TrajectoryReader run(path("run.h5"));
  const GrainField<2> of(parse_field("contacts"), run, run.grains(), run.species(), {});
  auto frame = three_grains::frame(1);
  frame.contacts.i.push_back(2);
  frame.contacts.j.push_back(1);
  frame.contacts.force.push_back({0, 0});
  frame.contacts.branch.push_back({0, -0.0175});
  frame.contacts.gap.push_back(0.01);
  EXPECT_EQ(of.values(frame)[0], 2);
  EXPECT_EQ(of.values(frame)[1], 1);
  frame.contacts.force.back() = {0, -1e-4};
  EXPECT_THROW(of.values(frame), FormatError);
}

// Two frames later all grains have moved by 2 mm; the large grain has also crossed the cell once, in
// all frames.
TEST_F(GrainFields, DisplacementsCountFromTheTimeGiven)
{
  EXPECT_NEAR(values("displacement:0")[0], 0.002, 1e-15);
  EXPECT_NEAR(values("displacement:0.05")[1], 0.001, 1e-15);
  EXPECT_EQ(values("rise:0")[0], 0);
}

TEST_F(GrainFields, DisplacementsCountThePeriodsThatWereCrossed)
{
  const TrajectoryReader run(path("run.h5"));
  const GrainField<2> of(parse_field("displacement:0"), run, run.grains(), run.species(), {});
  auto frame = three_grains::frame(1);
  frame.image[1] = {2, 0};
  EXPECT_NEAR(of.values(frame)[1], 2 * 0.35 + 0.001, 1e-15);
}

// The archive of an import may not record how often grains have crossed a period; displacements are
// then unknown. Heights are known all the same.
TEST_F(GrainFields, DisplacementsOfAnImportThatCountsNoPeriodsAreRefused)
{
  const auto write = [&](const std::string& images) {
    auto told = three_grains::description();
    told.parameters.texts["import_format"] = "lammps";
    if (!images.empty()) told.parameters.texts["import_images"] = images;
    TrajectoryWriter writer(path("run.h5"), told, {});
    for (int k = 0; k < 3; ++k) writer.append(three_grains::frame(k), std::vector<double>{0});
    writer.close();
  };
  for (const auto* images : {"unknown", ""}) {  // "": imports of earlier versions do not state it
    write(images);
    EXPECT_EQ(
        complaint("displacement:0"),
        "--color displacement:0: " + path("run.h5") +
            " does not store how often grains have crossed its periods; import the run again, from "
            "a dump with the columns ix iy iz or xu yu zu, or choose rise:0");
    EXPECT_EQ(values("rise:0")[0], 0);
  }
  write("known");
  EXPECT_NEAR(values("displacement:0")[0], 0.002, 1e-15);
}

TEST_F(GrainFields, CompositionReachesNoFurtherThanAPeriod)
{
  EXPECT_EQ(complaint("composition:36dL"),
            "--color composition:36dL: 0.36 m is longer than the period along x, which is 0.35 m");
  EXPECT_EQ(values("composition:35dL").size(), 3u);
}

TEST_F(GrainFields, TitlesSayWhatIsShownAndItsUnit)
{
  const TrajectoryReader run(path("run.h5"));
  const auto title = [&](const std::string& field) {
    return GrainField<2>(parse_field(field), run, run.grains(), run.species(), {Kind::half})
        .title();
  };
  EXPECT_EQ(title("speed"), "speed, m/s");
  EXPECT_EQ(title("pressure"), "pressure (rule: half), N/m");
  EXPECT_EQ(title("composition:4dS"), "share of large within 4dS");
  EXPECT_EQ(title("displacement:0.05"), "displacement since t = 0.05 s, m");
  EXPECT_EQ(title("contacts"), "contacts");
}

TEST_F(GrainFields, WhatIsNoFieldIsRefusedWithAWord)
{
  EXPECT_EQ(complaint("sped").substr(0, 24), "unknown --color 'sped', ");
  EXPECT_EQ(complaint("speed:3"), "--color speed:3: speed takes no argument");
  EXPECT_EQ(complaint("rise"), "--color rise: give the time to compare with, as in rise:0");
  EXPECT_EQ(complaint("rise:x"), "--color rise:x: 'x' is not a time");
  EXPECT_EQ(complaint("velocity:z"), "--color velocity:z: the components of this run are x and y");
  EXPECT_EQ(complaint("displacement:7"),
            "--color displacement:7: " + path("run.h5") + " goes from 5e-05 s to 0.10005 s");
}

TEST_F(GrainFields, AnInstantTakesTheNearestFrame)
{
  const TrajectoryReader run(path("run.h5"));  // 0.00005, 0.05005, 0.10005 s
  EXPECT_EQ(frame_nearest(run, 0, ""), 0u);
  EXPECT_EQ(frame_nearest(run, 0.025, ""), 0u);
  EXPECT_EQ(frame_nearest(run, 0.0251, ""), 1u);
  EXPECT_EQ(frame_nearest(run, 0.14, ""), 2u);
  EXPECT_EQ(complaint_of<UsageError>([&] { frame_nearest(run, 0.16, "--at 0.16"); }),
            "--at 0.16: " + path("run.h5") + " goes from 5e-05 s to 0.10005 s");
}

const Box wide{.length_x = 100, .length_y = 10, .periodic_x = true};

/// Lucy's function of u = r/R.
double lucy(double u)
{
  return (1 + 3 * u) * std::pow(1 - u, 3);
}

TEST(LocalComposition, WeighsGrainsByAreaAndDistance)
{
  Packing packing;
  packing.grain(Species::small, 1, {10, 0});
  packing.grain(Species::large, 2, {13, 0});  // u = 3/6
  packing.grain(Species::large, 2, {16, 0});  // u = 1: too far
  packing.grain(Species::boundary, 2, {10, -3});
  const auto share = local_composition<2>(packing.grains, packing.frame, wide, Species::large, 6);
  EXPECT_NEAR(share[0], 4 * lucy(0.5) / (lucy(0) + 4 * lucy(0.5)), 1e-15);
  EXPECT_TRUE(std::isnan(share[3]));
}

TEST(LocalComposition, ReachesAcrossThePeriods)
{
  PackingOf<3> packing;
  packing.grain(Species::small, 1, {1, 5, 1});
  packing.grain(Species::large, 1, {99, 5, 9});  // (2, 0, 2) away, periods 100 and 10
  const Box box{.length_x = 100,
                .length_y = 10,
                .periodic_x = true,
                .dimension = 3,
                .length_z = 10,
                .periodic_z = true};
  const double weight = lucy(std::sqrt(8.0) / 4);
  for (const auto grain : {0u, 1u}) {
    const auto share = local_composition<3>(packing.grains, packing.frame, box, Species::large, 4);
    const double expected = grain == 0 ? weight / (1 + weight) : 1 / (1 + weight);
    EXPECT_NEAR(share[grain], expected, 1e-15);
  }
}

// The other grain is at 2, its image at 8 on the other side; the grain's own images are at 10.
TEST(LocalComposition, InAShortCellImagesCountToo)
{
  Packing packing;
  packing.grain(Species::small, 1, {1, 0});
  packing.grain(Species::large, 1, {3, 0});
  const Box box{.length_x = 10, .length_y = 10, .periodic_x = true};
  const auto share = local_composition<2>(packing.grains, packing.frame, box, Species::large, 10);
  const double others = lucy(0.2) + lucy(0.8);
  EXPECT_NEAR(share[0], others / (1 + others), 1e-15);
}

// Compared with the sum over all pairs, with grains below and above y = 0 and images along both periods.
TEST(LocalComposition, IsTheSumOverAllPairs)
{
  PackingOf<3> packing;
  for (int k = 0; k < 60; ++k)
    packing.grain(
        k % 3 == 0 ? Species::large : Species::small, 0.1 + 0.01 * (k % 7),
        {std::fmod(0.618 * k, 5.0), std::fmod(1.37 * k, 8.0) - 4, std::fmod(0.271 * k, 3.0)});
  const Box box{.length_x = 5,
                .length_y = 10,
                .periodic_x = true,
                .dimension = 3,
                .length_z = 3,
                .periodic_z = true};
  const double radius = 2;  // beyond half the period along z
  const auto share =
      local_composition<3>(packing.grains, packing.frame, box, Species::large, radius);
  for (std::size_t i = 0; i < 60; ++i) {
    double part = 0, all = 0;
    for (std::size_t j = 0; j < 60; ++j)
      for (int x = -1; x <= 1; ++x)
        for (int z = -1; z <= 1; ++z) {
          const Vec3 between =
              packing.frame.position[j] + Vec3(5 * x, 0, 3 * z) - packing.frame.position[i];
          if (between.norm() >= radius) continue;
          const double weight =
              std::pow(packing.grains.radius[j], 3) * lucy(between.norm() / radius);
          all += weight;
          if (packing.grains.species[j] == Species::large) part += weight;
        }
    EXPECT_NEAR(share[i], part / all, 1e-13) << i;
  }
}

}  // namespace
}  // namespace grseg
