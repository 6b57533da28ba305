// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/trajectory/reader.hpp"
#include "tests/formats/import/lammps_text.hpp"

#include <gtest/gtest.h>

#include <utility>

/// Archives written by two jobs; the second one began from a checkpoint of the first.
namespace grseg {
namespace {

using namespace lammps_text;

constexpr double first_place = 0.05, other_place = 0.06;  // x in either job, m

using Steps = std::vector<std::int64_t>;

std::string grains_of_job(const Steps& steps, double x)
{
  std::string text;
  for (const auto step : steps) text += block("ATOMS", step, grain_columns, grain_rows(x));
  return text;
}

std::string contacts_of_job(const Steps& steps)
{
  std::string text;
  for (const auto step : steps) text += contacts_at(step);
  return text;
}

/// Step of each frame, and true if its grains are at the second job's position.
using Kept = std::vector<std::pair<std::int64_t, bool>>;

class TwoJobs : public testing::Test {
 protected:
  Folder folder;

  ImportSettings jobs(const Steps& first, const Steps& second, double second_place)
  {
    return settings(folder, grains_of_job(first, first_place) + grains_of_job(second, second_place),
                    contacts_of_job(first) + contacts_of_job(second));
  }
  static Kept kept(ImportSettings s, const std::optional<std::string>& repeated = {})
  {
    s.repeated = repeated;
    s.overwrite = true;
    import_archive(s, "");
    const TrajectoryReader run(s.output);
    Kept all;
    Frame<2> frame;
    for (std::size_t k = 0; k < run.size(); ++k) {
      run.read(k, frame);
      all.emplace_back(frame.step, frame.position[0].x() > 0.055);
    }
    return all;
  }
};

const Kept four_alike{{0, false}, {100, false}, {200, false}, {300, false}};

TEST_F(TwoJobs, ThatWroteTheSameFramesCountThemOnce)
{
  const auto s = jobs({0, 100, 200}, {100, 200, 300}, first_place);
  EXPECT_EQ(kept(s), four_alike);
  EXPECT_TRUE(mentions(TrajectoryReader(s.output).parameters().text("import_remarks"),
                       "2 frames come twice with equal grains; each is imported once"));
}

TEST_F(TwoJobs, MayHaveFilesOfTheirOwn)
{
  auto s = jobs({0, 100, 200}, {}, first_place);
  s.files.grains.push_back(
      folder.write("atoms.2.dump", grains_of_job({100, 200, 300}, first_place)));
  s.files.contacts.push_back(folder.write("contacts.2.dump", contacts_of_job({100, 200, 300})));
  EXPECT_EQ(kept(s), four_alike);
}

TEST_F(TwoJobs, ThatWroteOtherFramesAtTheSameStepsAreAskedAbout)
{
  const auto s = jobs({0, 100, 200}, {100, 200, 300}, other_place);
  EXPECT_EQ(refusal(s).code, exit_usage);
  EXPECT_TRUE(mentions(refusal(s).sentence,
                       "step 100 comes after 200, and its grains are not where they were the first "
                       "time: if a job began again from an earlier checkpoint, --repeated first"));
  EXPECT_EQ(kept(s, "first"), (Kept{{0, false}, {100, false}, {200, false}, {300, true}}));
  EXPECT_EQ(kept(s, "last"), (Kept{{0, false}, {100, true}, {200, true}, {300, true}}));
  EXPECT_TRUE(mentions(TrajectoryReader(s.output).parameters().text("import_remarks"),
                       "2 frames of a job are left out, because another job repeats them"));
}

TEST_F(TwoJobs, AreNamedByTheirStepsToTheLastDigit)
{
  const auto s = jobs({12345678901, 12345678911}, {12345678906}, other_place);
  EXPECT_TRUE(mentions(refusal(s).sentence, "step 12345678906 comes after 12345678911: if a job"));
}

TEST_F(TwoJobs, MayHaveWrittenBetweenEachOthersFrames)
{
  const auto s = jobs({0, 100, 200}, {150, 250}, other_place);
  EXPECT_TRUE(mentions(refusal(s).sentence, "step 150 comes after 200: if a job began again"));
  EXPECT_EQ(kept(s, "first"), (Kept{{0, false}, {100, false}, {200, false}, {250, true}}));
  EXPECT_EQ(kept(s, "last"), (Kept{{0, false}, {100, false}, {150, true}, {250, true}}));
}

// Contacts are written half as often as grains; step 400 is in both jobs.
TEST_F(TwoJobs, GoOnWhereGrainsAreWrittenMoreOftenThanContacts)
{
  const auto s = settings(folder,
                          grains_of_job({0, 100, 200, 300, 400, 500}, first_place) +
                              grains_of_job({300, 400, 500, 600}, other_place),
                          contacts_of_job({0, 200, 400}) + contacts_of_job({400, 600}));
  EXPECT_TRUE(mentions(refusal(s).sentence, "step 400 comes after 400"));
  EXPECT_EQ(kept(s, "first"), (Kept{{0, false}, {200, false}, {400, false}, {600, true}}));
  EXPECT_EQ(kept(s, "last"), (Kept{{0, false}, {200, false}, {400, true}, {600, true}}));
}

TEST_F(TwoJobs, DoNotLendEachOtherTheirContacts)
{
  const auto s = settings(
      folder,
      grains_of_job({0, 100, 200}, first_place) + grains_of_job({100, 200, 300}, other_place),
      contacts_of_job({0, 100}) + contacts_of_job({100, 200, 300}));
  EXPECT_EQ(kept(s, "first"), (Kept{{0, false}, {100, false}, {200, true}, {300, true}}));
}

/// `text` without its last `bytes` bytes.
std::string cut(std::string text, std::size_t bytes)
{
  text.resize(text.size() - bytes);
  return text;
}

const std::size_t one_row = grain_rows(first_place).back().size() + 2;

class KilledJob : public TwoJobs {
 protected:
  const std::string sentence = "rows of step 200 are missing where a new block begins";

