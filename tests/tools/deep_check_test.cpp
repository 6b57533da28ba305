// SPDX-License-Identifier: GPL-3.0-or-later
// grseg-check --deep on a small file that is damaged in one place at a time: the message names the place.
#include "formats/trajectory/hdf5.hpp"
#include "formats/trajectory/hdf5_attributes.hpp"
#include "tests/shell.hpp"
#include "tests/three_grains.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <limits>
#include <string>
#include <vector>

namespace grseg {
namespace {

namespace fs = std::filesystem;
using namespace hdf5;

/// Writes the attribute `name` again, with another value.
template <class Value>
void set_attribute(hid_t file, const char* path, const char* name, const Value& value)
{
  const Object object(H5Oopen(file, path, H5P_DEFAULT));
  H5Adelete(object, name);
  write_attribute(object, name, value);
}

/// Overwrites entry `at` of a dataset, counted through all its dimensions.
void set_entry(hid_t file, const char* path, std::size_t at, double value)
{
  const Dataset dataset(H5Dopen2(file, path, H5P_DEFAULT));
  const Space space(H5Dget_space(dataset));
  std::vector<double> all(static_cast<std::size_t>(H5Sget_simple_extent_npoints(space)));
  H5Dread(dataset, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, all.data());
  all.at(at) = value;
  H5Dwrite(dataset, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, all.data());
}

/// Replaces a dataset by a copy with values of `type` and, if given, with `filter`.
void rewrite(hid_t file, const char* path, hid_t type, H5Z_filter_t filter = H5Z_FILTER_NONE)
{
  const Dataset old(H5Dopen2(file, path, H5P_DEFAULT));
  const Space space(H5Dget_space(old));
  const auto count = static_cast<std::size_t>(H5Sget_simple_extent_npoints(space));
  std::vector<std::int64_t> all(count);
  H5Dread(old, H5T_NATIVE_INT64, H5S_ALL, H5S_ALL, H5P_DEFAULT, all.data());
  H5Ldelete(file, path, H5P_DEFAULT);
  const Properties create(H5Pcreate(H5P_DATASET_CREATE));
  if (filter != H5Z_FILTER_NONE) {
    const hsize_t chunk = count;
    H5Pset_chunk(create, 1, &chunk);
    H5Pset_filter(create, filter, H5Z_FLAG_OPTIONAL, 0, nullptr);
  }
  const Dataset made(H5Dcreate2(file, path, type, space, H5P_DEFAULT, create, H5P_DEFAULT));
  H5Dwrite(made, H5T_NATIVE_INT64, H5S_ALL, H5S_ALL, H5P_DEFAULT, all.data());
}

class DeepCheck : public testing::Test {
 protected:
  std::string path =
      (fs::temp_directory_path() / fmt::format("grseg_deep_check_{}.h5", getpid())).string();
  void SetUp() override { three_grains::write(path, 4, {.compression = 4}); }
  void TearDown() override { fs::remove(path); }

  void spoil(const std::function<void(hid_t)>& damage) const
  {
    const File file(H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT));
    ASSERT_TRUE(file.valid());
    damage(file);
  }
  shell::Outcome check(const std::string& options = "--deep") const
  {
    return shell::run(std::string(GRSEG_CHECK) + " " + path + " " + options +
                      " -o /dev/null --quiet 2>&1");
  }
  /// Expects that `damage` causes the exit code `code` and a message that contains `words`.
  void expect(int code, const std::string& words, const std::function<void(hid_t)>& damage) const
  {
    three_grains::write(path, 4, {.compression = 4});
    spoil(damage);
    const auto outcome = check();
    EXPECT_EQ(outcome.code, code) << words << '\n' << outcome.out;
    EXPECT_NE(outcome.out.find(words), std::string::npos) << words << '\n' << outcome.out;
    EXPECT_EQ(outcome.out.find('\n'), outcome.out.size() - 1) << "one sentence: " << outcome.out;
  }

