// SPDX-License-Identifier: GPL-3.0-or-later
// Facts that an archive does not state: where its bed ends, what its columns mean.
#include "formats/trajectory/reader.hpp"
#include "tests/formats/import/lammps_text.hpp"

#include <gtest/gtest.h>

namespace grseg {
namespace {

using namespace lammps_text;

/// Discs from x = 0.045 to 0.055 in a box from 0 to 0.1, with one more column of grains if `column`
/// is not empty.
class BedInABox : public testing::Test {
 protected:
  Folder folder;

  ImportSettings settings_of(const std::string& boundary, const std::string& column = "") const
  {
    auto rows = grain_rows();
    for (auto& row : rows) row += column.empty() ? "" : " 1";
    auto s = settings(
        folder,
        block("ATOMS", 0, grain_columns + (column.empty() ? "" : " " + column), rows, boundary),
        contacts_at(0));
    s.overwrite = true;
    return s;
  }
};

TEST_F(BedInABox, ThatIsOpenAndWiderIsAskedForItsEnds)
{
  const auto refused = refusal(settings_of("ff ff pp"));
  EXPECT_EQ(refused.code, exit_usage);
  EXPECT_TRUE(mentions(refused.sentence, "--cell x:0.045:0.055"));
  EXPECT_TRUE(mentions(refused.sentence, "the archive's box ends at 0 and 0.1"));
  EXPECT_EQ(refusal(settings_of("pp ff pp")).code, 0);
}

TEST_F(BedInABox, KeepsTheArchivesCoordinatesAlongAnOpenAxis)
{
  auto s = settings_of("ff ff pp");
  s.cells = {"x:0.045:0.055"};
  s.origin = "centre";
  import_archive(s, "");
  const TrajectoryReader run(s.output);
  EXPECT_NEAR(run.box().length_x, 0.01, 1e-15);
  EXPECT_NEAR(run.box().low_x, 0.045, 1e-15);
  EXPECT_EQ(run.parameters().text("import_coordinates"),
            "x = x, y = y + 0.005 of the archive, in its units");
  Frame<2> frame;
  run.read(0, frame);
  EXPECT_EQ(frame.position[0].x(), 0.05);
}

TEST_F(BedInABox, EndsAtWallsThatAreNamed)
{
  auto s = settings_of("ff ff pp");
  s.walls = {"left=x:0.044", "right=x:0.056"};
  import_archive(s, "");
  EXPECT_NEAR(TrajectoryReader(s.output).box().length_x, 0.012, 1e-15);
}

TEST_F(BedInABox, ColumnsOfOtherShapesAreRefused)
{
  for (const char* column : {"shapex", "blockiness1", "quat3", "id_multisphere"}) {
    const auto refused = refusal(settings_of("pp ff pp", column));
    EXPECT_EQ(refused.code, exit_content) << column;
    EXPECT_TRUE(mentions(refused.sentence, std::string("--map ") + column + "="));
  }
}

TEST_F(BedInABox, ColumnsWithoutAKnownMeaningAreAskedFor)
{
  auto s = settings_of("pp ff pp", "crystallinity");
  const auto refused = refusal(s);
  EXPECT_EQ(refused.code, exit_usage);
  EXPECT_TRUE(mentions(refused.sentence, "--map crystallinity="));
  s.files.map = {"crystallinity="};
  EXPECT_EQ(refusal(s).code, 0);
  s.files.map = {"crystallinity=x"};
  EXPECT_TRUE(mentions(refusal(s).sentence, "can only be left out, by NAME="));
  for (const char* known : {"c_stress[1]", "tqz", "mol", "f_wall[1]"})
    EXPECT_EQ(refusal(settings_of("pp ff pp", known)).sentence, "") << known;
}

}  // namespace
}  // namespace grseg