  void expect_is_left_out(ImportSettings s)
  {
    s.overwrite = true;
    EXPECT_EQ(refusal(s).code, exit_content);
    EXPECT_TRUE(mentions(refusal(s).sentence, sentence));
    s.drop_incomplete = true;
    EXPECT_EQ(kept(s), four_alike);
    EXPECT_TRUE(mentions(TrajectoryReader(s.output).parameters().text("import_remarks"),
                         "1 incomplete frame is left out (--drop-incomplete)"));
  }
};

TEST_F(KilledJob, LeavesTheRestOfAFrameToTheNextOneInTheSameFile)
{
  for (const auto missing : {one_row, one_row + 8})  // to the end of a row, and inside a row
    expect_is_left_out(settings(folder,
                                cut(grains_of_job({0, 100, 200}, first_place), missing) +
                                    grains_of_job({200, 300}, first_place),
                                contacts_of_job({0, 100, 200}) + contacts_of_job({200, 300})));
}

TEST_F(KilledJob, LeavesTheRestOfAFrameToTheNextOneInAnotherFile)
{
  for (const auto missing : {one_row, one_row + 8}) {
    auto s = settings(folder, cut(grains_of_job({0, 100, 200}, first_place), missing),
                      contacts_of_job({0, 100, 200}));
    s.files.grains.push_back(folder.write("atoms.2.dump", grains_of_job({200, 300}, first_place)));
    s.files.contacts.push_back(folder.write("contacts.2.dump", contacts_of_job({200, 300})));
    expect_is_left_out(s);
  }
}

// Contacts of that step are not written yet.
TEST_F(KilledJob, LeavesGrainsIncompleteBeforeTheirContacts)
{
  for (const auto missing : {one_row, one_row + 8})
    expect_is_left_out(settings(folder,
                                cut(grains_of_job({0, 100, 200}, first_place), missing) +
                                    grains_of_job({200, 300}, first_place),
                                contacts_of_job({0, 100}) + contacts_of_job({200, 300})));
}

// Grains of that step are in one job only.
TEST_F(KilledJob, LeavesContactsIncompleteOfGrainsThatComeOnce)
{
  expect_is_left_out(
      settings(folder, grains_of_job({0, 100, 200, 300}, first_place),
               cut(contacts_of_job({0, 100, 200}), 12) + contacts_of_job({200, 300})));
}

TEST_F(KilledJob, LeavesContactsIncomplete)
{
  expect_is_left_out(settings(
      folder, grains_of_job({0, 100, 200}, first_place) + grains_of_job({200, 300}, first_place),
      cut(contacts_of_job({0, 100, 200}), 12) + contacts_of_job({200, 300})));
}

TEST_F(TwoJobs, AreNotToldApartByAnotherWord)
{
  auto s = jobs({0, 100}, {100, 200}, first_place);
  s.repeated = "lasst";
  EXPECT_TRUE(mentions(refusal(s).sentence, "unknown --repeated 'lasst'"));
}

}  // namespace
}  // namespace grseg
