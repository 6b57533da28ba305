// SPDX-License-Identifier: GPL-3.0-or-later
// Exports of the run of spheres of three species in tests/spheres.hpp.
#include "tests/spheres.hpp"

#include "formats/export/run_writers.hpp"
#include "formats/trajectory/hdf5.hpp"
#include "tests/formats/export/exported.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <Eigen/Geometry>
#include <cmath>
#include <map>

namespace grseg {
namespace {

class ExportOfSpheres : public testing::Test {
 protected:
  fs::path folder = fs::temp_directory_path() / fmt::format("grseg_export_spheres_{}", getpid());

  void SetUp() override
  {
    fs::create_directories(folder);
    spheres::write(at("run.h5"), 2);
  }
  void TearDown() override { fs::remove_all(folder); }

  std::string at(const char* name) const { return (folder / name).string(); }
  static void write(RunWriter& writer, const TrajectoryReader& run)
  {
    Frame<3> frame;
    for (std::size_t k = 0; k < run.size(); ++k) {
      run.read(k, frame, {.velocity = true, .contacts = true, .force = true});
      writer.add(frame);
    }
    writer.publish();
  }
  /// Numbers in a line of a dump, by column name.
  static std::map<std::string, double> row(const std::string& header, const std::string& line)
  {
    std::istringstream names(header), numbers(line);
    std::string word;
    std::map<std::string, double> values;
    names >> word >> word;  // ITEM: ATOMS
    while (names >> word) numbers >> values[word];
    return values;
  }
};

// The lowest grain ends at y = -0.007; x and z have the extent of the run's cell.
TEST_F(ExportOfSpheres, HasACellThatIsPeriodicAlongXAndZ)
{
  const TrajectoryReader run(at("run.h5"));
  const auto cell = view_cell(run, 0);
  EXPECT_EQ(cell.low, (std::array<double, 3>{0, -0.007, 0}));
  EXPECT_EQ(cell.high, (std::array<double, 3>{0.1, 0.05, 0.06}));
  write(*extxyz_writer(run, cell, at("run.xyz"), false), run);
  const auto lines = lines_of(content(folder / "run.xyz"));
  EXPECT_NE(lines[1].find(R"(Origin="0 -0.007 0" pbc="T F T")"), std::string::npos);
  write(*lammps_writer(run, cell, at("run.dump"), false), run);
  EXPECT_EQ(lines_of(content(folder / "run.dump"))[8], "ITEM: BOX BOUNDS pp ff pp");
}

TEST_F(ExportOfSpheres, HasACellWithWallsAcrossWhereTheRunHas)
{
  auto description = spheres::description();
  description.box.periodic_z = false;
  spheres::write(at("run.h5"), 1, {}, description);
  const TrajectoryReader run(at("run.h5"));
  write(*extxyz_writer(run, view_cell(run, 0), at("run.xyz"), false), run);
  EXPECT_NE(lines_of(content(folder / "run.xyz"))[1].find(R"(pbc="T F F")"), std::string::npos);
  write(*lammps_writer(run, view_cell(run, 0), at("run.dump"), false), run);
  EXPECT_EQ(lines_of(content(folder / "run.dump"))[8], "ITEM: BOX BOUNDS pp ff ff");
}

// Columns id, type, position, velocity, radius, mass, angular velocity, mass, momentum, force; types
// 3, 2, 1 and 4.
TEST_F(ExportOfSpheres, HasEveryComponentInExtendedXyz)
{
  const TrajectoryReader run(at("run.h5"));
  write(*extxyz_writer(run, view_cell(run, 0), at("run.xyz"), false), run);
  const auto lines = lines_of(content(folder / "run.xyz"));
  const double mass = run.grains().mass[0];
  EXPECT_EQ(lines[2],
            fmt::format("11 3 0.002 0.008 0.01 0.11 0.12 0.13 0.006 {0} 1 2 3 {0} {1} {2} {3} "
                        "1e-06 2e-06 3e-06",
                        mass, mass * 0.11, mass * 0.12, mass * 0.13));
  EXPECT_EQ(lines[5].substr(0, 5), "20 4 ");
}

TEST_F(ExportOfSpheres, HasEveryComponentInADump)
{
  const TrajectoryReader run(at("run.h5"));
  write(*lammps_writer(run, view_cell(run, 0), at("run.dump"), false), run);
  const auto grains = lines_of(content(folder / "run.dump"));
  auto value = row(grains[12], grains[14]);
  const auto frame = spheres::frame(0);
  EXPECT_EQ(value["type"], 2);
  EXPECT_EQ(Vec3(value["x"], value["y"], value["z"]), frame.position[1]);
  EXPECT_EQ(value["iz"], 3);
  EXPECT_EQ(Vec3(value["vx"], value["vy"], value["vz"]), frame.velocity[1]);
  EXPECT_EQ(Vec3(value["omegax"], value["omegay"], value["omegaz"]), frame.angular_velocity[1]);
  EXPECT_EQ(Vec3(value["fx"], value["fy"], value["fz"]), frame.force[1]);

  const auto contacts = lines_of(content(folder / "run.contacts.dump"));
  value = row(contacts[12], contacts[14]);
  const Vec3 force(value["forcex"], value["forcey"], value["forcez"]);
  const Vec3 branch(value["branchx"], value["branchy"], value["branchz"]);
  EXPECT_EQ(force, frame.contacts.force[1]);
  EXPECT_EQ(branch, frame.contacts.branch[1]);
  const Vec3 normal(value["fx"], value["fy"], value["fz"]);
  const Vec3 tangential(value["p1"], value["p2"], value["p3"]);
  EXPECT_LT((normal + tangential - force).norm(), 1e-17);
  EXPECT_LT(normal.cross(branch).norm(), 1e-18);
  EXPECT_LT(std::abs(tangential.dot(branch)), 1e-18);
}

TEST_F(ExportOfSpheres, SaysHowADumpBecomesARunAgain)
{
  const TrajectoryReader run(at("run.h5"));
  const auto writer = lammps_writer(run, view_cell(run, 0), at("run.dump"), false);
  write(*writer, run);
  const auto command = writer->import_command();
  EXPECT_NE(command.find(" --gravity 3.8,-9,0.2 --grains-are spheres --dimension 3 --axes xy "),
            std::string::npos);
  EXPECT_NE(command.find(" --species fine=1:0.005 --species middle=2:0.008 --species "
                         "coarse=3:0.012 --boundary 4 "),
            std::string::npos);
  EXPECT_NE(command.find("fy=forcey,fz=forcez,bx=branchx,by=branchy,bz=branchz,overlap=overlap,"
                         "wall=wall "),
            std::string::npos);
}

// Of (-0.017, 0.013, -0.011) on the normal (-7, 6, -4)/sqrt(101).
TEST_F(ExportOfSpheres, HasNormalForceAndModulusOfTheTangentialOneInVtk)
{
  const TrajectoryReader run(at("run.h5"));
  write(*vtp_writer(run, view_cell(run, 0), at("view"), false), run);
  const auto contacts = content(folder / "view/contacts/000000.vtp");
  const double normal = (7 * 0.017 + 6 * 0.013 + 4 * 0.011) / std::sqrt(101.0);
  const double squared = 0.017 * 0.017 + 0.013 * 0.013 + 0.011 * 0.011;
  EXPECT_FLOAT_EQ(array_in<float>(contacts, "tangential_force")[1],
                  static_cast<float>(std::sqrt(squared - normal * normal)));
  EXPECT_FLOAT_EQ(array_in<float>(contacts, "normal_force")[2], static_cast<float>(normal));
  const auto points = array_in<float>(contacts, "Points");
  EXPECT_FLOAT_EQ(points[8], 0.006F);   // z of the middle grain
  EXPECT_FLOAT_EQ(points[11], 0.010F);  // minus z of the branch
  EXPECT_EQ(array_in<std::int32_t>(contacts, "species_i"),
            (std::vector<std::int32_t>{2, 1, 0, 0, 0, 2}));
  EXPECT_EQ(array_in<std::int32_t>(contacts, "species_j"),
            (std::vector<std::int32_t>{3, 2, 2, 1, 3, 3}));
  EXPECT_EQ(contacts.find("pair_type"), std::string::npos);
  const auto grains = content(folder / "view/grains/000000.vtp");
  EXPECT_EQ(array_in<std::int32_t>(grains, "species"), (std::vector<std::int32_t>{2, 1, 0, 3}));
  const auto spins = array_in<float>(grains, "angular_velocity");
  ASSERT_EQ(spins.size(), 12U);
  EXPECT_EQ(spins[3], -4.0F);
  EXPECT_EQ(spins[5], -6.0F);
}

TEST_F(ExportOfSpheres, HasEveryComponentInH5md)
{
  const TrajectoryReader run(at("run.h5"));
  write(*h5md3d_writer(run, view_cell(run, 0), at("view.h5md"), false), run);
  const hid_t file = H5Fopen(at("view.h5md").c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  ASSERT_GE(file, 0);
  const auto values = [&](const char* name) {
    std::vector<double> all(24);  // 2 frames, 4 grains
    const hid_t id =
        H5Dopen2(file, fmt::format("/particles/trajectory/{}/value", name).c_str(), H5P_DEFAULT);
    EXPECT_GE(H5Dread(id, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, all.data()), 0);
    H5Dclose(id);
    return all;
  };
  const auto frame = spheres::frame(1);
  EXPECT_EQ(values("position")[17], frame.position[1].z());
  EXPECT_EQ(values("velocity")[17], frame.velocity[1].z());
  EXPECT_EQ(values("force")[17], frame.force[1].z());
  EXPECT_EQ(values("image")[17], 3);
  EXPECT_EQ(values("angular_velocity")[15], -4);
  H5Fclose(file);
}

}  // namespace
}  // namespace grseg