  /// Changes one bit in the middle of the first chunk of a dataset.
  void flip_bit_of(const char* dataset_path) const
  {
    haddr_t address = 0;
    hsize_t size = 0;
    spoil([&](hid_t file) {
      const Dataset dataset(H5Dopen2(file, dataset_path, H5P_DEFAULT));
      const Space space(H5Dget_space(dataset));
      hsize_t offset[3];
      unsigned mask = 0;
      ASSERT_GE(H5Dget_chunk_info(dataset, space, 0, offset, &mask, &address, &size), 0);
    });
    std::fstream file(path, std::ios::in | std::ios::out | std::ios::binary);
    const auto at = static_cast<std::streamoff>(address + size / 2);
    file.seekg(at);
    const char byte = static_cast<char>(file.get() ^ 1);
    file.seekp(at);
    file.put(byte);
  }
};

TEST_F(DeepCheck, PassesAFileAsWritten)
{
  EXPECT_EQ(check().code, 0) << check().out;
  three_grains::write(path, 4);
  EXPECT_EQ(check().code, 0) << check().out;
  three_grains::write(path, 4, {.float32 = true});
  EXPECT_EQ(check().code, 0) << check().out;
}

TEST_F(DeepCheck, WantsTheAttributesOfH5mdAndOfTheSpecification)
{
  expect(4, "/h5md should have the version [1, 1], but has [1, 0]", [](hid_t f) {
    set_attribute(f, "/h5md", "version", std::vector<int>{1, 0});
  });
  expect(4, "/h5md/author has no text `name`",
         [](hid_t f) { H5Adelete(Object(H5Oopen(f, "/h5md/author", H5P_DEFAULT)), "name"); });
  expect(4, "/h5md/modules/units should have the system \"SI\", but has \"cgs\"",
         [](hid_t f) { set_attribute(f, "/h5md/modules/units", "system", std::string("cgs")); });
  expect(4, "/particles/grains/box should have the dimension [2], but has [4]", [](hid_t f) {
    set_attribute(f, "/particles/grains/box", "dimension", std::vector<int>{4});
  });
  expect(4, "/particles/grains/velocity/value should have the unit \"m s-1\", but has \"m/s\"",
         [](hid_t f) {
           set_attribute(f, "/particles/grains/velocity/value", "unit", std::string("m/s"));
         });
}

TEST_F(DeepCheck, WantsOnePairOfStepsAndTimesForAllElements)
{
  expect(4, "/particles/grains/velocity/time is not a hard link to /particles/grains/position/time",
         [](hid_t f) {
           H5Ldelete(f, "/particles/grains/velocity/time", H5P_DEFAULT);
           H5Ocopy(f, "/particles/grains/position/time", f, "/particles/grains/velocity/time",
                   H5P_DEFAULT, H5P_DEFAULT);
         });
  expect(4, "/observables/translational_energy/step is not a hard link to",
         [](hid_t f) { H5Ldelete(f, "/observables/translational_energy/step", H5P_DEFAULT); });
}

TEST_F(DeepCheck, WantsTypesShapesAndLinksAsSpecified)
{
  expect(4, "/particles/grains/id should be of type int32",
         [](hid_t f) { rewrite(f, "/particles/grains/id", H5T_STD_I64LE); });
  expect(4, "/particles/grains/fixed should be of type uint8",
         [](hid_t f) { rewrite(f, "/particles/grains/fixed", H5T_STD_I8LE); });
  expect(4, "/grseg/digest should have the shape [4], but has [5]", [](hid_t f) {
    const hsize_t five = 5;
    H5Dset_extent(Dataset(H5Dopen2(f, "/grseg/digest", H5P_DEFAULT)), &five);
  });
  expect(4, "/parameters/elsewhere is a soft or external link", [](hid_t f) {
    H5Lcreate_soft("/parameters/step", f, "/parameters/elsewhere", H5P_DEFAULT, H5P_DEFAULT);
  });
  expect(4, "/extra is neither numbers nor text", [](hid_t f) {
    const Type pair(H5Tcreate(H5T_COMPOUND, 8));
    H5Tinsert(pair, "a", 0, H5T_NATIVE_INT);
    const int values[2] = {1, 2};
    write_fixed(f, "/extra", pair, pair, {}, values);
  });
}

TEST_F(DeepCheck, WantsValuesInTheirRanges)
{
  expect(4, "/particles/grains/id holds 7 twice",
         [](hid_t f) { set_entry(f, "/particles/grains/id", 2, 7); });
  expect(4, "/particles/grains/fixed is 0 for grain 2, which belongs to the boundary",
         [](hid_t f) { set_entry(f, "/particles/grains/fixed", 2, 0); });
  expect(4, "/grseg/contacts/i is 2 for contact 1 of frame 0, a grain that is fixed", [](hid_t f) {
    set_entry(f, "/grseg/contacts/i", 1, 2);
    set_entry(f, "/grseg/contacts/j", 1, 0);
  });
  // Entry 8 is x of grain 1 in frame 1.
  expect(4,
         "/particles/grains/position/value has x = 0.35 for grain 1 in frame 1, which is not in "
         "[0, 0.35)",
         [](hid_t f) { set_entry(f, "/particles/grains/position/value", 8, 0.35); });
  expect(4, "/parameters/step should be a positive number",
         [](hid_t f) { set_entry(f, "/parameters/step", 0, 0); });
  expect(4, "/observables/translational_energy/value is not a finite number in frame 3",
         [](hid_t f) {
           set_entry(f, "/observables/translational_energy/value", 3,
                     std::numeric_limits<double>::infinity());
         });
}

// A file that no tool can read is refused, with exit code 3.
TEST_F(DeepCheck, RefusesAnUnreadableDatasetWithItsPath)
{
  expect(3, "/h5md has version 2.0, but this grseg reads versions 1.x", [](hid_t f) {
    set_attribute(f, "/h5md", "version", std::vector<int>{2, 0});
  });
  for (const char* missing :
       {"/grseg/contacts/offset", "/grseg/contacts/i", "/grseg/contacts/j", "/grseg/contacts/force",
        "/grseg/contacts/branch", "/grseg/contacts/gap", "/grseg/digest", "/particles/grains/id",
        "/particles/grains/species", "/particles/grains/radius", "/particles/grains/mass",
        "/particles/grains/fixed", "/particles/grains/box/edges",
        "/particles/grains/position/value", "/particles/grains/position/step",
        "/particles/grains/position/time", "/particles/grains/image/value",
        "/particles/grains/velocity/value", "/particles/grains/angular_velocity/value"})
    expect(3, fmt::format("{} is missing", missing),
           [&](hid_t f) { H5Ldelete(f, missing, H5P_DEFAULT); });
  expect(3, "/particles/grains/species is 3 for grain 1",
         [](hid_t f) { set_entry(f, "/particles/grains/species", 1, 3); });
  expect(3, "the radius or mass of grain 0 is not positive",
         [](hid_t f) { set_entry(f, "/particles/grains/mass", 0, 0); });
  expect(3, "/grseg/contacts/offset does not increase from 0 at entry 2",
         [](hid_t f) { set_entry(f, "/grseg/contacts/offset", 2, 1); });
  expect(3, "contact 1 of frame 1 joins grains 0 and 3, which is impossible",
         [](hid_t f) { set_entry(f, "/grseg/contacts/j", 3, 3); });
  expect(3, "/grseg/contacts/gap is not a finite number in frame 2, entry 1", [](hid_t f) {
    set_entry(f, "/grseg/contacts/gap", 5, std::numeric_limits<double>::quiet_NaN());
  });
  expect(3, "/particles/grains/id uses a filter other than deflate, shuffle and fletcher32",
         [](hid_t f) { rewrite(f, "/particles/grains/id", H5T_STD_I32LE, H5Z_FILTER_NBIT); });
}

TEST_F(DeepCheck, FindsAFlippedBitInAChunkByItsChecksum)
{
  for (const char* damaged : {"/particles/grains/velocity/value", "/grseg/contacts/force",
                              "/particles/grains/image/value", "/grseg/digest",
                              "/observables/translational_energy/value"}) {
    three_grains::write(path, 4, {.compression = 4});
    flip_bit_of(damaged);
    const auto outcome = check();
    EXPECT_EQ(outcome.code, 3) << damaged;
    EXPECT_EQ(outcome.out, fmt::format("grseg-check: {}: {} cannot be read from row 0: the file is "
                                       "damaged or truncated\n",
                                       path, damaged));
  }
  EXPECT_EQ(check("").code, 3) << "without --deep, too, observables are compared with digests";
}

TEST_F(DeepCheck, ReadsDatasetsThatTheSpecificationDoesNotNameToo)
{
  spoil([](hid_t f) {
    const std::vector<double> zeros(1000);
    const auto more = create_growing(f, "/more", H5T_IEEE_F64LE, {}, {1000, 4});
    append_rows(more, H5T_NATIVE_DOUBLE, zeros.size(), zeros.data(), "/more");
  });
  EXPECT_EQ(check().code, 0) << check().out;
  flip_bit_of("/more");
  EXPECT_EQ(check().code, 3);
  EXPECT_NE(check().out.find("/more cannot be read from row 0"), std::string::npos);
}

}  // namespace
}  // namespace grseg
