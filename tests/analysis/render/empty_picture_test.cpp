// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/render/render_run.hpp"
#include "formats/core/errors.hpp"
#include "tests/column.hpp"
#include "tests/folder.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

namespace grseg {
namespace {

using EmptyPicture = TestInFolder;

/// Message with which the picture of a column of spheres is refused, "" if it is made. The column
/// is 60 mm high, at x = 30 mm and z = 0, in a cell that is periodic along z with 60 mm.
std::string refusal(const std::string& path, const std::string& picture, const std::string& slice,
                    const std::string& region, Plane plane)
{
  if (!std::filesystem::exists(path)) column::ColumnOf<3>().write(path);
  const TrajectoryReader run(path);
  RenderSettings settings;
  settings.output.path = picture;
  settings.output.overwrite = true;
  settings.picture.plain.slice = slice;
  settings.picture.plain.region = region;
  settings.picture.plane = word_of(plane, planes);
  const auto grains = group_grains(run, {});
  std::filesystem::remove(picture);
  std::string said;
  try {
    make_picture<3>({run, grains, settings, picture_kind(picture), ""});
  } catch (const UsageError& refused) {
    said = refused.what();
  }
  EXPECT_EQ(std::filesystem::exists(picture), said.empty());
  return said;
}

TEST_F(EmptyPicture, OfASliceWithoutGrainsIsRefused)
{
  const auto said = [&](const std::string& slice, const std::string& region, Plane plane) {
    return refusal(path("run.h5"), path("picture.svg"), slice, region, plane);
  };
  EXPECT_EQ(said("0:20mm", "", Plane::zx), "");
  EXPECT_EQ(said("100mm:200mm", "", Plane::zx),
            "no grain is in the slice y = 10 to 20 cm: the grains lie at x = 2.5 to 3.5 cm, "
            "y = -1 to 6 cm, z = -5 to 5 mm; choose another --slice, or use --project");
  EXPECT_EQ(said("0:10mm", "0:10mm,100mm:120mm", Plane::xy).substr(0, 72),
            "no grain is in the slice z = 0 to 1 cm of --region '0:10mm,100mm:120mm':");
}

TEST_F(EmptyPicture, IsNoneBeyondThePeriodWhichRepeatsTheGrains)
{
  EXPECT_EQ(refusal(path("run.h5"), path("picture.svg"), "590mm:610mm", "", Plane::xy), "");
}

}  // namespace
}  // namespace grseg
