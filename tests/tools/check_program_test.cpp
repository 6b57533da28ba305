// SPDX-License-Identifier: GPL-3.0-or-later
// grseg-check as a user calls it.
#include "tests/column.hpp"
#include "tests/shell.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

namespace grseg {
namespace {

namespace fs = std::filesystem;
using namespace column;
using shell::run;

const std::string program = GRSEG_CHECK;
const std::string options = " --physics --window 0.2 --layer 10mm ";

class CheckProgram : public testing::Test {
 protected:
  std::string path =
      (fs::temp_directory_path() / fmt::format("grseg_check_program_{}.h5", getpid())).string();
  void TearDown() override { fs::remove(path); }
};

TEST_F(CheckProgram, NamesAllFailuresInOneSentenceAndStillWritesTheTable)
{
  Column column;
  column.frames[7].contacts.force[2] *= -1;
  column.write(path);
  const auto table = path + ".tsv";
  const auto outcome = run(program + " " + path + options + "-o " + table + " 2>&1");
  EXPECT_EQ(outcome.code, 4);
  EXPECT_EQ(outcome.out.find("grseg-check: " + path + ": beyond tolerance: force_balance is 1."),
            0u)
      << outcome.out;
  EXPECT_NE(outcome.out.find(", tension_largest is 0.667 (at most 1e-10), tension_mean is "),
            std::string::npos)
      << outcome.out;
  EXPECT_EQ(outcome.out.find('\n'), outcome.out.size() - 1);
  std::ifstream file(table);
  const std::string text(std::istreambuf_iterator<char>(file), {});
  EXPECT_NE(text.find("# round-off: 1e-10\n"), std::string::npos);
  EXPECT_NE(text.find("\tfailed\tat t = 0.35005 s, contact 2\n"), std::string::npos) << text;
  fs::remove(table);
  EXPECT_EQ(run(program + " " + path + options + "--round-off 3 2>&1 >/dev/null").code, 0);
}

TEST_F(CheckProgram, ChecksOnlyTheFileWithoutPhysics)
{
  Column column;
  column.frames[7].contacts.force[2] *= -1;
  column.write(path);
  const auto outcome = run(program + " " + path + " --json 2>&1");
  EXPECT_EQ(outcome.code, 0) << outcome.out;
  const auto json = nlohmann::json::parse(outcome.out);
  EXPECT_TRUE(json["passed"].get<bool>());
  EXPECT_EQ(json["lines"].size(), 4u);
  EXPECT_EQ(json["lines"][2]["quantity"], "damaged_frames");
}

TEST_F(CheckProgram, ListsItsChecksInTheHelp)
{
  const auto outcome = run(program + " --help");
  EXPECT_EQ(outcome.code, 0);
  for (const char* check : {"\n  force_balance ", "\n  overlap_mean ", "\n  x_drift "})
    EXPECT_NE(outcome.out.find(check), std::string::npos) << check;
}

TEST_F(CheckProgram, WritesLinesLayersAndTolerancesAsJson)
{
  Column({3, -weight}).write(path);
  const auto json = nlohmann::json::parse(run(program + " " + path + options + "--json").out);
  EXPECT_EQ(json["settings"]["false-alarm"], "0.001");
  int layers = 0;
  for (const auto& line : json["lines"]) {
    if (line.contains("layer")) ++layers;
    EXPECT_EQ(line.contains("layer"), line["quantity"] == "weight" || line["quantity"] == "slope");
    EXPECT_EQ(line["measured"].is_null(), line["verdict"] == "skipped");
  }
  EXPECT_EQ(layers, 2 * (static_cast<int>(discs) - 1));  // weight and slope of all but the first
}

}  // namespace
}  // namespace grseg
