// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/import/convert/importer.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

/// Small archives as LAMMPS would write them, and their imports.
namespace grseg::lammps_text {

namespace fs = std::filesystem;

/// A folder that is removed at the end of the test.
class Folder {
 public:
  Folder() : path_(fs::temp_directory_path() / fmt::format("grseg_import_test_{}", getpid()))
  {
    fs::create_directories(path_);
  }
  ~Folder() { fs::remove_all(path_); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  std::string operator/(const std::string& name) const { return (path_ / name).string(); }
  std::string write(const std::string& name, const std::string& text) const
  {
    std::ofstream(path_ / name, std::ios::binary) << text;
    return *this / name;
  }
  /// Number of files in the folder.
  std::size_t files() const
  {
    std::size_t count = 0;
    for ([[maybe_unused]] const auto& entry : fs::directory_iterator(path_)) ++count;
    return count;
  }

 private:
  fs::path path_;
};

inline testing::AssertionResult mentions(const std::string& sentence, const std::string& part)
{
  if (sentence.find(part) != std::string::npos) return testing::AssertionSuccess();
  return testing::AssertionFailure() << "'" << sentence << "' does not mention '" << part << "'";
}

inline std::string read(const std::string& path)
{
  std::ostringstream text;
  text << std::ifstream(path, std::ios::binary).rdbuf();
  return text.str();
}

inline std::string block(const std::string& what, std::int64_t step, const std::string& columns,
                         const std::vector<std::string>& rows,
                         const std::string& boundary = "pp ff pp")
{
  auto text = fmt::format(
      "ITEM: TIMESTEP\n{}\nITEM: NUMBER OF {}\n{}\nITEM: BOX BOUNDS {}\n0 0.1\n-0.01 0.1\n"
      "-0.0025 0.0025\nITEM: {} {}\n",
      step, what, rows.size(), boundary, what, columns);
  for (const auto& row : rows) text += row + " \n";
  return text;
}

/// A large disc (id 7, type 2) at rest on a base disc (id 9, type 3), and a small one (id 4, type
/// 1) on top. Density 1, slope 30 degrees, g = 10, so gravity is (5, -8.66). Each contact carries
/// the weight above it: a normal part along y and a tangential one along x, held by friction. Radii
/// are 0.005, 0.005 and 0.0025; the discs just touch.
constexpr double pi = 3.14159265358979323846;
constexpr double small_mass = pi * 0.0025 * 0.0025, large_mass = pi * 0.005 * 0.005;
constexpr double gx = 5, gy = -8.6602540378443865;

inline const std::string grain_columns = "id type mass radius x y vx vy omegaz fx fy";

inline std::vector<std::string> grain_rows(double x = 0.05)
{
  return {fmt::format("9 3 {} 0.005 {} -0.005 0 0 0 {} {}", large_mass, x, large_mass * gx,
                      large_mass * gy),
          fmt::format("4 1 {} 0.0025 {} 0.0125 0 0 0 0 0", small_mass, x),
          fmt::format("7 2 {} 0.005 {} 0.005 0 0 0 0 0", large_mass, x)};
}

/// Row with the ten columns of the recipe, index patom1 patom2 dist fx fy fz p1 p2 p3. Grains `upper` and
/// `lower` touch, and the contact carries `mass`. The upper one is patom1 unless `swapped`.
inline std::string contact_row(int upper, int lower, double dist, double mass, bool swapped = false)
{
  const double sign = swapped ? -1 : 1;
  return fmt::format("1 {} {} {} 0 {} 0 {} 0 0", swapped ? lower : upper, swapped ? upper : lower,
                     dist, -sign * mass * gy, -sign * mass * gx);
}

inline const std::string contact_columns =
    "index c_pr[1] c_pr[2] c_pl[1] c_pl[2] c_pl[3] c_pl[4] c_pl[5] c_pl[6] c_pl[7]";

inline std::vector<std::string> contact_rows()
{
  return {contact_row(4, 7, 0.0075, small_mass),
          contact_row(7, 9, 0.01, small_mass + large_mass, true)};
}

inline std::string grains_at(std::int64_t step)
{
  return block("ATOMS", step, grain_columns, grain_rows());
}
inline std::string contacts_at(std::int64_t step)
{
  return block("ENTRIES", step, contact_columns, contact_rows());
}

/// Settings of a user who knows the run.
inline ImportSettings settings(const Folder& folder, const std::string& grains,
                               const std::string& contacts)
{
  ImportSettings s;
  s.format = "lammps";
  s.files.grains = {folder.write("atoms.dump", grains)};
  s.files.contacts = {folder.write("contacts.dump", contacts)};
  s.units = "si";
  s.step = 1e-5;
  s.gravity = "10";
  s.slope = 30;
  s.species.boundary = "3";
  s.output = folder / "run.h5";
  return s;
}

/// Exit code and message of the error that an import throws; 0 and "" if there is none.
struct Refusal {
  int code = 0;
  std::string sentence;
};
inline Refusal refusal(const ImportSettings& s)
{
  try {
    import_archive(s, "grseg-import");
  } catch (const ToolError& error) {
    return {error.code(), error.what()};
  }
  return {};
}

}  // namespace grseg::lammps_text
