// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/cli/tool.hpp"

#include <gtest/gtest.h>

namespace grseg {
namespace {

int run(std::vector<std::string> words, const std::function<void(const po::variables_map&)>& body)
{
  std::vector<char*> argv;
  for (auto& word : words) argv.push_back(word.data());
  po::options_description options("Options");
  options.add_options()("layer", po::value<std::string>(), "height");
  options.add_options()("rule", po::value<std::vector<std::string>>()->composing(), "rules");
  options.add_options()("mean", po::value<std::string>()->default_value("own"), "mean");
  static constexpr PresetOption presets[] = {
      {"layer", "4dS", "2dS"}, {"rule", "half", ""}, {"mean", "", "profile"}};
  const ToolInfo info{"grseg-test", "does nothing.", "grseg-test", "  grseg-test\n", presets};
  return run_tool(static_cast<int>(argv.size()), argv.data(), info, options, body);
}

TEST(Tool, ReturnsTheExitCodeOfTheError)
{
  EXPECT_EQ(run({"grseg-test"}, [](const auto&) {}), 0);
  EXPECT_EQ(run({"grseg-test"}, [](const auto&) { throw RunError("disk full"); }), 1);
  EXPECT_EQ(run({"grseg-test"}, [](const auto&) { throw UsageError("wrong"); }), 2);
  EXPECT_EQ(run({"grseg-test"}, [](const auto&) { throw FormatError("corrupt"); }), 3);
  EXPECT_EQ(run({"grseg-test"}, [](const auto&) { throw CheckError("missed"); }), 4);
}

TEST(Tool, ASentenceThatQuotesAFileDoesNothingToTheTerminal)
{
  testing::internal::CaptureStderr();
  run({"grseg-test"}, [](const auto&) { throw FormatError("a\x1b[2Jb.h5: two\nlines"); });
  run({"grseg-test"}, [](const auto&) { throw std::runtime_error("\x07"); });
  EXPECT_EQ(testing::internal::GetCapturedStderr(),
            "grseg-test: a\\x1b[2Jb.h5: two\nlines\ngrseg-test: \\x07\n");
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

TEST(Tool, APresetSetsWhatIsNotGivenAndCountsAsDefault)
{
  const auto given = [](const po::variables_map& values, const char* option) {
    return values.contains(option) && !values[option].defaulted();
  };
  EXPECT_EQ(run({"grseg-test", "--preset", "paper", "--rule", "size"},
                [&](const auto& values) {
                  EXPECT_EQ(preset_of(values), "paper");
                  EXPECT_EQ(values["layer"].template as<std::string>(), "4dS");
                  EXPECT_FALSE(given(values, "layer"));
                  EXPECT_EQ(values["rule"].template as<std::vector<std::string>>(),
                            std::vector<std::string>{"size"});
                  EXPECT_TRUE(given(values, "rule"));
                  EXPECT_EQ(values["mean"].template as<std::string>(), "own");
                }),
            0);
  EXPECT_EQ(run({"grseg-test", "--layer", "1dS", "--preset", "rigorous"},
                [&](const auto& values) {
                  EXPECT_EQ(values["layer"].template as<std::string>(), "1dS");
                  EXPECT_FALSE(values.contains("rule"));
                  EXPECT_EQ(values["mean"].template as<std::string>(), "profile");
                }),
            0);
  EXPECT_EQ(run({"grseg-test"}, [](const auto& values) { EXPECT_EQ(preset_of(values), "none"); }),
            0);
}

TEST(Tool, RefusesAnUnknownPreset)
{
  testing::internal::CaptureStderr();
  EXPECT_EQ(run({"grseg-test", "--preset", "loose"}, [](const auto&) { FAIL(); }), 2);
  EXPECT_EQ(testing::internal::GetCapturedStderr(),
            "grseg-test: unknown preset 'loose'; choose paper or rigorous\n");
}

TEST(Tool, TheHistoryDoesNotDependOnTheNumberOfThreads)
{
  const auto line = [](std::vector<std::string> words) {
    std::vector<char*> argv;
    for (auto& word : words) argv.push_back(word.data());
    return command_line(static_cast<int>(argv.size()), argv.data());
  };
  EXPECT_EQ(line({"bin/t", "run.h5", "--threads", "7", "--layer", "4 dS"}),
            "t run.h5 --layer '4 dS'");
  EXPECT_EQ(line({"t", "--threads=7", "run.h5"}), "t run.h5");
  EXPECT_EQ(line({"t", "run.h5", "--threads"}), "t run.h5");
}

TEST(Tool, TheHistoryQuotesWordsForAShell)
{
  std::vector<std::string> words{"bin/t", "it's;x.tsv", "a;b.tsv", "two\nlines"};
  std::vector<char*> argv;
  for (auto& word : words) argv.push_back(word.data());
  EXPECT_EQ(command_line(static_cast<int>(argv.size()), argv.data()),
            "t 'it'\\''s;x.tsv' 'a;b.tsv' $'two\\012lines'");
}

TEST(Tool, HelpShowsExamplesAndRunsNothing)
{
  testing::internal::CaptureStdout();
  EXPECT_EQ(run({"grseg-test", "--help"}, [](const auto&) { FAIL(); }), 0);
  EXPECT_NE(testing::internal::GetCapturedStdout().find("Examples:"), std::string::npos);
}

}  // namespace
}  // namespace grseg
