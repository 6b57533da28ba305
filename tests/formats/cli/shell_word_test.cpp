// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/cli/words.hpp"
#include "formats/core/text.hpp"
#include "tests/shell.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

namespace grseg {
namespace {

/// Every byte alone, first, last and in the middle, and words that shells have misread before.
std::vector<std::string> all_words()
{
  std::vector<std::string> words{"",
                                 "it's;x.tsv",
                                 "a;b.tsv",
                                 "'",
                                 "''",
                                 "\\'",
                                 "$'a'",
                                 "=ls",
                                 "~",
                                 "{a,b}",
                                 "!!",
                                 "-n",
                                 "#x",
                                 "a\nb\n",
                                 "\x01"
                                 "1",
                                 "\xc3\xa9t\xc3\xa9.h5",
                                 "\xc3",
                                 "\xc2\x80"};
  for (int code = 1; code < 256; ++code) {
    const char c = static_cast<char>(code);
    words.insert(words.end(),
                 {{c}, {c, 'a', 'b'}, {'a', c, '7', 'b'}, {'a', 'b', c}, {c, '\'', c}});
  }
  return words;
}

/// Words as a shell reads them from a command line.
std::vector<std::string> words_of_shell(const std::string& shell,
                                        const std::vector<std::string>& words)
{
  const auto path = testing::TempDir() + "words" + std::to_string(getpid()) + ".sh";
  std::ofstream script(path, std::ios::binary);
  script << "printf '%s\\0'";
  for (const auto& word : words) script << ' ' << shell_word(word);
  script << '\n';
  script.close();
  const auto out = shell::run(shell + " " + path).out;
  std::filesystem::remove(path);
  std::vector<std::string> read;
  for (auto begin = out.begin(); begin != out.end();) {
    const auto end = std::find(begin, out.end(), '\0');
    read.emplace_back(begin, end);
    begin = end == out.end() ? end : std::next(end);
  }
  return read;
}

TEST(ShellWord, AShellReadsEveryWordAsItWas)
{
  const auto words = all_words();
  EXPECT_EQ(words_of_shell("bash", words), words);
}

TEST(ShellWord, AnyShellReadsWordsOfPrintableCharacters)
{
  auto words = all_words();
  std::erase_if(words, [](const std::string& word) { return printable(word) != word; });
  EXPECT_EQ(words_of_shell("sh", words), words);
}

TEST(ShellWord, IsPrintableSoThatALineOfATableHoldsIt)
{
  for (const auto& word : all_words()) EXPECT_EQ(printable(shell_word(word)), shell_word(word));
}

TEST(ShellWord, IsBareWhereItIsHarmless)
{
  EXPECT_EQ(shell_word("runs/phi0.45,a=b.h5"), "runs/phi0.45,a=b.h5");
  EXPECT_EQ(shell_word("my run.h5"), "'my run.h5'");
  EXPECT_EQ(shell_word("Kepler's"), "'Kepler'\\''s'");
  EXPECT_EQ(shell_word("a\tb"), "$'a\\011b'");
}

}  // namespace
}  // namespace grseg
