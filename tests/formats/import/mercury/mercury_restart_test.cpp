// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/import/common/archive.hpp"
#include "formats/import/common/frame_tools.hpp"
#include "tests/formats/import/archive_balance.hpp"
#include "tests/formats/import/lammps_text.hpp"
#include "tests/formats/import/mercury/mercury_restart_files.hpp"

#include <gtest/gtest.h>

namespace grseg {
namespace {

using namespace archive_balance;
using mercury_files::RestartStyle;

/// Frames of the sample run with a wall under one grain, as .restart files of MercuryDPM.
class MercuryRestarts : public testing::Test {
 protected:
  TrajectoryReader run{GRSEG_TEST_INPUTS "/../../data/sample/chute.h5"};
  lammps_text::Folder folder;
  std::vector<Frame<2>> frames;
  std::size_t leaning = 0;  // row of the grain on the wall
  double reach = 0;         // distance of this grain's centre from the wall

  void SetUp() override
  {
    while (run.grains().fixed[leaning]) ++leaning;
    reach = run.grains().radius[leaning] - 1e-5;
    for (const std::size_t k : {5U, 6U, 7U}) {
      Frame<2> frame;
      run.read(k, frame);
      place_contacts(frame);
      frame.contacts.i.push_back(static_cast<std::int32_t>(leaning));
      frame.contacts.j.push_back(-3);
      frame.contacts.force.emplace_back(-0.01, 0.03);
      frame.contacts.gap.push_back(-1e-5);
      frame.contacts.branch.emplace_back(0, reach);
      add_forces(frame);
      frames.push_back(frame);
    }
  }
  /// Moves contacts to match the positions, because the sample is in single precision.
  void place_contacts(Frame<2>& frame) const
  {
    const auto& radius = run.grains().radius;
    for (std::size_t c = 0; c < frame.contacts.size(); ++c) {
      const auto i = static_cast<std::size_t>(frame.contacts.i[c]);
      const auto j = static_cast<std::size_t>(frame.contacts.j[c]);
      Vec3 between = Vec3::Zero();
      between.head<2>() = frame.position[i] - frame.position[j];
      frame.contacts.branch[c] = minimum_image(run.box(), between).head<2>();
      frame.contacts.gap[c] = frame.contacts.branch[c].norm() - radius[i] - radius[j];
    }
  }
  /// Adds the forces of contacts and gravity.
  void add_forces(Frame<2>& frame) const
  {
    const auto& grains = run.grains();
    frame.force.resize(grains.size());
    for (std::size_t g = 0; g < grains.size(); ++g)
      frame.force[g] = grains.mass[g] * run.gravity<2>().start;
    for (std::size_t c = 0; c < frame.contacts.size(); ++c) {
      frame.force[static_cast<std::size_t>(frame.contacts.i[c])] += frame.contacts.force[c];
      if (frame.contacts.j[c] >= 0)
        frame.force[static_cast<std::size_t>(frame.contacts.j[c])] -= frame.contacts.force[c];
    }
  }
  std::string text_of(std::size_t k, const RestartStyle& style = {}) const
  {
    return mercury_files::whole_restart(run, frames[k], frames[k].position[leaning].y() - reach,
                                        style);
  }
  ArchiveFiles series(const RestartStyle& style = {}) const
  {
    for (std::size_t k = 0; k < frames.size(); ++k)
      folder.write(fmt::format("run.restart.{}", 8 + k), text_of(k, style));
    ArchiveFiles files;
    files.restart = folder / "run.restart.*";
    return files;
  }
  ArchiveFiles one(const std::string& text) const
  {
    ArchiveFiles files;
    files.grains = {folder.write("one.restart", text)};
    return files;
  }
  ArchiveFiles tables(const std::string& data, const std::string& restart) const
  {
    ArchiveFiles files;
    files.grains = {folder.write("run.data", data)};
    std::string fstat;
    for (const auto& frame : frames)
      fstat += fmt::format("# {:.10g} 1\n# 0 0 0 1 1 0\n# 0 0 0 0 0 0\n", frame.time);
    files.contacts = {folder.write("run.fstat", fstat)};
    if (!restart.empty()) files.restart = folder.write("last.restart", restart);
    return files;
  }
  /// Text of .data with blocks of the first `counts` grains of each frame.
  std::string data(const std::vector<std::size_t>& counts) const
  {
    std::string all;
    for (std::size_t k = 0; k < counts.size(); ++k) {
      auto some = run.grains();
      some.id.resize(counts[k]);
      some.radius.resize(counts[k]);
      some.species.resize(counts[k]);
      all += mercury_files::data(some, run.box(), frames[k], {});
    }
    return all;
  }
  std::string complaint(const ArchiveFiles& files) const
  {
    try {
      all_of(*mercury_format.open(files));
    } catch (const ToolError& error) {
      return error.what();
    }
    return "no complaint";
  }
  void expect_frames(const ArchiveFiles& files, int id_factor = 1) const;
};

bool mentions(const std::string& sentence, const std::string& words)
{
  return sentence.find(words) != std::string::npos;
}

std::string with(std::string text, const std::string& from, const std::string& to)
{
  return text.replace(text.find(from), from.size(), to);
}

void MercuryRestarts::expect_frames(const ArchiveFiles& files, int id_factor) const
{
  const auto archive = mercury_format.open(files);
  const auto raw = all_of(*archive);
  ASSERT_EQ(raw.size(), frames.size());
  EXPECT_DOUBLE_EQ(*archive->facts().step, run.step());
  EXPECT_TRUE(*archive->facts().discs);
  const Vec3 gravity = *archive->facts().gravity;
  EXPECT_LT((gravity.head<2>() - run.gravity<2>().start).norm(), 1e-13);
  for (std::size_t k = 0; k < frames.size(); ++k) {
    const auto& [grains, contacts] = std::tie(raw[k].grains, raw[k].contacts);
    const auto &frame = frames[k], &meant = frames[k];
    EXPECT_NEAR(*raw[k].time, frame.time, 1e-12);
    EXPECT_EQ(raw[k].periodic, (std::array<bool, 3>{true, false, false}));
    ASSERT_EQ(grains.size(), run.grains().size());
    for (std::size_t g = 0; g < grains.size(); ++g) {
      EXPECT_EQ(grains.id[g], static_cast<std::int64_t>(g) * id_factor);
      EXPECT_LT((grains.position[g].head<2>() - frame.position[g]).norm(), 1e-13);
      EXPECT_LT((grains.velocity[g].head<2>() - frame.velocity[g]).norm(), 1e-13);
      EXPECT_NEAR(grains.angular_velocity[g].z(), frame.angular_velocity[g], 1e-12);
      EXPECT_EQ(grains.fixed[g], run.grains().fixed[g]);
      if (!grains.fixed[g]) {
        EXPECT_NEAR(grains.mass[g] / run.grains().mass[g], 1, 1e-13);
      }
    }
    ASSERT_EQ(contacts.size(), meant.contacts.size());
    for (std::size_t c = 0; c < contacts.size(); ++c) {
      EXPECT_EQ(contacts.i[c], meant.contacts.i[c] * id_factor);
      EXPECT_EQ(contacts.wall[c] < 0 ? contacts.j[c] : -contacts.wall[c] - 1,
                meant.contacts.j[c] < 0 ? meant.contacts.j[c] : meant.contacts.j[c] * id_factor);
      EXPECT_LT((contacts.force[c].head<2>() - meant.contacts.force[c]).norm(), 1e-12);
      EXPECT_LT((contacts.branch[c].head<2>() - meant.contacts.branch[c]).norm(), 1e-12);
      EXPECT_NEAR(contacts.overlap[c], -meant.contacts.gap[c], 1e-12);
    }
    EXPECT_LT(residual(raw[k], gravity), 1e-12);
  }
}

TEST_F(MercuryRestarts, ASeriesIsARunWithForcesOnGrainsThatBalance)
{
  expect_frames(series());
}

TEST_F(MercuryRestarts, FilesMayBeNamedAsGrainsToo)
{
  auto files = series();
  files.grains = {files.restart};
  files.restart.clear();
  expect_frames(files);
}

TEST_F(MercuryRestarts, UntilTwoThousandFifteenContactsHadNoPoint)
{
  expect_frames(series({.first_line = "restart_version 1.0 name chute", .contact_points = false}));
}

TEST_F(MercuryRestarts, TheVersionOfTheProgramMayBeAnyWord)
{
  for (const char* version : {"0.14", "1.1", "x.x"})
    expect_frames(series({.first_line = fmt::format("MercuryDPM {} name chute", version)}));
}

TEST_F(MercuryRestarts, IdsAreThoseOfTheProgramAndNotRows)
{
  expect_frames(series({.id_factor = 3}), 3);
}

TEST_F(MercuryRestarts, OneFileIsOneFrame)
{
  EXPECT_EQ(all_of(*mercury_format.open(one(text_of(0)))).size(), 1u);
}

TEST_F(MercuryRestarts, OldVersionsHaveTheGrainsAndFStatTheForces)
{
  for (const int version : {2, 3}) {
    ArchiveFiles files;
    std::string fstat;
    for (std::size_t k = 0; k < frames.size(); ++k) {
      folder.write(fmt::format("old.restart.{}", k),
                   mercury_files::old_restart(run, frames[k], version));
      fstat += mercury_files::fstat(run.grains(), frames[k], {});
    }
    files.grains = {folder / "old.restart.*"};
    EXPECT_TRUE(mentions(complaint(files), "name it with --grains and the .fstat")) << version;
    files.contacts = {folder.write("old.fstat", fstat)};
    const auto archive = mercury_format.open(files);
    const auto raw = all_of(*archive);
    ASSERT_EQ(raw.size(), frames.size());
    EXPECT_DOUBLE_EQ(*archive->facts().step, run.step());
    EXPECT_TRUE(*archive->facts().discs);
    EXPECT_LT((archive->facts().gravity->head<2>() - run.gravity<2>().start).norm(), 1e-13);
    for (std::size_t k = 0; k < frames.size(); ++k) {
      const auto& grains = raw[k].grains;
      EXPECT_TRUE(raw[k].periodic[0]);
      EXPECT_EQ(raw[k].contacts.size(), frames[k].contacts.size());
      EXPECT_TRUE(grains.force.empty());
      for (std::size_t g = 0; g < grains.size(); ++g) {
        EXPECT_LT((grains.position[g].head<2>() - frames[k].position[g]).norm(), 1e-13);
        EXPECT_LT((grains.velocity[g].head<2>() - frames[k].velocity[g]).norm(), 1e-13);
        EXPECT_NEAR(grains.angular_velocity[g].z(), frames[k].angular_velocity[g], 1e-12);
        EXPECT_EQ(grains.fixed[g], run.grains().fixed[g]);
        EXPECT_EQ(grains.type[g], 0);
      }
    }
  }
}

TEST_F(MercuryRestarts, OldRowsOfSeveralSpeciesThatDoNotNameOneAreRefused)
{
  const auto text = with(mercury_files::old_restart(run, frames[0], 2), "Species 1\n",
                         "Species 2\nk 20 disp 2 rho 1 dim_particle 2\n");
  EXPECT_TRUE(mentions(complaint(one(text)), "does not state to which of 2 species"))
      << complaint(one(text));
}

TEST_F(MercuryRestarts, CellsThatAreNotAFixedRectangleAreRefusedInTheirOwnWords)
{
  const std::pair<const char*, const char*> cases[] = {
      {"LeesEdwardsBoundary id 0 left 0 right 1 down 0 up 1 shift 1 vel 1", "shears the cell"},
      {"TimeDependentPeriodicBoundary id 0 normal 1 0 0 distanceLeft 0 distanceRight 1",
       "shifts grains with time"},
      {"AngledPeriodicBoundary id 0 normal_left 1 0 0", "rotates grains"},
      {"StressStrainControlBoundary id 0 stressGoal 0", "changes the size of the cell"},
      {"SubcriticalMaserBoundary id 0 normal 1 0 0 distanceLeft 0 distanceRight 1",
       "in a part of the cell only"},
      {"PeriodicBoundary id 0 normal 1 0 0 distanceLeft 0 distanceRight 1 shift 1 0.2 0",
       "shifts grains obliquely"},
      {"PeriodicBoundary id 0 normal 0.6 0.8 0 distanceLeft 0 distanceRight 1",
       "is not one of the axes"}};
  for (const auto& [line, words] : cases) {
    const auto said = complaint(one(text_of(0, {.boundary = line})));
    EXPECT_TRUE(mentions(said, words)) << said;
    EXPECT_TRUE(mentions(said, "one.restart, line 19: ")) << said;
  }
}

TEST_F(MercuryRestarts, AFileThatEndsEarlyIsTruncatedWhereverItIsCut)
{
  const auto whole = text_of(0);
  const auto last_row = whole.find("hGrid");
  for (const std::size_t size : {last_row - 1, last_row - 300, whole.find("Interactions"),
                                 whole.find("Particles") + 500, whole.find("Walls") + 12})
    EXPECT_THROW(mercury_format.open(one(whole.substr(0, size))), TruncatedArchive) << size;
  EXPECT_TRUE(mentions(complaint(one(whole.substr(0, last_row - 1))), "ends in its Interactions"));
  EXPECT_EQ(complaint(one(whole.substr(0, last_row))), "no complaint");
}

TEST_F(MercuryRestarts, WhatIsNotAGrainOrNotWholeIsNamed)
{
  const auto whole = text_of(0);
  const auto said_of = [&](const std::string& text) { return complaint(one(text)); };
  EXPECT_TRUE(mentions(said_of(with(whole, "SphericalParticle", "Clump")),
                       "grains must be single spheres"));
  EXPECT_TRUE(mentions(said_of(with(whole, "SphericalParticle id 1", "...\nX id 1")),
                       "the rest of the block is left out"));
  EXPECT_TRUE(mentions(said_of(with(whole, "MercuryDPM 1.0", "restart_version 4")),
                       "version '4' of .restart is unknown"));
  EXPECT_TRUE(mentions(said_of(with(whole, "timeStep", "timestep")), "time step is missing"));
  EXPECT_TRUE(mentions(said_of(text_of(0, {.of_system = " numberOfProcessors 2"})),
                       "the part of one of several processors"));
  EXPECT_TRUE(mentions(said_of(with(whole, "particleWallIds", "particleWallIds 99999")),
                       "names particle 99999"));
  const auto old = text_of(0, {.contact_points = false});
  EXPECT_TRUE(mentions(said_of(with(old, "InfiniteWall id 2", "Screw id 2")),
                       "is with wall 2 (Screw), but has no contact point"));
}

TEST_F(MercuryRestarts, GravityThatChangesIsRefused)
{
  const auto files = series();
  folder.write("run.restart.10", with(text_of(2), "gravity ", "gravity 3 0 0 was "));
  EXPECT_TRUE(mentions(complaint(files), "import the files of each gravity separately"));
}

TEST_F(MercuryRestarts, RowsOfDataNameGrainsAsLongAsGrainsAreOnlyInserted)
{
  const auto n = run.grains().size();
  const auto raw = all_of(*mercury_format.open(tables(data({n - 4, n - 4, n}), text_of(2))));
  ASSERT_EQ(raw.size(), 3u);
  EXPECT_EQ(raw[0].grains.size(), n - 4);
  EXPECT_EQ(raw[2].grains.size(), n);
  EXPECT_EQ(raw[0].grains.mass.back(), raw[2].grains.mass[n - 5]);
}

TEST_F(MercuryRestarts, RowsOfDataAreRefusedWhereGrainsWereRemoved)
{
  const auto n = run.grains().size();
  const std::string sentence = "moves the last row to the place of a grain that it removes";
  EXPECT_TRUE(mentions(complaint(tables(data({n, n - 4}), "")), sentence));
  EXPECT_TRUE(
      mentions(complaint(tables(data({n - 4, n}), text_of(2, {.id_factor = 2}))), sentence));
  const RestartStyle removing{.boundary = "DeletionBoundary id 0 normal 1 0 0 distance 1",
                              .id_factor = 2};
  EXPECT_TRUE(mentions(complaint(tables(data({n, n}), text_of(2, removing))), sentence));
  EXPECT_EQ(complaint(tables(data({n, n}), text_of(2, {.id_factor = 2}))), "no complaint");
  // One grain is removed, and the last row, of another size, takes its row.
  std::size_t other = 0;
  while (std::abs(run.grains().radius[other] / run.grains().radius[n - 1] - 1) < 0.1) ++other;
  auto swapped = run.grains();
  swapped.radius[other] = swapped.radius[n - 1];
  const auto both = mercury_files::data(run.grains(), run.box(), frames[0], {}) +
                    mercury_files::data(swapped, run.box(), frames[1], {});
  EXPECT_TRUE(mentions(complaint(tables(both, "")), sentence));
}

}  // namespace
}  // namespace grseg
