// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/import/facts/cell_and_walls.hpp"
#include "tests/formats/import/lammps_text.hpp"

#include <gtest/gtest.h>

namespace grseg {
namespace {

using lammps_text::mentions;

TEST(ToldCell, IsAnAxisAndTwoEndsAndMayBePeriodic)
{
  const auto cells = parse_cells({"x:-0.5:1.5", "z:0:2:periodic"});
  EXPECT_EQ(cells[0].axis, 0);
  EXPECT_EQ(cells[0].low, -0.5);
  EXPECT_EQ(cells[0].high, 1.5);
  EXPECT_FALSE(cells[0].periodic);
  EXPECT_EQ(cells[1].text(), "z:0:2:periodic");
}

TEST(ToldCell, OfAnotherFormIsRefused)
{
  for (const char* text :
       {"x:0", "x:1:0", "w:0:1", "x:0:nan", "x:0:1:open", "x:0:1:periodic:2", ""})
    EXPECT_THROW(parse_cells({text}), UsageError) << text;
  EXPECT_THROW(parse_cells({"x:0:1", "x:0:2"}), UsageError) << "twice";
}

TEST(ToldCell, ReplacesTheExtentOfTheGrainsButNoPeriodOfTheArchive)
{
  ArchiveFrame frame;
  frame.cell[0] = CellSource::grains;
  frame.high.x() = 0.1;
  tell(parse_cells({"x:0:2"})[0], frame);
  EXPECT_EQ(frame.high.x(), 2);
  EXPECT_EQ(frame.cell[0], CellSource::told);
  frame.periodic[0] = true;
  try {
    tell(parse_cells({"x:0:3:periodic"})[0], frame);
    FAIL();
  } catch (const UsageError& error) {
    EXPECT_TRUE(mentions(error.what(), "the archive states x:0:2:periodic"));
  }
}

}  // namespace
}  // namespace grseg
