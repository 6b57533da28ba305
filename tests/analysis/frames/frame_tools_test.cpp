// SPDX-License-Identifier: GPL-3.0-or-later
// Tools that sum over frames and tools that read their tables, run as programs on a run whose
// numbers are known.
#include "formats/cli/table.hpp"
#include "formats/trajectory/digest.hpp"
#include "formats/trajectory/reader.hpp"
#include "tests/shell.hpp"
#include "tests/three_grains.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>

namespace grseg {
namespace {

namespace fs = std::filesystem;

using shell::run;

class FrameTools : public testing::Test {
 protected:
  fs::path folder = fs::temp_directory_path() / ("grseg_frame_tools_" + std::to_string(getpid()));
  std::string file = (folder / "run.h5").string();

  void SetUp() override
  {
    fs::create_directories(folder);
    three_grains::write(file, 60);
  }
  void TearDown() override { fs::remove_all(folder); }

  Table table(const std::string& tool, const std::string& options = "")
  {
    const auto outcome = run(tool + " " + file + " " + options);
    EXPECT_EQ(outcome.code, 0) << tool << options;
    return Table::parse(outcome.out, tool);
  }
  static double cell(const Table& table, std::size_t row, const std::string& column)
  {
    return table.rows.at(row).at(table.column(column));
  }
};

const std::string stress = GRSEG_STRESS, merge = GRSEG_MERGE, kinetic = GRSEG_KINETIC,
                  micro = GRSEG_MICRO, derive = GRSEG_DERIVE, forces = GRSEG_FORCES,
                  balance = GRSEG_BALANCE, segregation = GRSEG_SEGREGATION;

TEST_F(FrameTools, RowsOfAllToolsHaveTheSameKeys)
{
  const std::string options = "--layer 6mm --window 0.4 --begin 0.3 --stride 3";
  const auto a = table(stress, options), b = table(kinetic, options), c = table(micro, options),
             d = table(balance, options);
  ASSERT_EQ(a.rows.size(), 6 * 3u);
  ASSERT_EQ(b.rows.size(), a.rows.size());
  ASSERT_EQ(c.rows.size(), 6 * 4u);
  ASSERT_EQ(d.rows.size(), a.rows.size());
  for (std::size_t row = 0; row < a.rows.size(); ++row)
    for (std::size_t key = 0; key < 6; ++key) {
      EXPECT_EQ(a.rows[row][key], b.rows[row][key]);
      EXPECT_EQ(a.rows[row][key], d.rows[row][key]);
      EXPECT_EQ(a.rows[row][key], c.rows[row + row / 3][key]);
    }
}

// The mixed contact is at y = 10 mm, the contact with the base at 0.
TEST_F(FrameTools, StressHasTheSumsOfTheThreeGrains)
{
  const auto t = table(stress, "--layer 6mm");
  ASSERT_EQ(t.rows.size(), 2 * 3u);
  EXPECT_EQ(cell(t, 3, "t0"), 1.25);
  EXPECT_EQ(cell(t, 3, "t1"), 2.5);
  EXPECT_EQ(cell(t, 3, "frames"), 25);
  EXPECT_NEAR(cell(t, 1, "y0"), 0.006, 1e-15);
  EXPECT_NEAR(cell(t, 1, "V"), 0.35 * 0.006, 1e-15);
  EXPECT_NEAR(cell(t, 1, "n_LS"), 1, 1e-15);
  EXPECT_NEAR(cell(t, 1, "M_yy"), 1.5e-6, 1e-18);
  EXPECT_NEAR(cell(t, 1, "M_xy"), -7.5e-7, 1e-18);
  EXPECT_NEAR(cell(t, 1, "M_yx"), 0, 1e-18);
  EXPECT_NEAR(cell(t, 1, "Msize_yy"), 1e-6, 1e-18);
  EXPECT_NEAR(cell(t, 0, "A_Lb_yy"), 5e-6, 1e-18);
  EXPECT_NEAR(cell(t, 0, "F_Lb_xy"), -3e-6, 1e-18);
  EXPECT_NEAR(cell(t, 2, "area_S"), std::numbers::pi * 0.0025 * 0.0025 - cell(t, 1, "area_S"),
              1e-18);
}

// Four times the force in a quarter of the step gives the same velocity in the middle.
TEST_F(FrameTools, TheMiddleOfAStepInPartsIsThatOfItsLastPart)
{
  const auto whole = table(kinetic, "--velocity middle --mean layer");
  auto description = three_grains::description();
  description.observables.push_back({"frame_step", "s"});
  const double step = description.parameters.numbers.at("step")[0];
  {
    TrajectoryWriter writer(file, description);
    for (int k = 0; k < 60; ++k) {
      auto frame = three_grains::frame(k);
      for (auto& force : frame.force) force *= 4;
      for (auto& force : frame.contacts.force) force *= 4;  // torques scale, too
      std::vector<double> observables(description.observables.size(), 0);
      observables.back() = step / 4;
      writer.append(frame, observables);
    }
    writer.close();
  }
  const auto parts = table(kinetic, "--velocity middle --mean layer");
  ASSERT_EQ(parts.columns, whole.columns);
  bool differs = false;
  const auto after = table(kinetic, "--mean layer");
  for (std::size_t row = 0; row < whole.rows.size(); ++row)
    for (std::size_t c = 0; c < whole.columns.size(); ++c) {
      const double a = whole.rows[row][c], b = parts.rows[row][c];
      EXPECT_TRUE(a == b || std::abs(a - b) <= 1e-12 * std::abs(a) || std::isnan(a))
          << whole.columns[c];
      differs = differs || std::abs(a - after.rows[row][c]) > 1e-6 * std::abs(a);
    }
  EXPECT_TRUE(differs) << "the force has an effect";
}

// The three grains lie vertically below the axis, where outward is down and clockwise is up-slope.
// The mixed contact is 12.5 mm from the axis, the contact with the boundary 22.5 mm.
TEST_F(FrameTools, AnnuliLieAboutTheAxisOfADrum)
{
  auto description = three_grains::description();
  description.box.periodic_x = false;
  description.parameters.numbers["drum_centre"] = {0.05, 0.0225};
  {
    TrajectoryWriter writer(file, description);
    for (int k = 0; k < 30; ++k) {
      auto frame = three_grains::frame(k);
      frame.position = three_grains::frame(0).position;
      writer.append(frame, std::vector<double>{0});
    }
    writer.close();
  }
  const auto t = table(stress, "--bins radius --layer 6mm");
  ASSERT_EQ(t.rows.size(), 4u);
  EXPECT_NEAR(cell(t, 2, "y0"), 0.012, 1e-15);
  EXPECT_NEAR(cell(t, 2, "V"), std::numbers::pi * 0.006 * 0.006 * 5, 1e-15);
  EXPECT_NEAR(cell(t, 2, "M_yy"), 1.5e-6, 1e-18);
  EXPECT_NEAR(cell(t, 2, "M_xy"), -7.5e-7, 1e-18);
  EXPECT_NEAR(cell(t, 3, "A_Lb_yy"), 5e-6, 1e-18);
  EXPECT_EQ(t.header_text("bins"), "radius 0.050000000000000003 0.022499999999999999");
  const auto k = table(kinetic, "--bins radius:50mm,22.5mm --layer 6mm");
  EXPECT_NEAR(cell(k, 1, "u"), -0.3, 1e-15);  // velocity of the small grain, 10 mm from the axis
  EXPECT_NEAR(cell(k, 1, "v"), 0.4, 1e-15);
}

TEST_F(FrameTools, AssignmentsGiveTheSameTotals)
{
  const auto a = table(stress, "--layer 6mm"), b = table(stress, "--layer 6mm --assign branch"),
             c = table(stress, "--layer 6mm --assign grain"),
             d = table(stress, "--layer 6mm --assign gauss --kernel-width 1dL");
  for (const char* column : {"M_yy", "Msize_yy", "Mcp_xy", "A_Lb_yy", "F_Lb_yy", "area_L"}) {
    const auto total = [&](const Table& t) {
      return cell(t, 0, column) + cell(t, 1, column) + cell(t, 2, column);
    };
    EXPECT_NEAR(total(b), total(a), 1e-18) << column;
    EXPECT_NEAR(total(c), total(a), 1e-18) << column;
    EXPECT_NEAR(total(d), total(a), 1e-18) << column;
  }
  EXPECT_NEAR(cell(c, 0, "ML_yy"), 1.5e-6, 1e-18);
  EXPECT_NEAR(cell(c, 2, "MS_yy"), 1.5e-6, 1e-18);
}

// The branch of the mixed contact reaches from y = 5 mm to 12.5 mm; its middle is 8.75 mm.
TEST_F(FrameTools, CoarseGrainingSpreadsContactsAndGrainsByTheSameKernel)
{
  const auto t = table(stress, "--layer 8.75mm --assign gauss --kernel-width 0.5dS");
  EXPECT_NEAR(cell(t, 0, "M_yy"), 0.75e-6, 1e-18);
  EXPECT_NEAR(cell(t, 1, "M_yy"), 0.75e-6, 1e-18);
  const double below = std::erfc((0.0125 - 0.00875) / 0.0025 / std::numbers::sqrt2) / 2;
  EXPECT_NEAR(cell(t, 0, "area_S"), std::numbers::pi * 0.0025 * 0.0025 * below, 1e-18);
  EXPECT_EQ(t.header_text("assign"), "gauss");
  EXPECT_EQ(t.header_number("width"), 0.0025);
  EXPECT_EQ(t.header_text("composition"), "kernel");
  EXPECT_EQ(table(stress, "--assign gauss --composition clipped").header_text("composition"),
            "clipped");
}

TEST_F(FrameTools, ARunInTwoPartsMergesIntoTheWhole)
{
  const auto part = [&](const std::string& name, const std::string& options) {
    const auto path = (folder / name).string();
    EXPECT_EQ(run(stress + " " + file + " --layer 6mm " + options + " --overwrite -o " + path).code,
              0);
    return " " + path;
  };
  for (const std::string rule : {"contact-point", "branch", "gauss", "grain"}) {
    const auto assign = " --assign " + rule;
    const auto a = part("a.tsv", "--window 0.5 --end 1" + assign),
               b = part("b.tsv", "--window 0.5 --begin 1" + assign);
    const auto whole = table(stress, "--layer 6mm --window 0.5" + assign);
    const auto merged = Table::parse(run(merge + b + a).out, "merged");
    EXPECT_EQ(merged.columns, whole.columns);
    EXPECT_EQ(merged.rows, whole.rows);

    const auto once = table(stress, "--layer 6mm --window 3" + assign);
    const auto all = Table::parse(run(merge + " --all-windows" + a + b).out, "merged");
    ASSERT_EQ(all.rows.size(), once.rows.size());
    for (std::size_t row = 0; row < once.rows.size(); ++row)
      for (std::size_t c = 0; c < once.columns.size(); ++c)
        EXPECT_NEAR(all.rows[row][c], once.rows[row][c], 1e-14 * std::abs(once.rows[row][c]));
    EXPECT_EQ(all.header_number("window"), 3);
  }
}

TEST_F(FrameTools, KineticHasMassesAndFlow)
{
  const auto t = table(kinetic);
  ASSERT_EQ(t.rows.size(), 2u);
  EXPECT_NEAR(cell(t, 0, "mass_L"), std::numbers::pi * 25e-6, 1e-18);
  EXPECT_NEAR(cell(t, 0, "u"), (4 * 0.1 + 0.3) / 5, 1e-15);
  EXPECT_NEAR(cell(t, 0, "du_dy"), 0.2 / 0.0075, 1e-9);
  EXPECT_NEAR(cell(t, 0, "K_S_yy"), 0, 1e-25);
  const auto by_layer = table(kinetic, "--mean layer");
  EXPECT_NEAR(cell(by_layer, 0, "K_S_xx"), std::numbers::pi * 6.25e-6 * 0.16 * 0.16, 1e-18);
}

TEST_F(FrameTools, MicroHasTheWholeBedLast)
{
  const auto t = table(micro);
  ASSERT_EQ(t.rows.size(), 2 * 2u);
  EXPECT_TRUE(std::isnan(cell(t, 0, "yL")));
  EXPECT_TRUE(std::isnan(cell(t, 1, "y0")));
  EXPECT_NEAR(cell(t, 1, "yL"), 0.005, 1e-15);
  EXPECT_NEAR(cell(t, 1, "ends_L"), 2, 1e-15);
  EXPECT_NEAR(cell(t, 1, "height"), 2 * (4 * 0.005 + 0.0125) / 5, 1e-15);
  EXPECT_NEAR(cell(t, 1, "V"), 0.35 * 0.013, 1e-15);
}

// Masses 4:1, velocities 0.2 and -0.4 m/s: w = 0.08.
TEST_F(FrameTools, SegregationHasTheFluxOfTheThreeGrains)
{
  const auto t = table(segregation), m = table(micro);
  ASSERT_EQ(t.rows.size(), 2 * 2u);
  for (std::size_t row = 0; row < t.rows.size(); ++row)
    for (std::size_t key = 0; key < 5; ++key)
      EXPECT_TRUE(t.rows[row][key] == m.rows[row][key] ||
                  (std::isnan(t.rows[row][key]) && std::isnan(m.rows[row][key])));
  EXPECT_NEAR(cell(t, 0, "w_L"), 0.12, 1e-15);
  EXPECT_NEAR(cell(t, 0, "w_S"), -0.48, 1e-15);
  EXPECT_NEAR(cell(t, 0, "q_L"), 0.8 * 0.12, 1e-15);
  EXPECT_NEAR(cell(t, 0, "q_S"), -0.2 * 0.48, 1e-15);
  EXPECT_TRUE(std::isnan(cell(t, 0, "yL")));
  EXPECT_TRUE(std::isnan(cell(t, 1, "y0")));
  EXPECT_NEAR(cell(t, 1, "yL"), 0.005, 1e-15);
  EXPECT_NEAR(cell(t, 1, "height"), 0.013, 1e-15);
}

TEST_F(FrameTools, ASummaryThatCannotBeMadeSaysSoAndIsDone)
{
  const auto outcome = run(segregation + " " + file + " --summary 2>&1 >/dev/null");
  EXPECT_EQ(outcome.code, 0);
  EXPECT_NE(outcome.out.find("grseg-segregation: no exponential approach fits y_L over time: "
                             "it does not change; try a longer run"),
            std::string::npos);
  const auto quiet = run(segregation + " " + file + " --summary --quiet 2>&1");
  EXPECT_EQ(quiet.code, 0);
  EXPECT_NE(quiet.out.find("# remark: no exponential approach fits y_L"), std::string::npos);
  EXPECT_NE(quiet.out.find("\ntau[s]\tnan\tnan\tnan\n"), std::string::npos);
  const auto json =
      nlohmann::json::parse(run(segregation + " " + file + " --summary --quiet --json").out);
  EXPECT_TRUE(json["numbers"]["tau[s]"]["value"].is_null());
  EXPECT_EQ(json["numbers"]["mixing_end"]["interval"].size(), 2u);
  EXPECT_EQ(json["settings"]["min_solid"], "0.5");
}

TEST_F(FrameTools, TheShearThatALayersMeanAddsIsReported)
{
  const auto outcome = run(kinetic + " " + file + " --mean layer 2>&1 >/dev/null");
  EXPECT_EQ(outcome.code, 0);
  EXPECT_NE(
      outcome.out.find("grseg-kinetic: 100 % of K_xx about the layers' means is due to shear"),
      std::string::npos);
  EXPECT_EQ(run(kinetic + " " + file + " --mean instant 2>&1 >/dev/null").out, "");
}

TEST_F(FrameTools, DerivedNumbersFollowFromTheSumsAlone)
{
  const auto sums = (folder / "micro.tsv").string();
  EXPECT_EQ(run(micro + " " + file + " --friction 0.6 -o " + sums).code, 0);
  const auto t = Table::parse(run(derive + " " + sums).out, "derived");
  ASSERT_EQ(t.rows.size(), 2 * 2u);
  EXPECT_NEAR(cell(t, 1, "z_S"), 1, 1e-15);
  EXPECT_NEAR(cell(t, 1, "z_L"), 2, 1e-15);
  EXPECT_NEAR(cell(t, 1, "z_LS"), 1, 1e-15);
  EXPECT_NEAR(cell(t, 1, "f_S"), std::sqrt(5) * 1e-4, 1e-18);
  EXPECT_NEAR(cell(t, 1, "f_L"), (std::sqrt(5) * 1e-4 + std::sqrt(109) * 1e-4) / 2, 1e-18);
  EXPECT_NEAR(cell(t, 1, "mobilised_LS"), 0.5 / 0.6, 1e-14);
  EXPECT_EQ(cell(t, 1, "sliding_LS"), 0);
  EXPECT_EQ(t.header_text("force"), "modulus");
  EXPECT_EQ(t.header_number("friction"), 0.6);
  EXPECT_EQ(t.header_text("input"), "xxh3 " + format_digest(TrajectoryReader(file).digest()));
  const auto normal = Table::parse(
      run(derive + " " + sums + " --force normal --average ends --pool windows").out, "derived");
  ASSERT_EQ(normal.rows.size(), 2u);
  EXPECT_EQ(cell(normal, 0, "frames"), 50);
  EXPECT_NEAR(cell(normal, 0, "f_L"), (2e-4 + 1e-3) / 2, 1e-18);
  EXPECT_NEAR(cell(normal, 0, "error"), 0, 1e-14);  // all sizes of a species are equal
}

TEST_F(FrameTools, SumsPassThroughAPipe)
{
  const auto sums = (folder / "micro.tsv").string();
  EXPECT_EQ(run(micro + " " + file + " -o " + sums).code, 0);
  const auto stored = Table::parse(run(derive + " " + sums).out, "stored");
  const auto piped = Table::parse(run(micro + " " + file + " | " + derive + " -").out, "-");
  ASSERT_EQ(stored.rows.size(), piped.rows.size());
  for (std::size_t row = 0; row < stored.rows.size(); ++row)
    EXPECT_EQ(cell(stored, row, "Pi"), cell(piped, row, "Pi"));
}

// There is one mixed contact and one with the base: each is the mean of its pair type.
TEST_F(FrameTools, ForcesAreDistributedByTheirMean)
{
  const auto t = table(forces, "--unit type --begin 0 --end 1.25");
  ASSERT_EQ(t.rows.size(), 2 * 101u);
  EXPECT_EQ(cell(t, 10, "x0"), 1);
  EXPECT_EQ(cell(t, 10, "n_LS") + cell(t, 9, "n_LS"), 1);  // round-off may shift the mean
  EXPECT_EQ(cell(t, 10, "n_Lb") + cell(t, 9, "n_Lb"), 1);
  EXPECT_EQ(cell(t, 0, "n_LS"), 0);
}

TEST_F(FrameTools, TheHeaderHasTheNumbersThatLaterToolsNeed)
{
  const auto t = table(stress, "--partition power:2 --base-part half --volume solid");
  EXPECT_EQ(t.header_number("small_diameter"), 0.005);
  EXPECT_EQ(t.header_number("large_diameter"), 0.01);
  EXPECT_EQ(t.header_number("gravity_y"), -9);
  EXPECT_EQ(t.header_number("step"), 1e-4);
  EXPECT_EQ(t.header_number("layer"), 0.02);
  EXPECT_EQ(t.header_number("window"), 1.25);
  EXPECT_EQ(t.header_number("power"), 2);
  EXPECT_EQ(t.header_text("partition"), "power:2");
  EXPECT_EQ(t.header_text("base"), "half");
  EXPECT_EQ(t.header_text("volume"), "solid");
  EXPECT_EQ(t.header_text("history"), "three grains by hand");
  EXPECT_EQ(t.header_text("input"), "xxh3 " + format_digest(TrajectoryReader(file).digest()));
  EXPECT_TRUE(t.has_column("Mpower_yy"));
}

TEST_F(FrameTools, TheSameInputGivesTheSameBytesToFileAndPipe)
{
  const auto once = run(stress + " " + file), again = run(stress + " " + file);
  EXPECT_EQ(once.out, again.out);
  const auto to_file = (folder / "sums.tsv").string();
  EXPECT_EQ(run(stress + " " + file + " -o " + to_file).out, "");
  const auto stored = Table::read(to_file), piped = Table::parse(once.out, "pipe");
  EXPECT_EQ(stored.columns, piped.columns);
  EXPECT_EQ(stored.rows, piped.rows);
}

// The sample is a real run of 200 frames: the 50 frames of a window make 13 blocks.
TEST_F(FrameTools, AnyNumberOfThreadsGivesTheSameBytes)
{
  const std::string sample = std::string(GRSEG_SAMPLE) + " --window 5";
  for (const auto& tool : {stress + " --assign branch", kinetic, micro}) {
    const auto alone = run(tool + " " + sample + " --threads 1").out;
    EXPECT_GT(alone.size(), 10000u);
    EXPECT_EQ(alone, run(tool + " " + sample).out);
    for (const char* threads : {" --threads 2", " --threads=3", " --threads 7", " --threads 0"})
      EXPECT_EQ(alone, run(tool + threads + " " + sample).out) << tool << threads;
  }
}

// Frame 9 contains a NaN. In frame 30, which other threads read first, a grain is missing.
TEST_F(FrameTools, TheFirstDamagedFrameIsNamedWhoeverReadsIt)
{
  {
    TrajectoryWriter writer(file, three_grains::description(), {});
    for (int k = 0; k < 60; ++k) {
      auto frame = three_grains::frame(k);
      if (k == 9) frame.position[1].x() = std::nan("");
      if (k == 30) frame.position[1].y() = 1e6;
      writer.append(frame, std::vector<double>{0});
    }
    writer.close();
  }
  for (const auto& tool : {stress, kinetic, micro})
    for (const char* threads : {"1", "2", "7"}) {
      const auto trouble = [&, threads = threads](const std::string& times) {
        return run(tool + " " + file + times + " --threads " + threads + " 2>&1");
      };
      const auto nan = trouble(" --window 3"), lost = trouble(" --begin 0.75 --window 2");
      EXPECT_EQ(nan.code, 3);
      EXPECT_EQ(
          nan.out.substr(nan.out.find(": /particles")),
          ": /particles/grains/position/value is not a finite number in frame 9, entry 2; the "
          "frame is damaged\n");
      EXPECT_EQ(lost.code, 1);
      EXPECT_EQ(
          lost.out.substr(lost.out.find(": at")),
          ": at t = 1.50005 s a grain is 1e+06 m above the base, more than 100000 layers; either "
          "the grain is lost, or the layers are too thin\n");
    }
}

TEST_F(FrameTools, APresetIsRecordedAndOptionsTakePrecedence)
{
  EXPECT_EQ(table(stress).header_text("preset"), "none");
  const auto paper = table(stress, "--preset paper"), rigorous = table(stress, "--preset rigorous"),
             own = table(stress, "--volume bulk --preset paper --assign grain");
  EXPECT_EQ(paper.header_text("preset"), "paper");
  EXPECT_EQ(paper.header_text("assign"), "contact-point");
  EXPECT_EQ(paper.header_text("partition"), "uniform:0.66667");
  EXPECT_EQ(paper.header_text("volume"), "solid");
  EXPECT_EQ(rigorous.header_text("preset"), "rigorous");
  EXPECT_EQ(rigorous.header_text("assign"), "branch");
  EXPECT_EQ(rigorous.header_text("partition"), "size");
  EXPECT_EQ(own.header_text("preset"), "paper");
  EXPECT_EQ(own.header_text("assign"), "grain");
  EXPECT_EQ(own.header_text("partition"), "uniform:0.66667");
  EXPECT_EQ(own.header_text("volume"), "bulk");
  EXPECT_EQ(table(kinetic, "--preset paper").header_text("mean"), "layer");
  EXPECT_EQ(table(kinetic, "--preset rigorous").header_text("mean"), "profile-unbiased");
  EXPECT_EQ(table(kinetic, "--preset paper --mean species").header_text("mean"), "species");
  for (const char* preset : {"paper", "rigorous"})
    EXPECT_EQ(table(micro, std::string("--preset ") + preset).header_text("preset"), preset);
}

TEST_F(FrameTools, JsonHoldsTheTable)
{
  for (const auto& tool : {stress, kinetic, micro}) {
    const auto t = table(tool);
    const auto json = nlohmann::json::parse(run(tool + " " + file + " --json").out);
    EXPECT_EQ(json["columns"], t.columns);
    ASSERT_EQ(json["rows"].size(), t.rows.size());
    for (std::size_t row = 0; row < t.rows.size(); ++row)
      for (std::size_t c = 0; c < t.columns.size(); ++c) {
        const auto& cell = json["rows"][row][c];
        if (std::isnan(t.rows[row][c]))
          EXPECT_TRUE(cell.is_null());
        else
          EXPECT_EQ(cell, t.rows[row][c]);
      }
    EXPECT_EQ(json["settings"]["layer"], t.header_text("layer"));
    EXPECT_EQ(json["inputs"][0], t.header_text("input"));
    EXPECT_EQ(json["history"][0], "three grains by hand");
    EXPECT_EQ(json["history"].size(), 2u);
  }
}

TEST_F(FrameTools, TroubleHasItsExitCodeAndASentence)
{
  const auto code = [&](const std::string& arguments) {
    const auto outcome = run(stress + " " + arguments + " 2>&1");
    EXPECT_NE(outcome.out.find("grseg-stress: "), std::string::npos) << arguments;
    return outcome.code;
  };
  EXPECT_EQ(code(""), 2);
  EXPECT_EQ(code(file + " " + file), 2);
  EXPECT_EQ(code((folder / "absent.h5").string()), 2);
  EXPECT_EQ(code(file + " --assign gaussian"), 2);
  EXPECT_EQ(code(file + " --assign gauss --kernel-width 0"), 2);
  EXPECT_EQ(code(file + " --assign gauss --kernel-width wide"), 2);
  EXPECT_EQ(code(file + " --assign branch --kernel-width 1dS"), 2);
  EXPECT_EQ(code(file + " --composition kernel"), 2);
  EXPECT_EQ(code(file + " --all-windows"), 2);
  EXPECT_EQ(code(file + " --layer 4dX"), 2);
  EXPECT_EQ(code(file + " --layer 0"), 2);
  EXPECT_EQ(code(file + " --partition thirds"), 2);
  EXPECT_EQ(code(file + " --base-part all"), 2);
  EXPECT_EQ(code(file + " --volume wet"), 2);
  EXPECT_EQ(code(file + " --windows 2"), 2);
  EXPECT_EQ(code(file + " --window 1e-3"), 2);
  EXPECT_EQ(code(file + " --stride 0"), 2);
  EXPECT_EQ(code(file + " --threads -1"), 2);
  EXPECT_EQ(code(file + " --preset papers"), 2);
  EXPECT_EQ(code(file + " --begin nan"), 2);
  EXPECT_EQ(code(file + " --window 4"), 1);
  EXPECT_EQ(code(file + " -o " + (folder / "absent" / "sums.tsv").string()), 1);
  std::ofstream(folder / "no.h5") << "no trajectory\n";
  EXPECT_EQ(code((folder / "no.h5").string()), 3);
}

TEST_F(FrameTools, TroubleOfMergingHasItsExitCodeAndASentence)
{
  const auto code = [&](const std::string& arguments) {
    const auto outcome = run(merge + " " + arguments + " 2>&1");
    EXPECT_NE(outcome.out.find("grseg-merge: "), std::string::npos) << arguments;
    return outcome.code;
  };
  EXPECT_EQ(code(""), 2);
  EXPECT_EQ(code("--layer 2dS sums.tsv"), 2);
  EXPECT_EQ(code((folder / "absent.tsv").string()), 2);
  EXPECT_EQ(code(file), 3);
}

}  // namespace
}  // namespace grseg
