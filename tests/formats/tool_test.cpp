// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/tool.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

namespace grseg {
namespace {

namespace fs = std::filesystem;

int run(std::vector<std::string> words, const std::function<void(const po::variables_map&)>& body)
{
  std::vector<char*> argv;
  for (auto& word : words) argv.push_back(word.data());
  po::options_description options("Options");
  options.add_options()("layer", po::value<std::string>(), "height");
  const ToolInfo info{"grseg-test", "does nothing.", "grseg-test", "  grseg-test\n"};
  return run_tool(static_cast<int>(argv.size()), argv.data(), info, options, body);
}

TEST(Tool, ReturnsTheExitCodeOfWhatWentWrong)
{
  EXPECT_EQ(run({"grseg-test"}, [](const auto&) {}), 0);
  EXPECT_EQ(run({"grseg-test"}, [](const auto&) { throw RunError("disk full"); }), 1);
  EXPECT_EQ(run({"grseg-test"}, [](const auto&) { throw UsageError("wrong"); }), 2);
  EXPECT_EQ(run({"grseg-test"}, [](const auto&) { throw FormatError("corrupt"); }), 3);
  EXPECT_EQ(run({"grseg-test"}, [](const auto&) { throw CheckError("missed"); }), 4);
}

TEST(Tool, RefusesAnUnknownOptionAndNamesTheNearest)
{
  testing::internal::CaptureStderr();
  EXPECT_EQ(run({"grseg-test", "--layr", "4dS"}, [](const auto&) { FAIL(); }), 2);
  EXPECT_EQ(testing::internal::GetCapturedStderr(),
            "grseg-test: unknown option --layr, did you mean --layer?; --help lists all\n");
}

TEST(Tool, DoesNotGuessAbbreviatedOptions)
{
  EXPECT_EQ(run({"grseg-test", "--lay", "4dS"}, [](const auto&) { FAIL(); }), 2);
}

TEST(Tool, HelpShowsExamplesAndRunsNothing)
{
  testing::internal::CaptureStdout();
  EXPECT_EQ(run({"grseg-test", "--help"}, [](const auto&) { FAIL(); }), 0);
  EXPECT_NE(testing::internal::GetCapturedStdout().find("Examples:"), std::string::npos);
}

TEST(Output, AppearsWholeOrNotAtAll)
{
  const auto folder = fs::temp_directory_path() / ("grseg_tool_test_" + std::to_string(getpid()));
  fs::create_directory(folder);
  const auto path = (folder / "t.tsv").string();
  write_whole(path, "first\n");
  write_whole(path, "second\n");
  std::ifstream file(path);
  EXPECT_EQ(std::string(std::istreambuf_iterator<char>(file), {}), "second\n");
  EXPECT_EQ(std::distance(fs::directory_iterator(folder), {}), 1);
  EXPECT_THROW(write_whole((folder / "missing" / "t.tsv").string(), "x"), RunError);
  fs::create_directory(folder / "taken");
  EXPECT_THROW(write_whole((folder / "taken").string(), "x"), RunError);
  EXPECT_EQ(std::distance(fs::directory_iterator(folder), {}), 2);
  fs::remove_all(folder);
}

}  // namespace
}  // namespace grseg
