// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/import/common/archive.hpp"
#include "tests/formats/import/archive_balance.hpp"
#include "tests/formats/import/flow_in_space.hpp"
#include "tests/formats/import/mercury_files.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <numbers>

namespace grseg {
namespace {

namespace fs = std::filesystem;
using namespace archive_balance;
using mercury_files::Style;

/// Frames of the sample run with a wall under one grain, written as files of MercuryDPM.
class Mercury : public testing::Test {
 protected:
  TrajectoryReader run{GRSEG_TEST_INPUTS "/../../data/sample/chute.h5"};
  fs::path folder = fs::temp_directory_path() / ("grseg_mercury_" + std::to_string(getpid()));
  std::vector<Frame<2>> frames;

  void SetUp() override
  {
    fs::create_directory(folder);
    for (const std::size_t k : {5U, 6U, 7U}) {
      Frame<2> frame;
      run.read(k, frame);
      auto& contacts = frame.contacts;
      std::size_t mobile = 0;
      while (run.grains().fixed[mobile]) ++mobile;
      contacts.i.push_back(static_cast<std::int32_t>(mobile));
      contacts.j.push_back(-3);
      contacts.force.emplace_back(-0.01, 0.03);
      contacts.gap.push_back(-1e-5);
      contacts.branch.emplace_back(0, run.grains().radius[mobile] - 1e-5);
      frames.push_back(frame);
    }
  }
  void TearDown() override { fs::remove_all(folder); }

