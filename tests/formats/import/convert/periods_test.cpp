// SPDX-License-Identifier: GPL-3.0-or-later
// Number of times that grains have crossed the archive's periods: whether an archive records it,
// and what the run then states.
#include "formats/trajectory/reader.hpp"
#include "tests/formats/import/lammps_text.hpp"

#include <gtest/gtest.h>

namespace grseg {
namespace {

using namespace lammps_text;

class PeriodsOfAnArchive : public testing::Test {
 protected:
  Folder folder;

  /// Grains at x = 0.05 in a cell of 0.1, with these columns of positions; `more` is appended to each row.
  static std::string grains(int step, const std::string& positions, const std::string& more = "",
                            double x = 0.05, const std::string& boundary = "pp ff pp")
  {
    auto rows = grain_rows(x);
    for (auto& row : rows) row += more;
    return block("ATOMS", step,
                 fmt::format("id type mass radius {} vx vy omegaz fx fy{}", positions,
                             more.empty() ? "" : " ix iy"),
                 rows, boundary);
  }
  std::string images_of(const std::string& first, const std::string& second)
  {
    auto s = settings(folder, first + second, contacts_at(0) + contacts_at(100));
    if (first.find("BOUNDS ff") != std::string::npos) s.cells = {"x:0.045:0.055"};
    import_archive(s, "");
    const TrajectoryReader run(s.output);
    EXPECT_EQ(run.has_images(), run.parameters().text("import_images") != "unknown");
    run.read(1, frame, {.velocity = false, .contacts = false, .force = true});
    return run.parameters().text("import_images");
  }
  Frame<2> frame;
};

TEST_F(PeriodsOfAnArchive, AreKnownFromColumnsOfImages)
{
  EXPECT_EQ(images_of(grains(0, "x y", " 3 0"), grains(100, "x y", " 3 0")), "known");
  EXPECT_EQ(frame.image[0][0], 3);
}

TEST_F(PeriodsOfAnArchive, AreKnownFromUnwrappedPositions)
{
  EXPECT_EQ(images_of(grains(0, "xu yu", "", 0.25), grains(100, "xu yu", "", 0.25)), "known");
  EXPECT_EQ(frame.image[0][0], 2);
  EXPECT_NEAR(frame.position[0].x(), 0.05, 1e-15);
}

TEST_F(PeriodsOfAnArchive, AreRefusedWhereTheirNumberDoesNotFitIntoAnImage)
{
  for (const double x : {1e12, -1e300}) {
    const auto refused = refusal(settings(folder, grains(0, "xu yu", "", x), contacts_at(0)));
    EXPECT_EQ(refused.code, exit_content) << refused.sentence;
    EXPECT_TRUE(mentions(refused.sentence, "periods from the cell, more than 2^31"));
  }
  EXPECT_EQ(refusal(settings(folder, grains(0, "x y", " -2147483648 0"), contacts_at(0))).code,
            exit_content);
  EXPECT_EQ(refusal(settings(folder, grains(0, "x y", " 2147483647 0"), contacts_at(0))).code, 0);
}

TEST_F(PeriodsOfAnArchive, AreUnknownFromWrappedPositionsAlone)
{
  EXPECT_EQ(images_of(grains(0, "x y"), grains(100, "x y")), "unknown");
}

TEST_F(PeriodsOfAnArchive, AreUnknownWhereTheFirstFrameDoesNotTell)
{
  EXPECT_EQ(images_of(grains(0, "x y"), grains(100, "x y", " 3 0")), "unknown");
}

TEST_F(PeriodsOfAnArchive, AreNotWordsOfACellWithoutAny)
{
  EXPECT_EQ(
      images_of(grains(0, "x y", "", 0.05, "ff ff pp"), grains(100, "x y", "", 0.05, "ff ff pp")),
      "");
}

TEST_F(PeriodsOfAnArchive, AreUnknownWhereOneFrameOfGrainsThatComeAndGoDoesNotTell)
{
  const auto alone = block("ATOMS", 0, grain_columns + " ix iy", {grain_rows()[0] + " 0 0"});
  const auto s = settings(folder, alone + grains(100, "x y"),
                          block("ENTRIES", 0, contact_columns, {}) + contacts_at(100));
  import_archive(s, "");
  EXPECT_EQ(TrajectoryReader(s.output).parameters().text("import_images"), "unknown");
}

TEST_F(PeriodsOfAnArchive, AreNotForgottenHalfWay)
{
  const auto refused = refusal(settings(folder, grains(0, "x y", " 3 0") + grains(100, "x y"),
                                        contacts_at(0) + contacts_at(100)));
  EXPECT_EQ(refused.code, exit_content);
  EXPECT_TRUE(
      mentions(refused.sentence,
               "earlier frames state how often grains have crossed the periodic cell, and this one "
               "does not; import them separately, with --begin and --end"));
}

}  // namespace
}  // namespace grseg
