// SPDX-License-Identifier: GPL-3.0-or-later
// Runs in three dimensions and of any number of species.
#include "tests/spheres.hpp"

#include "formats/trajectory/digest.hpp"
#include "formats/trajectory/writer.hpp"
#include "tests/formats/trajectory/trajectory_fixture.hpp"

#include <cmath>
#include <functional>

namespace grseg {
namespace {

class Spheres : public Trajectory {
 protected:
  std::string complaint_of(const RunDescription& run) const
  {
    spheres::write(path, 1, {}, run);
    return complaint_of_all(Verify::no);
  }
  static void rewrite(hid_t file, const char* dataset, hid_t type, const void* data)
  {
    const hid_t id = H5Dopen2(file, dataset, H5P_DEFAULT);
    ASSERT_GE(H5Dwrite(id, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, data), 0);
    H5Dclose(id);
  }
  /// Renames the middle one of the species.
  static void rename(hid_t file, std::string name)
  {
    name.resize(16, '\0');
    std::string names(64, '\0');
    const hid_t id = H5Dopen2(file, "/grseg/species/name", H5P_DEFAULT);
    const hid_t type = H5Dget_type(id);
    H5Dread(id, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, names.data());
    H5Dclose(id);
    rewrite(file, "/grseg/species/name", type, names.replace(16, 16, name).data());
    H5Tclose(type);
  }
  static void set_boundary(hid_t file, const std::array<char[9], 3>& words)
  {
    const hid_t box = H5Gopen2(file, "/particles/grains/box", H5P_DEFAULT);
    H5Adelete(box, "boundary");
    const hid_t type = H5Tcopy(H5T_C_S1);
    H5Tset_size(type, 9);
    const hsize_t count = words.size();
    const hid_t space = H5Screate_simple(1, &count, nullptr);
    const hid_t attribute = H5Acreate2(box, "boundary", type, space, H5P_DEFAULT, H5P_DEFAULT);
    H5Awrite(attribute, type, words.data());
    H5Aclose(attribute);
    H5Sclose(space);
    H5Tclose(type);
    H5Gclose(box);
  }
};

TEST_F(Spheres, AreReadBackToTheLastBit)
{
  spheres::write(path, 3);
  const TrajectoryReader reader(path);
  ASSERT_EQ(reader.size(), 3u);
  EXPECT_EQ(reader.dimension(), 3);
  EXPECT_EQ(reader.verified(), "all");
  EXPECT_TRUE(reader.closed());
  EXPECT_EQ(reader.damage_outside_frames(), "");
  EXPECT_EQ(reader.box().length_x, 0.1);
  EXPECT_EQ(reader.box().length_z, 0.06);
  EXPECT_TRUE(reader.box().periodic_z);
  EXPECT_EQ(reader.gravity<3>().start, Vec3(3.8, -9.0, 0.2));
  Frame<3> frame;
  for (std::size_t k = 0; k < 3; ++k) {
    reader.read(k, frame, {.velocity = true, .contacts = true, .force = true});
    expect_same(frame, spheres::frame(static_cast<std::int64_t>(k)));
    EXPECT_TRUE(reader.is_intact(k, frame));
  }
}

// Memory for two components must not receive three.
TEST_F(Spheres, AreRefusedByReadersOfDiscs)
{
  spheres::write(path, 1);
  const TrajectoryReader reader(path);
  Frame<2> frame;
  try {
    reader.read(0, frame);
    FAIL();
  } catch (const FormatError& error) {
    EXPECT_EQ(error.what(),
              path + ": is a run in three dimensions, which this program does not read");
  }
}

TEST_F(Spheres, KeepTheirSpeciesInMemoryAndCountTheBoundaryLastInTheFile)
{
  spheres::write(path, 1);
  {
    const TrajectoryReader reader(path);
    ASSERT_EQ(reader.species().size(), 3u);
    EXPECT_EQ(reader.species()[0].name, "fine");
    EXPECT_EQ(reader.species()[2].name, "coarse");
    EXPECT_EQ(reader.species()[1].diameter, 0.008);
    EXPECT_EQ(reader.grains().species, spheres::grains().species);
    EXPECT_EQ(reader.small_diameter(), 0.005);
    EXPECT_EQ(reader.large_diameter(), 0.012);
  }
  tamper([](hid_t file) {
    std::vector<std::int32_t> numbers(4);
    const hid_t id = H5Dopen2(file, "/particles/grains/species", H5P_DEFAULT);
    H5Dread(id, H5T_NATIVE_INT32, H5S_ALL, H5S_ALL, H5P_DEFAULT, numbers.data());
    H5Dclose(id);
    EXPECT_EQ(numbers, (std::vector<std::int32_t>{2, 1, 0, 3}));
  });
}

TEST_F(Spheres, BetweenWallsAcrossOrWithoutForcesOnGrainsAreReadBack)
{
  auto run = spheres::description();
  run.box.periodic_z = false;
  run.has_force = false;
  run.species = {{"all", 0.005}};
  run.parameters.numbers["large_diameter"] = {0.005};
  run.grains.species = {Species{0}, Species{0}, Species{0}, Species::boundary};
  {
    auto frame = spheres::frame(0);
    frame.force.clear();
    TrajectoryWriter writer(path, run);
    writer.append(frame, std::vector<double>{8});
    writer.close();
  }
  const TrajectoryReader reader(path);
  EXPECT_FALSE(reader.box().periodic_z);
  EXPECT_TRUE(reader.box().periodic_x);
  EXPECT_FALSE(reader.has_force());
  EXPECT_EQ(reader.species().size(), 1u);
  EXPECT_EQ(complaint_of_all(), "no complaint");
}

TEST_F(Spheres, ArePackedWithTheirDigest)
{
  const std::string packed = path + ".packed";
  for (const bool float32 : {false, true}) {
    spheres::write(path, 3, {.float32 = float32});
    repack(path, packed, {.compression = 6, .float32 = float32});
    const TrajectoryReader before(path), after(packed);
    EXPECT_EQ(after.digest(), before.digest());
    EXPECT_EQ(after.species()[1].name, "middle");
    EXPECT_EQ(after.box().length_z, 0.06);
    Frame<3> frame;
    after.read(2, frame, {.velocity = true, .contacts = true, .force = true});
    if (!float32) expect_same(frame, spheres::frame(2));
    fs::remove(packed);
  }
}

TEST_F(Spheres, ChangeTheirDigestWithTheLastBitOfEveryComponent)
{
  const auto whole = spheres::frame(1);
  const auto digest = frame_digest(whole, 1, false);
  for (int axis = 0; axis < 3; ++axis) {
    const auto nudge = [&](auto& vectors) {
      auto& x = vectors.back()[axis];
      x = std::nextafter(x, 1e9);
    };
    const std::vector<std::function<void(Frame<3>&)>> changes{
        [&](Frame<3>& f) { nudge(f.position); },
        [&](Frame<3>& f) { ++f.image.back()[static_cast<std::size_t>(axis)]; },
        [&](Frame<3>& f) { nudge(f.velocity); },
        [&](Frame<3>& f) { nudge(f.angular_velocity); },
        [&](Frame<3>& f) { nudge(f.force); },
        [&](Frame<3>& f) { nudge(f.contacts.force); },
        [&](Frame<3>& f) { nudge(f.contacts.branch); }};
    for (std::size_t k = 0; k < changes.size(); ++k) {
      auto other = whole;
      changes[k](other);
      EXPECT_NE(frame_digest(other, 1, false), digest) << "change " << k << " along " << axis;
    }
  }
}

struct ChangedNumber {
  const char* dataset;
  hsize_t entry;
  std::string place;
  double by = 1;
};

// Damaged entries are z of a grain or contact in frame 1, or entries of the list of species.
TEST_F(Spheres, AreRefusedByNameIfOneNumberIsAnother)
{
  const std::string once = "box, grains, species, observables or parameters are";
  for (const auto& changed : std::initializer_list<ChangedNumber>{
           {"/particles/grains/box/edges", 2, once},
           {"/particles/grains/species", 1, once},
           {"/parameters/gravity", 2, once},
           {"/grseg/species/diameter", 1, once, 1e-3},
           {"/particles/grains/position/value", 14, "/particles/grains/position of frame 1"},
           {"/particles/grains/image/value", 14, "/particles/grains/image of frame 1"},
           {"/particles/grains/velocity/value", 14, "/particles/grains/velocity of frame 1"},
           {"/particles/grains/angular_velocity/value", 14,
            "/particles/grains/angular_velocity of frame 1"},
           {"/particles/grains/angular_velocity/value", 12,
            "/particles/grains/angular_velocity of frame 1"},
           {"/particles/grains/force/value", 14, "/particles/grains/force of frame 1"},
           {"/grseg/contacts/force", 20, "/grseg/contacts/force of frame 1"},
           {"/grseg/contacts/branch", 20, "/grseg/contacts/branch of frame 1"}}) {
    spheres::write(path, 3);
    tamper([&](hid_t file) { add_to(file, changed.dataset, changed.entry, changed.by); });
    EXPECT_TRUE(complaint_of_all().starts_with(path + ": " + changed.place)) << complaint_of_all();
    EXPECT_NE(complaint_of_all().find(" not what was written: the file is damaged"),
              std::string::npos);
  }
}

TEST_F(Spheres, AreRefusedIfTheCellIsSaidToEndAcross)
{
  spheres::write(path, 1);
  tamper([](hid_t file) { set_boundary(file, {"periodic", "none", "none"}); });
  EXPECT_NE(complaint().find("box, grains, species, observables or parameters are not what was"),
            std::string::npos);
}

// --- Invalid boxes and lists of species. ---

TEST_F(Spheres, InACellWithAPeriodAlongYAreRefused)
{
  const std::string sentence =
      ": /particles/grains/box: boundary should be \"periodic\" or \"none\" along x and z, and "
      "\"none\" along y";
  spheres::write(path, 1);
  tamper([](hid_t file) { set_boundary(file, {"periodic", "periodic", "none"}); });
  EXPECT_EQ(complaint(), path + sentence);
  spheres::write(path, 1);
  tamper([](hid_t file) { set_boundary(file, {"periodic", "none", "open"}); });
  EXPECT_EQ(complaint(), path + sentence);
}

TEST_F(Spheres, InACellWithoutLengthAcrossAreRefused)
{
  auto run = spheres::description();
  run.box.length_z = 0;
  EXPECT_EQ(complaint_of(run), path + ": /particles/grains/box: edges[2] <= 0");
  run.box.length_z = NAN;
  EXPECT_EQ(complaint_of(run), path + ": /particles/grains/box: edges[2] <= 0");
}

TEST_F(Spheres, InAFileWithTwoComponentsAreRefused)
{
  three_grains::write(path, 1);
  tamper([](hid_t file) {
    const hid_t box = H5Gopen2(file, "/particles/grains/box", H5P_DEFAULT);
    const hid_t attribute = H5Aopen(box, "dimension", H5P_DEFAULT);
    const int three = 3;
    H5Awrite(attribute, H5T_NATIVE_INT, &three);
    H5Aclose(attribute);
    H5Gclose(box);
  });
  EXPECT_EQ(complaint(), path +
                             ": /particles/grains/box/edges has 2 entries along dimension 0, "
                             "but 3 are needed");
}

TEST_F(Spheres, OfSpeciesThatAreNotInOrderOfSizeAreRefused)
{
  const std::string sentence = path +
                               ": /grseg/species should list mobile species in order of their "
                               "diameters, and last the boundary";
  auto run = spheres::description();
  std::swap(run.species[0], run.species[1]);
  EXPECT_EQ(complaint_of(run), sentence);
  spheres::write(path, 1);
  tamper([](hid_t file) {  // the boundary becomes the first species
    const std::vector<std::uint8_t> mobile{0, 1, 1, 1};
    rewrite(file, "/grseg/species/mobile", H5T_NATIVE_UINT8, mobile.data());
  });
  EXPECT_EQ(complaint(), sentence);
  spheres::write(path, 1);
  tamper([](hid_t file) {
    const std::vector<double> diameters{0.005, 0.008, 0.012, 0.013};
    rewrite(file, "/grseg/species/diameter", H5T_NATIVE_DOUBLE, diameters.data());
  });
  EXPECT_EQ(complaint(), sentence);
}

TEST_F(Spheres, OfASpeciesThatIsNotListedAreRefused)
{
  spheres::write(path, 1);
  tamper([](hid_t file) {
    const std::vector<std::int32_t> numbers{2, 4, 0, 3};
    rewrite(file, "/particles/grains/species", H5T_NATIVE_INT32, numbers.data());
  });
  EXPECT_EQ(complaint(), path +
                             ": /particles/grains/species is 4 for grain 1; 0 fine, 1 middle, "
                             "2 coarse, 3 boundary");
}

TEST_F(Spheres, WithNamesOfAnImpossibleLengthAreRefused)
{
  spheres::write(path, 1);
  tamper([](hid_t file) {
    H5Ldelete(file, "/grseg/species/name", H5P_DEFAULT);
    const hid_t type = H5Tcopy(H5T_C_S1);
    H5Tset_size(type, 1000);
    const hsize_t count = 4;
    const hid_t space = H5Screate_simple(1, &count, nullptr);
    const hid_t id =
        H5Dcreate2(file, "/grseg/species/name", type, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
    H5Dclose(id);
    H5Sclose(space);
    H5Tclose(type);
  });
  EXPECT_EQ(
      complaint(),
      path +
          ": /grseg/species/name has 4 entries of 1000 bytes; 2 to 65536 of at most 256 are possible");
}

TEST_F(Spheres, OfTwoSpeciesOfOneNameAreRefused)
{
  auto run = spheres::description();
  run.species[1].name = "coarse";
  EXPECT_EQ(complaint_of(run), path + ": /grseg/species/name contains coarse twice");
}

TEST_F(Spheres, OfASpeciesWhoseNameFitsNoTableAreNotWritten)
{
  auto run = spheres::description();
  run.species[1].name = "15-of-them.like";
  EXPECT_EQ(complaint_of(run), "no complaint");
  for (const char* name : {"", "sixteen-of-them.", "b", "two words", "a+b", "boundary\t"}) {
    run.species[1].name = name;
    EXPECT_THROW(complaint_of(run), UsageError) << name;
  }
}

TEST_F(Spheres, OfASpeciesWhoseNameFitsNoTableAreRefused)
{
  const std::string rule =
      "names have 1 to 15 of the characters A-Z a-z 0-9 _ - . and are neither boundary nor b";
  for (const auto& names : std::initializer_list<std::pair<std::string, std::string>>{
           {"", ""}, {"a+b", "a+b"}, {"a\tb", "a\\x09b"}, {"boundary", "boundary"}}) {
    spheres::write(path, 1);
    tamper([&](hid_t file) { rename(file, names.first); });
    EXPECT_EQ(complaint(), path + ": /grseg/species/name contains '" + names.second + "': " + rule);
  }
}

// One diameter that tools read from the list, and one that they read from the parameters.
TEST_F(Spheres, WhoseListDisagreesWithTheParametersAreRefused)
{
  auto run = spheres::description();
  run.parameters.numbers["large_diameter"] = {0.008};
  EXPECT_EQ(complaint_of(run),
            path + ": /grseg/species disagrees with /parameters: the file is damaged");
}

}  // namespace
}  // namespace grseg