  std::string file(const std::string& name, const std::string& text) const
  {
    std::ofstream(folder / name) << text;
    return (folder / name).string();
  }
  std::string data(const Style& style) const
  {
    std::string text;
    for (const auto& frame : frames)
      text += mercury_files::data(run.grains(), run.box(), frame, style);
    return text;
  }
  std::string fstat(const Style& style) const
  {
    std::string text;
    for (const auto& frame : frames) text += mercury_files::fstat(run.grains(), frame, style);
    return text;
  }
  ArchiveFiles files(const Style& style) const
  {
    ArchiveFiles all;
    all.grains = {file("chute.data", data(style))};
    all.contacts = {file("chute.fstat", fstat(style))};
    all.restart = file("chute.restart", mercury_files::restart(run.grains(), run));
    return all;
  }
  std::string complaint(const ArchiveFiles& all) const
  {
    try {
      all_of(*mercury_format.open(all));
    } catch (const ToolError& error) {
      return error.what();
    }
    return "no complaint";
  }
  void expect_frames(const ArchiveFiles& all, bool with_spin = true) const;
};

void expect_contacts(const ContactList<2>& meant, const ArchiveContacts& read,
                     const std::string& what)
{
  ASSERT_EQ(read.size(), meant.size()) << what;
  const double scale = largest_force(read);
  for (std::size_t c = 0; c < meant.size(); ++c) {
    EXPECT_EQ(read.i[c], meant.i[c]) << what;
    const auto j = read.wall[c] < 0 ? read.j[c] : -read.wall[c] - 1;
    EXPECT_EQ(j, meant.j[c]) << what;
    EXPECT_LT((read.force[c].head<2>() - meant.force[c]).norm(), 1e-8 * scale) << what;
    EXPECT_LT((read.branch[c].head<2>() - meant.branch[c]).norm(), 1e-9) << what;
    EXPECT_NEAR(read.overlap[c], -meant.gap[c], 1e-9) << what;
  }
}

void Mercury::expect_frames(const ArchiveFiles& all, bool with_spin) const
{
  const auto raw = all_of(*mercury_format.open(all));
  ASSERT_EQ(raw.size(), frames.size());
  for (std::size_t k = 0; k < frames.size(); ++k) {
    const auto& grains = raw[k].grains;
    EXPECT_NEAR(*raw[k].time, frames[k].time, 1e-8);
    ASSERT_EQ(grains.size(), run.grains().size());
    for (std::size_t g = 0; g < grains.size(); ++g) {
      EXPECT_EQ(grains.id[g], static_cast<std::int64_t>(g));
      EXPECT_LT((grains.position[g].head<2>() - frames[k].position[g]).norm(), 1e-14);
      EXPECT_LT((grains.velocity[g].head<2>() - frames[k].velocity[g]).norm(), 1e-8);
      EXPECT_EQ(grains.position[g].z(), 0);
      const double spin = with_spin ? frames[k].angular_velocity[g] : 0;
      EXPECT_NEAR(grains.angular_velocity[g].z(), spin, 1e-7);
      EXPECT_NEAR(grains.radius[g], run.grains().radius[g], 1e-11);
    }
    expect_contacts(frames[k].contacts, raw[k].contacts, std::to_string(k));
  }
}

TEST_F(Mercury, PlaneFormatNegatesSpinAndWritesPairsTwice)
{
  expect_frames(files({.format = 8}));
}

TEST_F(Mercury, SpatialFormatDoesNotNegateSpin)
{
  expect_frames(files({.format = 14}));
}

TEST_F(Mercury, FormatFifteenHasAnotherColumnBeforeInfo)
{
  expect_frames(files({.format = 15}));
}

TEST_F(Mercury, FormatSevenSwapsYAndZ)
{
  expect_frames(files({.format = 7}), false);
}

TEST_F(Mercury, ParallelBuildsAppendTwoFlags)
{
  for (const int format : {8, 14, 15}) expect_frames(files({.format = format, .flags = true}));
}

TEST_F(Mercury, OldFilesWithTheMiddleOfCentresMeanTheSameContacts)
{
  expect_frames(files({.point = 0}));
}

TEST_F(Mercury, DoubleRowsAreOneContactWithItsWholeForce)
{
  const auto text = fstat({});
  const auto rows = static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n')) - 9;
  std::size_t contacts = 0;
  for (const auto& frame : frames) contacts += frame.contacts.size();
  EXPECT_GT(rows, contacts + contacts / 2);  // most pairs are listed twice
  expect_frames(files({}));
}

TEST_F(Mercury, WallRowsHaveTheOppositeSign)
{
  // Rows of an archive of MercuryDPM: grain 27 rests on wall 2 at y = 0.
  const std::string block =
      "# 0.02 1\n# 0 0 0 1 1 0\n# 0.05 0.05 0 0 0 0\n"
      "0.02 1 0 0.3685998372 0.192813987 0 0.00688691534 0 0.005373722573 0 0.994345469 "
      "0.1061936358 0 0 0 0\n"
      "0.02 0 1 0.3685998372 0.192813987 0 0.00688691534 0 0.005373722573 0 -0.994345469 "
      "-0.1061936358 -0 -0 -0 -0\n"
      "0.02 1 -3 0.4600585605 -0.003160952164 0 0.006321904327 0 0.00302676824 0 0 -1 -0 -0 -0 "
      "-0\n";
  ArchiveFiles all;
  all.grains = {file(
      "w.data", "2 0.02 0 0 1 1\n0.3217 0.1878 0 0 0.05 0 0 0\n0.4149 0.1977 0 0 0.05 0 0 0\n")};
  all.contacts = {file("w.fstat", block)};
  const auto contacts = all_of(*mercury_format.open(all)).at(0).contacts;
  ASSERT_EQ(contacts.size(), 2u);
  EXPECT_EQ(contacts.wall, (std::vector<std::int32_t>{-1, 2}));
  EXPECT_EQ(contacts.force[1], Vec3(0, 0.00302676824, 0));
  EXPECT_NEAR(contacts.branch[1].y(), 0.05 - 0.006321904327, 1e-15);
  EXPECT_NEAR(contacts.force[0].x(), 0.005373722573 * 0.994345469, 1e-15);
}

TEST_F(Mercury, RestartGivesMassesFixedGrainsAndThePeriod)
{
  const auto archive = mercury_format.open(files({}));
  const auto raw = all_of(*archive).front();
  const auto& facts = archive->facts();
  EXPECT_DOUBLE_EQ(*facts.step, run.step());
  EXPECT_LT((facts.gravity->head<2>() - run.gravity<2>().start).norm(), 1e-13);
  EXPECT_TRUE(*facts.discs);
  EXPECT_EQ(raw.periodic, (std::array<bool, 3>{true, false, false}));
  EXPECT_NEAR(raw.high.x() - raw.low.x(), run.box().length_x, 1e-14);
  for (std::size_t g = 0; g < raw.grains.size(); ++g) {
    const double r = run.grains().radius[g];
    EXPECT_EQ(raw.grains.fixed[g], run.grains().fixed[g]);
    EXPECT_EQ(raw.grains.type[g], species_numbers(run.grains().species, 2)[g]);
    EXPECT_NEAR(raw.grains.mass[g], std::numbers::pi * r * r, 1e-6 * r * r);
  }
}

TEST_F(Mercury, InfoIsASpeciesOnlyOnRequest)
{
  auto all = files({.info = 7});
  EXPECT_NE(all_of(*mercury_format.open(all)).at(0).grains.type.at(0), 7);
  all.columns = "info=species";
  EXPECT_EQ(all_of(*mercury_format.open(all)).at(0).grains.type.at(0), 7);
  all.columns = "i=1";
  EXPECT_NE(complaint(all).find("info=species"), std::string::npos);
}

TEST_F(Mercury, BlocksAreMatchedByTimeNotByOrder)
{
  auto all = files({});
  Frame<2> early = frames[0], late = frames[2];
  early.time -= 0.01;
  late.time += 0.01;
  all.contacts = {file("more.fstat", mercury_files::fstat(run.grains(), early, {}) + fstat({}))};
  all.grains = {
      file("more.data", data({}) + mercury_files::data(run.grains(), run.box(), late, {}))};
  expect_frames(all);
  const auto archive = mercury_format.open(all);
  all_of(*archive);
  ASSERT_EQ(archive->remarks().size(), 1u);
  EXPECT_NE(archive->remarks()[0].find("1 frames have contacts but no grains"), std::string::npos);
}

TEST_F(Mercury, TimesThatNoTableSharesAreNamed)
{
  auto all = files({});
  Frame<2> late = frames[2];
  late.time += 0.01;
  all.contacts = {file("late.fstat", mercury_files::fstat(run.grains(), late, {}))};
  EXPECT_NE(complaint(all).find(fmt::format(
                "no frame is in both tables: the grains begin with {:.10g}, {:.10g}, {:.10g}, the "
                "contacts with {:.10g}",
                frames[0].time, frames[1].time, frames[2].time, late.time)),
            std::string::npos)
      << complaint(all);
}

TEST_F(Mercury, WithoutRestartPairsAcrossThePeriodAreRefused)
{
  auto all = files({});
  all.restart.clear();
  EXPECT_FALSE(mercury_format.open(all)->facts().step);
  EXPECT_NE(complaint(all).find("add --restart"), std::string::npos) << complaint(all);
}

TEST_F(Mercury, ATruncatedBlockEndsTheArchiveAfterTheWholeOnes)
{
  auto all = files({});
  const auto text = data({});
  for (const std::size_t cut : {1U, 40U, 5000U}) {
    all.grains = {file("cut.data", text.substr(0, text.size() - cut))};
    const auto archive = mercury_format.open(all);
    ArchiveFrame raw;
    EXPECT_TRUE(archive->next(raw));
    EXPECT_TRUE(archive->next(raw));
    EXPECT_THROW(archive->next(raw), TruncatedArchive) << cut;
    EXPECT_EQ(raw.grains.size(), run.grains().size()) << "those of the last whole block";
    EXPECT_FALSE(raw.grains.angular_velocity.empty());
  }
  EXPECT_NE(complaint(all).find("--drop-incomplete"), std::string::npos);
}

TEST_F(Mercury, FilesOfDifferentRunsAndDamageAreNamedByLine)
{
  auto all = files({});
  const auto with_data = [&](const std::string& text) {
    auto other = all;
    other.grains = {file("bad.data", text)};
    return complaint(other);
  };
  EXPECT_NE(with_data("3 0.5\n").find("bad.data, line 1: 2 numbers"), std::string::npos);
  EXPECT_NE(with_data("1 0.5 0 0 1 1\n1 2 3\n").find("line 2: a row of 3 numbers"),
            std::string::npos);
  EXPECT_NE(with_data("1 0.5 0 0 1 1\n1 nan 0 0 1 0 0 0\n").find("'nan' in column 2"),
            std::string::npos);
  EXPECT_NE(with_data("-4 0.5 0 0 1 1\n").find("not the number of grains"), std::string::npos);
  auto other = all;
  other.contacts = {file("bad.fstat", "0.5 1 2\n")};
  EXPECT_NE(complaint(other).find("begins with '# time 1'"), std::string::npos);
  other = all;
  other.restart = all.grains[0];
  EXPECT_NE(complaint(other).find("is not a .restart of MercuryDPM"), std::string::npos);
  auto fewer = run.grains();
  fewer.radius.pop_back();
  other.restart = file("fewer.restart", mercury_files::restart(fewer, run));
  EXPECT_NE(complaint(other).find("name the last .restart of the run"), std::string::npos);
}

/// A three-dimensional flow in files as MercuryDPM writes them; rows are grains by id.
class MercuryInSpace : public testing::Test {
 protected:
  lammps_text::Folder folder;

