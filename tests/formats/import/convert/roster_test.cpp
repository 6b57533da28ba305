// SPDX-License-Identifier: GPL-3.0-or-later
// Imports in which grains come and go, and imports of a part of an archive: rows of the run, sources
// of facts, and refusals.
#include "formats/trajectory/reader.hpp"
#include "tests/formats/import/lammps_text.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace grseg {
namespace {

using namespace lammps_text;

/// The large disc on its base disc, and the small one on top of it in some frames; the discs of
/// lammps_text.hpp.
class ArchiveThatChanges : public testing::Test {
 protected:
  Folder folder;

  static std::string nobody(int step) { return block("ATOMS", step, grain_columns, {}); }
  static std::string base_alone(int step)
  {
    return block("ATOMS", step, grain_columns, {grain_rows()[0]});
  }
  static std::string without_small(int step)
  {
    return block("ATOMS", step, grain_columns, {grain_rows()[0], grain_rows()[2]});
  }
  static std::string no_contacts(int step) { return block("ENTRIES", step, contact_columns, {}); }
  static std::string contacts_without_small(int step)
  {
    return block("ENTRIES", step, contact_columns, {contact_row(7, 9, 0.01, large_mass, true)});
  }
  /// All three grains, then two, then all again.
  ImportSettings one_leaves_and_comes_back()
  {
    return settings(folder, grains_at(0) + without_small(100) + grains_at(200),
                    contacts_at(0) + contacts_without_small(100) + contacts_at(200));
  }
  /// No grain, then the base, then the large disc, then all.
  ImportSettings pour()
  {
    return settings(
        folder, nobody(0) + base_alone(100) + without_small(200) + grains_at(300),
        no_contacts(0) + no_contacts(100) + contacts_without_small(200) + contacts_at(300));
  }
  static Frame<2> frame_of(const ImportSettings& s, std::size_t index)
  {
    Frame<2> frame;
    TrajectoryReader(s.output).read(index, frame,
                                    {.velocity = true, .contacts = true, .force = true});
    return frame;
  }
  static std::vector<std::size_t> numbers_present(const ImportSettings& s)
  {
    const TrajectoryReader run(s.output);
    std::vector<std::size_t> numbers;
    for (std::size_t k = 0; k < run.size(); ++k) numbers.push_back(number_present(frame_of(s, k)));
    return numbers;
  }
};

using ImportOfGrainsThatComeAndGo = ArchiveThatChanges;

TEST_F(ImportOfGrainsThatComeAndGo, HasARowForEachAndMarksWhoIsAbsent)
{
  const auto s = one_leaves_and_comes_back();
  const auto report = import_archive(s, "");
  EXPECT_EQ(report.grains, 3u);
  EXPECT_EQ(report.frames, 3u);
  EXPECT_TRUE(
      mentions(to_text(report), "grains come and go: 3 ids in all, between 2 and 3 in a frame"));
  const TrajectoryReader run(s.output);
  EXPECT_TRUE(run.grains_come_and_go());
  EXPECT_TRUE(mentions(run.parameters().text("import_remarks"), "grains come and go"));
  EXPECT_EQ(run.grains().id, (std::vector<std::int32_t>{4, 7, 9}));
  EXPECT_EQ(numbers_present(s), (std::vector<std::size_t>{3, 2, 3}));
  const auto frame = frame_of(s, 1);
  EXPECT_FALSE(is_present(frame, 0));
  EXPECT_EQ(frame.contacts.i, std::vector<std::int32_t>{1});
  EXPECT_TRUE(frame.contacts.force[0].isApprox(large_mass * Vec2(-gx, -gy)));
  EXPECT_LT(report.parameters.number("import_residual_largest", ""), 1e-14)
      << "absent grains balance nothing";
}

TEST_F(ImportOfGrainsThatComeAndGo, LeavesTheOthersAsTheyWouldBeAlone)
{
  auto s = one_leaves_and_comes_back();
  import_archive(s, "");
  const auto among = frame_of(s, 1);
  s.begin = "step:100";
  s.end = "step:200";
  s.grains = "discs";
  s.species.small = "1";
  s.species.large = "2";
  s.output = folder / "alone.h5";
  import_archive(s, "");
  const TrajectoryReader run(s.output);
  EXPECT_FALSE(run.grains_come_and_go()) << "within this range nobody comes or goes";
  const auto alone = frame_of(s, 0);
  for (const std::size_t row : {1U, 2U}) {
    EXPECT_EQ(among.position[row], alone.position[row - 1]);
    EXPECT_EQ(among.force[row], alone.force[row - 1]);
  }
  EXPECT_EQ(among.contacts.force, alone.contacts.force);
  EXPECT_EQ(among.contacts.gap, alone.contacts.gap);
}

// The first frame does not show the base, the sizes, or whether grains are discs.
TEST_F(ImportOfGrainsThatComeAndGo, FindsItsFactsFromAllThatEverOccur)
{
  const auto s = pour();
  const auto report = import_archive(s, "");
  EXPECT_EQ(numbers_present(s), (std::vector<std::size_t>{0, 1, 2, 3}));
  EXPECT_EQ(report.parameters.text("import_base"), "types 3");
  EXPECT_TRUE(
      mentions(report.parameters.text("import_sizes"), "half-way between two sizes far apart"));
  const TrajectoryReader run(s.output);
  EXPECT_EQ(run.parameters().text("import_grains"), "discs");
  EXPECT_EQ(run.grains().species, (std::vector{Species::small, Species::large, Species::boundary}));
  EXPECT_NEAR(run.parameters().number("import_origin", ""), 0, 1e-15) << "the top of the base";
  EXPECT_EQ(run.parameters().text("import_columns"), "i=2,j=3,dist=4,force=5,tangential=8");
}

TEST_F(ImportOfGrainsThatComeAndGo, RefusesAnIdThatIsUsedAgain)
{
  auto later = grains_at(200);
  const std::string small = fmt::format("4 1 {} 0.0025", small_mass);
  later.replace(later.find(small), small.size(), fmt::format("4 1 {} 0.003", small_mass));
  const auto s = settings(folder, grains_at(0) + without_small(100) + later,
                          contacts_at(0) + contacts_without_small(100) + contacts_at(200));
  const auto refused = refusal(s);
  EXPECT_EQ(refused.code, exit_content);
  EXPECT_TRUE(mentions(refused.sentence, "step 200"));
  EXPECT_TRUE(mentions(refused.sentence,
                       "the radius of grain 4 changes from 0.0025 to 0.003; was its id used again "
                       "after a grain had been removed? Then import the frames before and after it "
                       "separately, with --begin and --end"));
}

TEST_F(ImportOfGrainsThatComeAndGo, NamesADamagedFrameBeforeItAsksQuestions)
{
  auto changed = grains_at(200), cut = changed;
  changed.replace(changed.find(" 0.0025 "), 8, " 0.0030 ");
  cut.resize(cut.size() - 5);
  for (const auto& [damaged, sentence] :
       {std::pair{changed, "the radius of grain 4 changes"}, {cut, "the archive ends in"}}) {
    auto s = settings(folder, grains_at(0) + without_small(100) + damaged,
                      contacts_at(0) + contacts_without_small(100) + contacts_at(200));
    s.step.reset();
    EXPECT_EQ(refusal(s).code, exit_content);
    EXPECT_TRUE(mentions(refusal(s).sentence, sentence));
    folder.write("atoms.dump", grains_at(0) + grains_at(100) + damaged);
    EXPECT_EQ(refusal(s).code, exit_usage) << "no frame before the damaged one has other grains";
    EXPECT_TRUE(mentions(refusal(s).sentence, "--step"));
  }
}

TEST_F(ImportOfGrainsThatComeAndGo, RefusesABedThatIsFrozenLater)
{
  auto later = grains_at(100);
  const std::string large = "7 2 ";
  later.replace(later.find(large), large.size(), "7 3 ");
  const auto s = settings(folder, grains_at(0) + later, contacts_at(0) + contacts_at(100));
  const auto refused = refusal(s);
  EXPECT_EQ(refused.code, exit_content);
  EXPECT_TRUE(mentions(refused.sentence,
                       "the type of grain 7 changes from 2 to 3; if grains are frozen or released "
                       "later, import the phases separately, with --begin and --end"));
}

TEST_F(ImportOfGrainsThatComeAndGo, RefusesAContactOfOneThatIsNotThere)
{
  const auto s =
      settings(folder, grains_at(0) + without_small(100), contacts_at(0) + contacts_at(100));
  EXPECT_TRUE(mentions(refusal(s).sentence, "step 100 "));
  EXPECT_TRUE(mentions(refusal(s).sentence,
                       "a contact names grain 4, which is not among the grains of this frame"));
}

TEST_F(ImportOfGrainsThatComeAndGo, AsksAboutFactsOnlyWhatAllGrainsLeaveOpen)
{
  auto s = settings(folder, base_alone(0) + without_small(100),
                    no_contacts(0) + contacts_without_small(100));
  s.grains = "discs";
  EXPECT_TRUE(mentions(refusal(s).sentence, "--split-diameter")) << "there is one size";
  s.species.named = {"grains=2"};
  EXPECT_EQ(refusal(s).sentence, "");
}

class RangeOfFrames : public ArchiveThatChanges {
 protected:
  ImportSettings four_frames()
  {
    return settings(folder, grains_at(0) + grains_at(100) + grains_at(200) + grains_at(300),
                    contacts_at(0) + contacts_at(100) + contacts_at(200) + contacts_at(300));
  }
  std::vector<std::int64_t> steps_of(const std::optional<std::string>& begin,
                                     const std::optional<std::string>& end)
  {
    auto s = four_frames();
    s.begin = begin;
    s.end = end;
    s.overwrite = true;
    import_archive(s, "");
    return TrajectoryReader(s.output).steps();
  }
};

using Steps = std::vector<std::int64_t>;

TEST_F(RangeOfFrames, IncludesItsBeginButNotItsEnd)
{
  EXPECT_EQ(steps_of("step:100", "step:200"), (Steps{100}));
  EXPECT_EQ(steps_of("step:101", std::nullopt), (Steps{200, 300}));
  EXPECT_EQ(steps_of(std::nullopt, "step:101"), (Steps{0, 100}));
}

// 3 x 1e-5 x 100 differs from 0.003 in the last bit.
TEST_F(RangeOfFrames, InTimesIsTheSameWhateverTheRounding)
{
  EXPECT_EQ(steps_of("0.001", "0.003"), (Steps{100, 200}));
  EXPECT_EQ(steps_of("0.0010001", "2.9e-3"), Steps{200});
}

TEST_F(RangeOfFrames, IsRecordedInTheFile)
{
  auto s = four_frames();
  s.begin = "0.001";
  s.end = "step:200";
  import_archive(s, "");
  const auto parameters = TrajectoryReader(s.output).parameters();
  EXPECT_EQ(parameters.text("import_begin"), "0.001");
  EXPECT_EQ(parameters.text("import_end"), "step:200");
  EXPECT_TRUE(mentions(parameters.text("import_remarks"), "--begin 0.001 --end step:200"));
}

TEST_F(RangeOfFrames, WithoutFramesNamesTheRangeOfTheArchive)
{
  auto s = four_frames();
  s.begin = "1";
  EXPECT_EQ(refusal(s).sentence,
            "no frame lies in the range --begin 1: the archive has 4 frames "
            "from step 0 to step 300");
  EXPECT_EQ(refusal(s).code, exit_usage);
  s.begin = "step:101";
  s.end = "step:199";
  EXPECT_TRUE(mentions(refusal(s).sentence,
                       "no frame lies in the range --begin step:101 --end step:199: the archive "
                       "has 4 frames"));
}

TEST_F(RangeOfFrames, ThatIsNeitherATimeNorAStepIsRefused)
{
  auto s = four_frames();
  for (const char* text : {"step:1.5", "soon", "1s", "nan", ""}) {
    s.end = text;
    EXPECT_TRUE(
        mentions(refusal(s).sentence, "is neither a time in the archive's units, as in 12.5"))
        << text;
  }
}

TEST_F(RangeOfFrames, InTimesNeedsTheLengthOfAStepWhereTheArchiveHasStepsOnly)
{
  auto s = four_frames();
  s.step.reset();
  s.begin = "0.001";
  EXPECT_TRUE(mentions(refusal(s).sentence,
                       "--begin is a time, but the archive has steps only, and "
                       "the length of a time step is unknown: pass it with "
                       "--step"));
}

}  // namespace
}  // namespace grseg
