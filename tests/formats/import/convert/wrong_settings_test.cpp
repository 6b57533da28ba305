// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/import/convert/importer.hpp"
#include "formats/import/verify/judge.hpp"
#include "tests/folder.hpp"
#include "tests/formats/import/lammps_text.hpp"
#include "tests/formats/import/mercury_files.hpp"

#include <algorithm>
#include <functional>
#include <ostream>

namespace grseg {
namespace {

using lammps_text::Folder;
using lammps_text::mentions;
using lammps_text::read;

const std::string inputs = GRSEG_TEST_INPUTS;

/// An archive that a program wrote, with the settings of a user who knows the run. Gravity is a vector.
struct KnownArchive {
  const char* name;
  Vec3 gravity;
  int along, away;  // axes of the flow
  std::function<ImportSettings(const Folder&)> settings;
};

std::string text_of(const Vec3& gravity)
{
  return fmt::format("{},{},{}", gravity.x(), gravity.y(), gravity.z());
}

/// Writes the grains without masses, which then come from --density.
std::string without_masses(const Folder& folder, const std::string& path)
{
  auto text = read(path);
  for (auto place = text.find(" mass "); place != std::string::npos; place = text.find(" mass "))
    text.replace(place, 6, " v_mass ");
  return folder.write("atoms.dump", text);
}

ImportSettings of_lammps(const Folder& folder)
{
  ImportSettings s;
  s.format = "lammps";
  s.files.grains = {without_masses(folder, inputs + "/lammps/atoms.dump")};
  s.files.contacts = {inputs + "/lammps/contacts.dump"};
  s.files.columns = "i=2,j=3,dist=6,force=7,tangential=10";
  s.units = "si";
  s.step = 1e-5;
  s.density = 1;
  s.grains = "discs";
  s.species.boundary = "3";
  s.species.small = "1";
  s.species.large = "2";
  return s;
}

ImportSettings of_liggghts(const Folder& folder)
{
  ImportSettings s;
  s.format = "liggghts";
  s.files.grains = {without_masses(folder, inputs + "/liggghts/atoms.dump")};
  s.files.contacts = {inputs + "/liggghts/contacts-full35.dump"};
  s.units = "si";
  s.step = 5e-6;
  s.density = 2500;
  s.axes = "xz";
  s.species.boundary = "3";
  s.species.small = "1";
  s.species.large = "2";
  return s;
}

ImportSettings of_lammps_in_space(const Folder&)
{
  ImportSettings s;
  s.format = "lammps";
  s.files.grains = {inputs + "/lammps3d/atoms.dump.gz"};
  s.files.contacts = {inputs + "/lammps3d/contacts.dump.gz"};
  s.units = "1:1:1";
  s.step = 8.8e-4;
  s.axes = "xz";
  s.species.boundary = "1";
  s.species.small = "2";
  s.species.large = "3";
  return s;
}

ImportSettings of_siconos(const Folder&)
{
  ImportSettings s;
  s.format = "siconos";
  s.files.grains = {inputs + "/siconos/discs.hdf5"};
  s.units = "si";
  s.cells = {"x:-0.1:0.9"};
  return s;
}

/// Settings for frames of the sample run, a tenth of a second apart: no forces on grains, and
/// frames far apart.
ImportSettings of_mercury(const Folder& folder)
{
  const TrajectoryReader sample(inputs + "/../../data/sample/chute.h5");
  std::string data, fstat;
  for (std::size_t k = 100; k < 130; ++k) {
    Frame<2> frame;
    sample.read(k, frame);
    data += mercury_files::data(sample.grains(), sample.box(), frame, {});
    fstat += mercury_files::fstat(sample.grains(), frame, {});
  }
  ImportSettings s;
  s.format = "mercury";
  s.files.grains = {folder.write("run.data", data)};
  s.files.contacts = {folder.write("run.fstat", fstat)};
  s.files.restart = folder.write("run.restart", mercury_files::restart(sample.grains(), sample));
  s.units = "si";
  return s;
}

const KnownArchive archives[] = {
    {"lammps", {9.8 * 0.390731, -9.8 * 0.920505, 0}, 0, 1, of_lammps},
    {"lammps3d", {0.5299192642332049, 0, -0.848048096156426}, 0, 2, of_lammps_in_space},
    {"liggghts", {3.8330711, 0, -9.03015405}, 0, 2, of_liggghts},
    {"siconos", {1.7034886, -9.6609641, 0}, 0, 1, of_siconos},
    {"mercury", {9.8 * 0.390731128489274, -9.8 * 0.920504853452440, 0}, 0, 1, of_mercury},
};

/// Makes one setting wrong; returns false if the archive states this value itself.
struct WrongSetting {
  const char* name;
  std::vector<std::string> checks;  // at least one of these checks must report it
  std::function<bool(ImportSettings&, const KnownArchive&)> change;
};

bool times(std::optional<double>& setting, double factor)
{
  if (setting) *setting *= factor;
  return setting.has_value();
}

bool turn_gravity(ImportSettings& s, const KnownArchive& archive, double degrees)
{
  const double angle = degrees * lammps_text::pi / 180;
  Vec3 g = archive.gravity;
  const double x = g[archive.along], y = g[archive.away];
  g[archive.along] = x * std::cos(angle) - y * std::sin(angle);
  g[archive.away] = x * std::sin(angle) + y * std::cos(angle);
  s.gravity = text_of(g);
  return true;
}

bool scale_gravity(ImportSettings& s, const KnownArchive& archive, double factor)
{
  s.gravity = text_of(factor * archive.gravity);
  return true;
}

const WrongSetting wrong_settings[] = {
    {"gravity three times too large",
     {"gravity"},
     [](auto& s, const auto& archive) { return scale_gravity(s, archive, 3); }},
    {"gravity upward",
     {"gravity"},
     [](auto& s, const auto& archive) { return scale_gravity(s, archive, -1); }},
    {"no gravity",
     {"gravity"},
     [](auto& s, const auto& archive) { return scale_gravity(s, archive, 0); }},
    {"gravity 3 degrees off",
     {"gravity"},
     [](auto& s, const auto& archive) { return turn_gravity(s, archive, 3); }},
    {"gravity 3 degrees off, the other way",
     {"gravity"},
     [](auto& s, const auto& archive) { return turn_gravity(s, archive, -3); }},
    {"twice the density",
     {"gravity", "masses"},
     [](auto& s, const auto&) { return times(s.density, 2); }},
    {"half the density",
     {"gravity", "masses"},
     [](auto& s, const auto&) { return times(s.density, 0.5); }},
    {"spheres for discs, or discs for spheres",
     {"gravity", "masses"},
     [](auto& s, const auto&) {
       if (s.grains) s.grains = *s.grains == "discs" ? "spheres" : "discs";
       return s.grains.has_value();
     }},
    {"small and large exchanged",
     {"sizes"},
     [](auto& s, const auto&) {
       std::swap(s.species.small, s.species.large);
       return s.species.small.has_value();
     }},
    {"a step ten times too long",
     {"time", "masses"},
     [](auto& s, const auto&) { return times(s.step, 10); }},
};

struct Outcome {
  int code = 0;
  std::string sentence;
  std::vector<Finding> findings;
};

Outcome outcome_of(ImportSettings s, const Folder& folder)
{
  s.output = folder / "run.h5";
  s.overwrite = true;
  try {
    return {0, "", import_archive(s, "grseg-import").findings};
  } catch (const ToolError& error) {
    return {error.code(), error.what(), {}};
  }
}

/// True if one of these checks refused the import or was undecided.
bool is_noticed(const Outcome& outcome, const std::vector<std::string>& checks)
{
  return std::any_of(checks.begin(), checks.end(), [&](const std::string& check) {
    if (outcome.code != 0) return outcome.sentence.find(check + ": ") != std::string::npos;
    return std::any_of(outcome.findings.begin(), outcome.findings.end(), [&](const Finding& f) {
      return f.check == check && f.verdict == Verdict::undecided;
    });
  });
}

class TrueArchive : public testing::TestWithParam<KnownArchive> {
 protected:
  Folder folder;
  ImportSettings right() const
  {
    auto s = GetParam().settings(folder);
    s.gravity = text_of(GetParam().gravity);
    return s;
  }
};

TEST_P(TrueArchive, IsAcceptedWithTheRightSettings)
{
  const auto outcome = outcome_of(right(), folder);
  EXPECT_EQ(outcome.code, 0) << outcome.sentence;
  for (const auto& finding : outcome.findings) EXPECT_NE(finding.verdict, Verdict::failed);
}

TEST_P(TrueArchive, IsRefusedOrUndecidedWithEachWrongSetting)
{
  for (const auto& wrong : wrong_settings) {
    auto s = right();
    if (!wrong.change(s, GetParam())) continue;
    const auto outcome = outcome_of(s, folder);
    EXPECT_TRUE(is_noticed(outcome, wrong.checks)) << wrong.name << ": " << outcome.sentence;
    EXPECT_TRUE(outcome.code == 0 || outcome.code == exit_check) << wrong.name << outcome.sentence;
  }
}

std::string name_of(const testing::TestParamInfo<KnownArchive>& info)
{
  return info.param.name;
}
INSTANTIATE_TEST_SUITE_P(Of, TrueArchive, testing::ValuesIn(archives), name_of);

TEST(StrictImport, RefusesWhatIsUndecidedAndWritesNothing)
{
  const Folder folder;
  auto s = of_mercury(folder);
  s.output = folder / "strict.h5";
  s.strict = true;
  const auto refusal = lammps_text::refusal(s);
  EXPECT_EQ(refusal.code, exit_check);
  EXPECT_TRUE(
      lammps_text::mentions(refusal.sentence, "undecided, and --strict is given: balance: "));
  EXPECT_FALSE(lammps_text::fs::exists(s.output));
}

TEST(Undecided, IsInTheFileAndWaivedByName)
{
  const Folder folder;
  auto s = of_mercury(folder);
  s.output = folder / "run.h5";
  import_archive(s, "grseg-import");
  const auto undecided = TrajectoryReader(s.output).parameters().text("import_undecided");
  EXPECT_TRUE(lammps_text::mentions(undecided, "balance: it cannot be judged at this interval"));
  s.accept_residual = {"balance=0.1"};
  s.overwrite = true;
  import_archive(s, "grseg-import");
  const TrajectoryReader run(s.output);
  EXPECT_TRUE(lammps_text::mentions(run.parameters().text("import_waived"), "balance: it cannot"));
  EXPECT_FALSE(lammps_text::mentions(run.parameters().text("import_undecided"), "balance"));
}

}  // namespace
}  // namespace grseg