  ImportSettings settings_of(const flow_in_space::Flow& flow, const flow_in_space::View& view,
                             const Style& style) const
  {
    const flow_in_space::Cell cell(flow, view);
    std::vector<mercury_files::Period> periods;
    for (int axis = 0; axis < 3; ++axis)
      if (cell.periodic[static_cast<std::size_t>(axis)])
        periods.push_back({Vec3::Unit(axis), cell.low[axis], cell.high[axis]});
    Frame<3> seen = flow.frame;
    for (std::size_t g = 0; g < flow.grains.size(); ++g) {
      seen.position[g] = cell.place(flow.frame.position[g]);
      seen.velocity[g] = view.turn * flow.frame.velocity[g];
      seen.angular_velocity[g] = view.turn * flow.frame.angular_velocity[g];
    }
    for (std::size_t c = 0; c < seen.contacts.size(); ++c) {
      seen.contacts.force[c] = view.turn * flow.frame.contacts.force[c];
      seen.contacts.branch[c] = view.turn * flow.frame.contacts.branch[c];
    }
    ImportSettings s;
    s.format = "mercury";
    s.files.grains = {
        folder.write("run.data", mercury_files::data(flow.grains, flow.box, seen, style))};
    s.files.contacts = {folder.write("run.fstat", mercury_files::fstat(flow.grains, seen, style))};
    s.files.restart = folder.write(
        "run.restart",
        mercury_files::restart(flow.grains, 1e-3, view.turn * flow.gravity, 3, periods));
    s.units = "si";
    s.axes = view.axes;
    s.output = folder / "run.h5";
    s.overwrite = true;
    return s;
  }
};

TEST_F(MercuryInSpace, IsTheSameInWhateverAxesAndFormat)
{
  flow_in_space::Flow flow;
  // The contact point of a wall is the point where the normal through the grain meets the wall.
  flow.add_contact(3, -2, {0.5, 3, -0.75}, 0.48 * Vec3(0.36, 0.8, 0.48), -0.02);
  for (const auto& view : flow_in_space::views())
    for (const int format : {14, 15, 7}) {
      const auto s = settings_of(flow, view, {.format = format});
      import_archive(s, "");
      const TrajectoryReader run(s.output);
      Frame<3> frame;
      run.read(0, frame);
      EXPECT_NEAR(run.box().length_x, 7, 1e-13);
      EXPECT_NEAR(run.box().length_z, 5, 1e-13);
      EXPECT_LT((run.gravity<3>().start - flow.gravity).norm(), 1e-13);
      for (std::size_t g = 0; g < 4; ++g) {
        EXPECT_LT((frame.position[g] - flow.frame.position[g]).norm(), 1e-13) << view.axes;
        EXPECT_LT((frame.velocity[g] - flow.frame.velocity[g]).norm(), 1e-9) << view.axes;
        const Vec3 spin = format == 7 ? Vec3(0, 0, 0) : flow.frame.angular_velocity[g];
        EXPECT_LT((frame.angular_velocity[g] - spin).norm(), 1e-9) << view.axes;
      }
      const auto &contacts = frame.contacts, &meant = flow.frame.contacts;
      EXPECT_EQ(contacts.i, meant.i);
      EXPECT_EQ(contacts.j, meant.j);
      for (std::size_t c = 0; c < meant.size(); ++c) {
        EXPECT_LT((contacts.force[c] - meant.force[c]).norm(), 1e-7) << view.axes;
        EXPECT_LT((contacts.branch[c] - meant.branch[c]).norm(), 1e-8) << view.axes;
      }
    }
}

TEST_F(MercuryInSpace, APeriodBesideTheAxesIsRefused)
{
  auto s = settings_of({}, flow_in_space::views()[0], {.format = 14});
  auto restart = lammps_text::read(s.files.restart);
  restart.replace(restart.find("normal 0 0 1"), 12, "normal 0 0.6 0.8");
  s.files.restart = folder.write("run.restart", restart);
  EXPECT_TRUE(lammps_text::mentions(lammps_text::refusal(s).sentence,
                                    "of the periodic boundary is not one of the axes, which cannot "
                                    "be imported"));
}

}  // namespace
}  // namespace grseg
