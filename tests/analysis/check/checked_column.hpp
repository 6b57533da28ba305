// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/check/file_check.hpp"
#include "analysis/check/physics_check.hpp"
#include "formats/core/frame.hpp"
#include "formats/trajectory/hdf5.hpp"
#include "tests/column.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <set>
#include <string>
#include <vector>

namespace grseg {

namespace fs = std::filesystem;
using namespace column;
using Names = std::set<std::string>;

/// Results of grseg-check for a column.
class CheckedColumn : public testing::Test {
 protected:
  std::string path =
      (fs::temp_directory_path() / fmt::format("grseg_physics_check_{}.h5", getpid())).string();
  void TearDown() override { fs::remove(path); }

  std::vector<CheckLine> lines_of_file() const
  {
    const TrajectoryReader run(path, Verify::no);
    PhysicsSettings settings;
    settings.layer = "10mm";
    settings.windows.length = run.parameters().number("frame_interval", path) * 4;
    ContentCheck content(run);
    return with_dimension(run.dimension(), [&](auto d) {
      PhysicsCheck<d> physics(run, settings);
      Frame<d> frame;
      for (std::size_t k = 0; k < run.size(); ++k) {
        run.read(k, frame, {.velocity = true, .contacts = true, .force = true});
        content.add(k, frame);
        physics.add(k, frame);
      }
      auto lines = content.lines();
      for (const auto& line : physics.lines()) lines.push_back(line);
      return lines;
    });
  }
  template <int D>
  std::vector<CheckLine> lines_of(const ColumnOf<D>& column) const
  {
    column.write(path);
    return lines_of_file();
  }
  static Names with(Verdict verdict, const std::vector<CheckLine>& lines)
  {
    Names names;
    for (const auto& line : lines)
      if (line.verdict == verdict) names.insert(line.quantity);
    return names;
  }
  template <int D>
  Names failed(const ColumnOf<D>& column) const
  {
    return with(Verdict::failed, lines_of(column));
  }

  template <class Damage>
  void tamper(const Damage& damage) const
  {
    const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
    ASSERT_GE(file, 0);
    damage(file);
    H5Fclose(file);
  }
};

}  // namespace grseg
