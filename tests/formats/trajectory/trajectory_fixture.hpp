// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/core/errors.hpp"
#include "formats/core/frame.hpp"
#include "formats/trajectory/hdf5.hpp"
#include "formats/trajectory/reader.hpp"
#include "tests/three_grains.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace grseg {

namespace fs = std::filesystem;

/// A test with a file of its own, and the message of a reader that refuses the file.
class Trajectory : public testing::Test {
 protected:
  std::string path =
      (fs::temp_directory_path() / ("grseg_trajectory_test_" + std::to_string(getpid()) + ".h5"))
          .string();
  void TearDown() override { fs::remove(path); }

  /// Opens the file and passes it to `damage`.
  template <class Damage>
  void tamper(Damage damage)
  {
    const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
    ASSERT_GE(file, 0);
    damage(file);
    H5Fclose(file);
  }
  static void put(hid_t file, const char* dataset, hsize_t flat, double value)
  {
    const hid_t id = H5Dopen2(file, dataset, H5P_DEFAULT);
    const hid_t space = H5Dget_space(id);
    std::vector<double> values(static_cast<std::size_t>(H5Sget_simple_extent_npoints(space)));
    H5Dread(id, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
    values.at(flat) = value;
    H5Dwrite(id, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
    H5Sclose(space);
    H5Dclose(id);
  }
  static void add_to(hid_t file, const char* dataset, hsize_t flat, double value)
  {
    const hid_t id = H5Dopen2(file, dataset, H5P_DEFAULT);
    const hid_t space = H5Dget_space(id);
    const hid_t type = H5Dget_type(id);
    const auto count = static_cast<std::size_t>(H5Sget_simple_extent_npoints(space));
    if (H5Tget_class(type) == H5T_INTEGER) {
      const bool natural = H5Tget_sign(type) == H5T_SGN_NONE;
      const hid_t wide = natural ? H5T_NATIVE_UINT64 : H5T_NATIVE_INT64;
      std::vector<std::uint64_t> values(count);
      H5Dread(id, wide, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
      values.at(flat) ^= static_cast<std::uint64_t>(value);
      H5Dwrite(id, wide, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
    } else {
      std::vector<double> values(count);
      H5Dread(id, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
      values.at(flat) += value;
      H5Dwrite(id, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
    }
    H5Tclose(type);
    H5Sclose(space);
    H5Dclose(id);
  }
  /// Writes a run that was not closed.
  void write_unfinished(int frames) const
  {
    TrajectoryWriter writer(path, three_grains::description());
    for (int k = 0; k < frames; ++k) writer.append(three_grains::frame(k), std::vector<double>{0});
  }
  std::string complaint(TrajectoryReader::Fields fields = {}, Verify verify = Verify::yes) const
  {
    try {
      const TrajectoryReader reader(path, verify);
      with_dimension(reader.dimension(), [&](auto d) {
        Frame<d> frame;
        for (std::size_t k = 0; k < reader.size(); ++k) reader.read(k, frame, fields);
      });
      if (fields.force) reader.observable(reader.observables().front().name);
    } catch (const FormatError& error) {
      return error.what();
    }
    return "no complaint";
  }
  std::string complaint_of_all(Verify verify = Verify::yes) const
  {
    return complaint({.velocity = true, .contacts = true, .force = true}, verify);
  }
  const std::string changed =
      " is not what was written: the file is damaged; use an intact copy, or leave the frame out "
      "with --begin or --end";
};

template <int D>
void expect_same(const Frame<D>& a, const Frame<D>& b)
{
  EXPECT_EQ(a.step, b.step);
  EXPECT_EQ(a.time, b.time);
  EXPECT_EQ(a.position, b.position);
  EXPECT_EQ(a.image, b.image);
  EXPECT_EQ(a.velocity, b.velocity);
  EXPECT_EQ(a.angular_velocity, b.angular_velocity);
  EXPECT_EQ(a.force, b.force);
  EXPECT_EQ(a.contacts.i, b.contacts.i);
  EXPECT_EQ(a.contacts.j, b.contacts.j);
  EXPECT_EQ(a.contacts.force, b.contacts.force);
  EXPECT_EQ(a.contacts.branch, b.contacts.branch);
  EXPECT_EQ(a.contacts.gap, b.contacts.gap);
}

}  // namespace grseg
